#include "simulation/sensor_models.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;
constexpr double kSecondsPerHour = 3600.0;

double fromDegPerHour(double rate_deg_per_h) { return degToRad(rate_deg_per_h) / kSecondsPerHour; }

/// Samples that are read together still have different stamps.
constexpr Nanoseconds kLeastStep = 20000;

}  // namespace

HostClock::HostClock(const HostStampParams& params, double rate_hz, std::uint64_t seed, std::string_view purpose)
    : params_(params), interval_s_(1.0 / rate_hz), stream_(seed, purpose) {}

Nanoseconds HostClock::stamp(Nanoseconds instant) {
  if (params_.exact()) {
    return instant;
  }
  const double wait_s = interval_s_ * (params_.burst - 1 - in_burst_);
  in_burst_ = (in_burst_ + 1) % params_.burst;
  const double noise_s = params_.noise_s * std::clamp(stream_.normal(), -kLargestStampNoise, kLargestStampNoise);
  last_ = std::max(last_ + kLeastStep, instant + fromSeconds(wait_s + params_.delay_s + noise_s));
  return last_;
}

ImuModel::ImuModel(const ImuParams& params, std::uint64_t seed)
    : params_(params),
      C_b_to_s_(q_b_to_n_fromEuler(degToRad(params.misalignment_roll_deg), degToRad(params.misalignment_pitch_deg),
                                   degToRad(params.misalignment_yaw_deg))
                    .toRotationMatrix()
                    .transpose()),
      stream_(seed, "imu"),
      walk_stream_(seed, "imu bias walk") {
  if (params_.error_free) {
    return;
  }
  const double per_sqrt_s = 1.0 / std::sqrt(kSecondsPerHour);
  accel_.noise_density = params_.accel_noise_mps_per_sqrt_h * per_sqrt_s;
  accel_.in_run_sigma = params_.accel_in_run_bias_ug * 1e-6 * kStandardGravity_mps2;
  turnOn(accel_, params_.accel_turn_on_bias_mg * 1e-3 * kStandardGravity_mps2, params_.scale_factor_ppm * 1e-6);
  gyro_.noise_density = degToRad(params_.gyro_noise_deg_per_sqrt_h) * per_sqrt_s;
  gyro_.in_run_sigma = fromDegPerHour(params_.gyro_in_run_bias_deg_per_h);
  const double walk_per_sqrt_s = per_sqrt_s * kStandardGravity_mps2 * 1e-6;
  accel_.walk_density = params_.accel_bias_walk_ug_per_sqrt_h * walk_per_sqrt_s;
  gyro_.walk_density = fromDegPerHour(params_.gyro_bias_walk_deg_per_h_per_sqrt_h) * per_sqrt_s;
  turnOn(gyro_, fromDegPerHour(params_.gyro_turn_on_bias_deg_per_h), params_.scale_factor_ppm * 1e-6);
}

void ImuModel::turnOn(Triad& triad, double turn_on_sigma, double scale_sigma) {
  triad.turn_on_bias = turn_on_sigma * stream_.normal3();
  triad.scale = scale_sigma * stream_.normal3();
  triad.in_run_bias = triad.in_run_sigma * stream_.normal3();
  triad.bias = triad.turn_on_bias + triad.in_run_bias;
}

Vector3 ImuModel::corrupt(Triad& triad, const Vector3& value, double dt_s) {
  const double persistence = std::exp(-dt_s / params_.bias_correlation_s);
  triad.in_run_bias = persistence * triad.in_run_bias +
                      triad.in_run_sigma * std::sqrt(1.0 - persistence * persistence) * stream_.normal3();
  triad.walk += triad.walk_density * std::sqrt(dt_s) * walk_stream_.normal3();
  triad.bias = triad.turn_on_bias + triad.in_run_bias + triad.walk;
  const Vector3 noise = triad.noise_density / std::sqrt(dt_s) * stream_.normal3();
  return value + triad.scale.cwiseProduct(value) + triad.bias + noise;
}

