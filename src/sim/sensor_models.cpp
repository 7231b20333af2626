#include "slipnav/sim/sensor_models.h"

#include <cmath>

#include "slipnav/math/rotation.h"

namespace slipnav::sim {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;
constexpr double kSecondsPerHour = 3600.0;
/// Speed to which the grounds' vibration refers.
constexpr double kVibrationSpeed_mps = 0.8;

double fromDegPerHour(double rate_deg_per_h) { return degToRad(rate_deg_per_h) / kSecondsPerHour; }

}  // namespace

ImuModel::ImuModel(const ImuParams& params, const GroundParams& ground, std::uint64_t seed)
    : params_(params),
      C_b_to_s_(q_b_to_n_fromEuler(degToRad(params.misalignment_roll_deg), degToRad(params.misalignment_pitch_deg),
                                   degToRad(params.misalignment_yaw_deg))
                    .toRotationMatrix()
                    .transpose()),
      stream_(seed, "imu"),
      vibration_stream_(seed, "vibration") {
  if (params_.error_free) {
    return;
  }
  const double per_sqrt_s = 1.0 / std::sqrt(kSecondsPerHour);
  accel_.noise_density = params_.accel_noise_mps_per_sqrt_h * per_sqrt_s;
  accel_.in_run_sigma = params_.accel_in_run_bias_ug * 1e-6 * kStandardGravity_mps2;
  accel_.vibration = params_.vibration * ground.vibration_mps2;
  turnOn(accel_, params_.accel_turn_on_bias_mg * 1e-3 * kStandardGravity_mps2, params_.scale_factor_ppm * 1e-6);
  gyro_.noise_density = degToRad(params_.gyro_noise_deg_per_sqrt_h) * per_sqrt_s;
  gyro_.in_run_sigma = fromDegPerHour(params_.gyro_in_run_bias_deg_per_h);
  gyro_.vibration = params_.vibration * ground.vibration_radps;
  turnOn(gyro_, fromDegPerHour(params_.gyro_turn_on_bias_deg_per_h), params_.scale_factor_ppm * 1e-6);
}

Vector3 ImuModel::normal3(RandomStream& stream) const {
  const double x = stream.normal();
  const double y = stream.normal();
  return {x, y, stream.normal()};
}

void ImuModel::turnOn(Triad& triad, double turn_on_sigma, double scale_sigma) {
  triad.turn_on_bias = turn_on_sigma * normal3(stream_);
  triad.scale = scale_sigma * normal3(stream_);
  triad.in_run_bias = triad.in_run_sigma * normal3(stream_);
  triad.bias = triad.turn_on_bias + triad.in_run_bias;
}

Vector3 ImuModel::corrupt(Triad& triad, const Vector3& value, double dt_s, double speed_mps) {
  const double persistence = std::exp(-dt_s / params_.bias_correlation_s);
  triad.in_run_bias = persistence * triad.in_run_bias +
                      triad.in_run_sigma * std::sqrt(1.0 - persistence * persistence) * normal3(stream_);
  triad.bias = triad.turn_on_bias + triad.in_run_bias;
  // vibration moves the rover to and fro, so its integral stays small: what it adds are differences of white noise
  const double integral_sigma = triad.vibration * std::sqrt(0.5) / params_.rate_hz;
  const Vector3 shake = integral_sigma * (speed_mps / kVibrationSpeed_mps) * normal3(vibration_stream_);
  const Vector3 vibration = (shake - triad.shake) / dt_s;
  triad.shake = shake;
  const Vector3 noise = triad.noise_density / std::sqrt(dt_s) * normal3(stream_);
  return value + triad.scale.cwiseProduct(value) + triad.bias + vibration + noise;
}

ImuSample ImuModel::measure(const InertialMean& mean, Nanoseconds stamp, double dt_s, double speed_mps) {
  ImuSample sample{stamp, C_b_to_s_ * mean.f_ib_b, C_b_to_s_ * mean.omega_ib_b};
  if (!params_.error_free) {
    sample.f_ib_b = corrupt(accel_, sample.f_ib_b, dt_s, speed_mps);
    sample.omega_ib_b = corrupt(gyro_, sample.omega_ib_b, dt_s, speed_mps);
  }
  return sample;
}

EncoderModel::EncoderModel(const EncoderParams& params, Nanoseconds start, std::uint64_t seed)
    : count_rad_(2.0 * kPi / params.counts_per_turn), last_stamp_(start) {
  RandomStream stream(seed, "encoder");
  for (double& offset : offset_counts_) {
    offset = stream.uniform();
  }
}

double EncoderModel::quantise(double angle_rad, std::size_t wheel) const {
  return count_rad_ * std::floor(angle_rad / count_rad_ + offset_counts_[wheel]);
}

WheelSample EncoderModel::measure(const PerWheel& angle_rad, Nanoseconds stamp) {
  WheelSample sample;
  sample.stamp = stamp;
  sample.count = kWheelCount;
  const double dt_s = toSeconds(stamp - last_stamp_);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double quantised_rad = quantise(angle_rad[i], i);
    sample.rate_radps[i] = (quantised_rad - last_angle_rad_[i]) / dt_s;
    last_angle_rad_[i] = quantised_rad;
  }
  last_stamp_ = stamp;
  return sample;
}

GnssModel::GnssModel(const GnssParams& params, const LocalFrame& frame, std::uint64_t seed, std::string_view purpose)
    : params_(params), frame_(frame), stream_(seed, purpose) {}

GnssFix GnssModel::measure(const Vector3& position_enu_m, const Matrix3& C_b_to_enu, Nanoseconds stamp) {
  const Vector3 antenna_b(params_.antenna_x_m, params_.antenna_y_m, params_.antenna_z_m);
  Vector3 antenna_enu = position_enu_m + C_b_to_enu * antenna_b;
  antenna_enu.x() += params_.horizontal_noise_m * stream_.normal();
  antenna_enu.y() += params_.horizontal_noise_m * stream_.normal();
  antenna_enu.z() += params_.vertical_noise_m * stream_.normal();
  const Geodetic position = frame_.toGeodetic(antenna_enu);

  GnssFix fix;
  fix.stamp = stamp;
  fix.latitude_deg = radToDeg(position.latitude_rad);
  fix.longitude_deg = radToDeg(position.longitude_rad);
  fix.height_m = position.height_m;
  const double horizontal_m2 = params_.horizontal_noise_m * params_.horizontal_noise_m;
  const double vertical_m2 = params_.vertical_noise_m * params_.vertical_noise_m;
  fix.covariance_ned_m2 = Vector3(horizontal_m2, horizontal_m2, vertical_m2).asDiagonal();
  return fix;
}

}  // namespace slipnav::sim
