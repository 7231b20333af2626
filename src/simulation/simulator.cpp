#include "simulation/simulator.h"

#include <algorithm>
#include <cmath>

#include "simulation/driver.h"
#include "simulation/ground.h"
#include "simulation/inertial_truth.h"
#include "simulation/random.h"
#include "simulation/rover_motion.h"
#include "simulation/sensor_models.h"
#include "simulation/shaking.h"
#include "simulation/vibration.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav::sim {
namespace {

constexpr double kMaxFineStep_s = 1e-3;
constexpr int kMinFineSteps = 20;
/// Jitter never moves a sampling instant by more than this fraction of the interval.
constexpr double kMaxJitterPart = 0.4;

Geodetic startPosition(const SimulatorParams& params) {
  return {degToRad(params.start_latitude_deg), degToRad(params.start_longitude_deg), params.start_height_m};
}

std::uint64_t seedOf(const SimulatorParams& params) { return static_cast<std::uint64_t>(params.seed); }

/// Straight line between two fine steps: for sensors that sample inside one.
Kinematics interpolate(const Kinematics& a, const Kinematics& b, double part) {
  Kinematics between = b;
  between.position_enu_m = (1.0 - part) * a.position_enu_m + part * b.position_enu_m;
  between.C_b_to_enu = (1.0 - part) * a.C_b_to_enu + part * b.C_b_to_enu;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    between.wheel_angle_rad[i] = (1.0 - part) * a.wheel_angle_rad[i] + part * b.wheel_angle_rad[i];
  }
  return between;
}

}  // namespace

struct RoverSimulator::Parts {
  Parts(const SimulatorParams& p, const Planet& planet);

  Nanoseconds nextImuStamp();
  InertialMean senseInertia(double interval_s);
  void sampleWheels(const Kinematics& state, Nanoseconds stamp, Measurements& out);
  void sampleOthers(const Kinematics& before, Nanoseconds from, Nanoseconds to, Measurements& out);
  void updateTruth(Nanoseconds stamp);

  SimulatorParams params;
  GroundParams ground;
  LocalFrame frame;
  Nanoseconds start;
  RoverMotion motion;
  InertialTruth inertial;
  Vibration vibration;
  Shaking shaking;
  ImuModel imu;
  EncoderModel encoder;
  GnssModel gps;
  GnssModel truth_gnss;
  SampleClock imu_clock, encoder_clock, gps_clock, truth_clock;
  HostClock imu_host, encoder_host;
  RandomStream jitter_stream;
  TruthState truth;
};

RoverSimulator::Parts::Parts(const SimulatorParams& p, const Planet& planet)
    : params(p),
      ground(changed(groundByName(p.terrain), p.ground)),
      frame(planet, startPosition(p)),
      start(fromSeconds(p.start_time_s)),
      motion(p.vehicle, ground, Driver::routeOf(p).startHeading(), p.drive.initial_straight_m, seedOf(p), p.body,
             {p.drive.initial_straight_m + p.drive.stuck_after_m, p.drive.stuck_s}),
      inertial(planet, frame, {p.imu.lever_arm_x_m, p.imu.lever_arm_y_m, p.imu.lever_arm_z_m}, motion.state()),
      vibration(ground, p.imu.error_free ? 0.0 : p.imu.vibration, p.imu.rate_hz, seedOf(p)),
      shaking(p.imu.error_free ? ShakingParams{} : p.imu.shaking, p.imu.sampling == "mean", seedOf(p)),
      imu(p.imu, seedOf(p)),
      encoder(p.encoder, start, seedOf(p), wheelsOf(p.vehicle.layout)),
      gps(p.gps, frame, seedOf(p), "gps"),
      truth_gnss(p.truth, frame, seedOf(p), "truth gnss"),
      imu_clock(start, p.imu.rate_hz),
      encoder_clock(start, p.encoder.rate_hz),
      gps_clock(start, p.gps.rate_hz),
      truth_clock(start, p.truth.rate_hz),
      imu_host(p.imu.host_stamps, p.imu.rate_hz, seedOf(p), "imu host"),
      encoder_host(p.encoder.host_stamps, p.encoder.rate_hz, seedOf(p), "encoder host"),
      jitter_stream(seedOf(p), "imu jitter") {
  updateTruth(start);
}

Nanoseconds RoverSimulator::Parts::nextImuStamp() {
  const double limit_s = kMaxJitterPart / params.imu.rate_hz;
  const double jitter_s = std::clamp(params.imu.stamp_jitter_s * jitter_stream.normal(), -limit_s, limit_s);
  const Nanoseconds stamp = imu_clock.next() + fromSeconds(jitter_s);
  imu_clock.advance();
  return stamp;
}