ImuSample ImuModel::measure(const InertialMean& mean, Nanoseconds stamp, double dt_s) {
  ImuSample sample{stamp, C_b_to_s_ * mean.f_ib_b, C_b_to_s_ * mean.omega_ib_b};
  if (!params_.error_free) {
    sample.f_ib_b = corrupt(accel_, sample.f_ib_b, dt_s);
    sample.omega_ib_b = corrupt(gyro_, sample.omega_ib_b, dt_s);
  }
  return sample;
}

EncoderModel::EncoderModel(const EncoderParams& params, Nanoseconds start, std::uint64_t seed, std::size_t wheels)
    : params_(params),
      count_(wheels),
      count_rad_(2.0 * kPi / params.counts_per_turn),
      start_(start),
      last_stamp_(start) {
  RandomStream stream(seed, "encoder");
  for (std::size_t i = 0; i < count_; ++i) {
    offset_counts_[i] = stream.uniform();
  }
}

bool EncoderModel::isDead(std::size_t wheel, Nanoseconds stamp) const {
  return static_cast<int>(wheel) + 1 == params_.dead_wheel && toSeconds(stamp - start_) >= params_.dead_after_s;
}

/// Two: one wheel per side, the mean of front and back. Six: one such wheel between them.
EncoderAngles EncoderModel::ofLayout(const PerWheel& angle_rad) const {
  const double left = 0.5 * (angle_rad[0] + angle_rad[2]);
  const double right = 0.5 * (angle_rad[1] + angle_rad[3]);
  if (count_ == 2) {
    return {left, right};
  }
  if (count_ == 6) {
    return {angle_rad[0], angle_rad[1], left, right, angle_rad[2], angle_rad[3]};
  }
  return {angle_rad[0], angle_rad[1], angle_rad[2], angle_rad[3]};
}

double EncoderModel::quantize(double angle_rad, std::size_t wheel) const {
  return count_rad_ * std::floor(angle_rad / count_rad_ + offset_counts_[wheel]);
}

WheelSample EncoderModel::measure(const PerWheel& angle_rad, Nanoseconds stamp) {
  WheelSample sample;
  sample.stamp = stamp;
  sample.count = count_;
  const double dt_s = toSeconds(stamp - last_stamp_);
  const EncoderAngles angles_rad = ofLayout(angle_rad);
  for (std::size_t i = 0; i < count_; ++i) {
    const double quantized_rad = isDead(i, stamp) ? last_angle_rad_[i] : quantize(angles_rad[i], i);
    sample.rate_radps[i] = (quantized_rad - last_angle_rad_[i]) / dt_s;
    last_angle_rad_[i] = quantized_rad;
  }
  last_stamp_ = stamp;
  return sample;
}

GnssModel::GnssModel(const GnssParams& params, const LocalFrame& frame, std::uint64_t seed, std::string_view purpose)
    : params_(params), frame_(frame), stream_(seed, purpose), outliers_(seed, std::string(purpose) + " outliers") {}

/// East, north, up [m].
Vector3 GnssModel::error(Nanoseconds stamp) {
  const double persistence =
      params_.correlation_s > 0.0 ? std::exp(-toSeconds(stamp - newest_) / params_.correlation_s) : 0.0;
  newest_ = stamp;
  for (int axis = 0; axis < 3; ++axis) {
    normal_[axis] = persistence * normal_[axis] + std::sqrt(1.0 - persistence * persistence) * stream_.normal();
  }
  Vector3 error =
      normal_.cwiseProduct(Vector3(params_.horizontal_noise_m, params_.horizontal_noise_m, params_.vertical_noise_m));
  if (params_.outlier_part > 0.0 && outliers_.uniform() < params_.outlier_part) {
    const double direction_rad = 2.0 * kPi * outliers_.uniform();
    error += params_.outlier_m * Vector3(std::cos(direction_rad), std::sin(direction_rad), 0.0);
  }
  return error;
}

GnssFix GnssModel::measure(const Vector3& position_enu_m, const Matrix3& C_b_to_enu, Nanoseconds stamp) {
  const Vector3 antenna_b(params_.antenna_x_m, params_.antenna_y_m, params_.antenna_z_m);
  Vector3 antenna_enu = position_enu_m + C_b_to_enu * antenna_b;
  antenna_enu += error(stamp);
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