void RoverSimulator::Parts::sampleOthers(const Kinematics& before, Nanoseconds from, Nanoseconds to,
                                         Measurements& out) {
  const auto at = [&](Nanoseconds stamp) {
    return interpolate(before, motion.state(), static_cast<double>(stamp - from) / static_cast<double>(to - from));
  };
  if (const Nanoseconds stamp = encoder_clock.next(); stamp <= to) {
    sampleWheels(at(stamp), stamp, out);
    encoder_clock.advance();
  }
  if (const Nanoseconds stamp = gps_clock.next(); stamp <= to) {
    const Kinematics state = at(stamp);
    out.gps = gps.measure(state.position_enu_m, state.C_b_to_enu, stamp);
    gps_clock.advance();
  }
  if (const Nanoseconds stamp = truth_clock.next(); stamp <= to) {
    const Kinematics state = at(stamp);
    out.truth = truth_gnss.measure(state.position_enu_m, state.C_b_to_enu, stamp);
    truth_clock.advance();
  }
}

void RoverSimulator::Parts::sampleWheels(const Kinematics& state, Nanoseconds stamp, Measurements& out) {
  if (out.wheel) {
    out.earlier_wheels.push_back({*out.wheel, out.wheel_angle_rad});
  }
  out.wheel = encoder.measure(state.wheel_angle_rad, stamp);
  out.wheel->stamp = encoder_host.stamp(stamp);
  out.wheel_angle_rad = encoder.angles();
}

/// What an ideal sensor would measure in the interval that ends here.
InertialMean RoverSimulator::Parts::senseInertia(double interval_s) {
  const double speed_mps = motion.state().v_eb_b.norm();
  const InertialMean mean = inertial.finish();
  const InertialMean& smooth = params.imu.sampling == "mean" ? mean : inertial.instant();
  InertialMean sensed = vibration.shake(smooth, interval_s, speed_mps);
  const InertialMean shaken = shaking.sample(speed_mps);
  sensed.f_ib_b += shaken.f_ib_b;
  sensed.omega_ib_b += shaken.omega_ib_b;
  return sensed;
}

void RoverSimulator::Parts::updateTruth(Nanoseconds stamp) {
  const Kinematics& state = motion.state();
  truth.stamp = stamp;
  truth.position_enu_m = state.position_enu_m;
  truth.position = frame.toGeodetic(state.position_enu_m);
  const Matrix3 C_enu_to_n = frame.C_n_to_enu(truth.position).transpose();
  const Matrix3 C_b_to_n = C_enu_to_n * state.C_b_to_enu;
  // the IMU senses vibration as real motion, so it belongs to the truth
  truth.q_b_to_n = (Quaternion(C_b_to_n) * quaternionFromRotationVector(vibration.angle())).normalized();
  truth.v_eb_n = C_enu_to_n * state.v_eb_enu + C_b_to_n * vibration.velocity();
  truth.heading_rad = std::atan2(C_b_to_n(1, 0), C_b_to_n(0, 0));
  truth.v_eb_b = state.v_eb_b;
  truth.omega_ib_b = state.omega_eb_b + state.C_b_to_enu.transpose() * inertial.omega_ie_enu();
  truth.accel_bias_mps2 = imu.accelBias();
  truth.gyro_bias_radps = imu.gyroBias();
  truth.wheel_rate_radps = state.wheel_rate_radps;
  truth.wheel_radius_m = motion.wheelRadii();
  truth.slip = state.slip;
  truth.slip_angle_rad = state.slip_angle_rad;
  truth.standstill = state.standstill;
  truth.distance_m = state.distance_m;
}

RoverSimulator::RoverSimulator(const SimulatorParams& params, const Planet& planet) {
  params.validate();
  parts_ = std::make_unique<Parts>(params, planet);
}

RoverSimulator::~RoverSimulator() = default;
RoverSimulator::RoverSimulator(RoverSimulator&&) noexcept = default;
RoverSimulator& RoverSimulator::operator=(RoverSimulator&&) noexcept = default;

Measurements RoverSimulator::step(const Command& command) {
  Parts& p = *parts_;
  Measurements out;
  const Nanoseconds begin = p.truth.stamp;
  const Nanoseconds end = p.nextImuStamp();
  const double interval_s = toSeconds(end - begin);
  const int count = std::max(kMinFineSteps, static_cast<int>(std::ceil(interval_s / kMaxFineStep_s - 1e-6)));
  const double dt_s = interval_s / count;
  Nanoseconds from = begin;
  for (int i = 1; i <= count; ++i) {
    const Nanoseconds to = begin + (end - begin) * i / count;
    const Kinematics before = p.motion.state();
    p.motion.advance(command.forward_mps, command.yaw_rate_radps, dt_s);
    p.inertial.add(p.motion.state(), dt_s);
    p.shaking.advance(p.motion.travel(), dt_s);
    p.sampleOthers(before, from, to, out);
    from = to;
  }
  out.imu = p.imu.measure(p.senseInertia(interval_s), end, interval_s);
  out.imu.stamp = p.imu_host.stamp(end);
  p.updateTruth(end);
  return out;
}

const TruthState& RoverSimulator::truth() const { return parts_->truth; }

}  // namespace slipnav::sim
