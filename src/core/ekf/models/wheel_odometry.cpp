#include "slipnav/core/ekf/models/wheel_odometry.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// Interval and distance that the configured deviations refer to.
constexpr double kReferenceInterval_s = 0.1;
constexpr double kReferenceWay_m = 0.1;
constexpr double kLeastWay_m = 1e-4;

}  // namespace

void WheelOdometryParams::visit(ParameterVisitor& v) {
  v.choice("source", source, {"auto", "joint_states", "wheel_odometry"},
           "message that provides the wheel speeds; auto: joint_states once it has a usable message");
  v.number("odometry_scale", odometry_scale, {0.1, 10.0},
           "ground speed over the forward speed of wheel_odometry, as calibrate finds it");
  v.number("stamp_delay_s", stamp_delay_s, {-1.0, 1.0},
           "how late a sample is stamped after the end of the interval that its speeds are the mean of [s]");
  v.number("speed_std_mps", speed_std_mps, {1e-6, 10.0},
           "1σ of the mean wheel speed over 0.1 s, before anything is learned [m/s]");
  v.number("slip_noise_std", slip_noise_std, {0.0, 1.0}, "1σ of uncorrelated slip, mean over 0.1 m");
  v.number("stamp_std_s", stamp_std_s, {0.0, 1.0}, "1σ of the stamps relative to those of the IMU [s]");
  v.number("yaw_rate_std_deg_per_s", yaw_rate_std_deg_per_s, {1e-6, 1e3}, "1σ of the heading rate from wheels [°/s]");
  v.number("yaw_rate_scale_std", yaw_rate_scale_std, {0.0, 10.0},
           "1σ of the heading rate from wheels as a ratio of the rate: scrubbing");
  v.number("yaw_rate_length_m", yaw_rate_length_m, {1e-3, 1e4},
           "how long an error of the heading rate from wheels lasts, as distance of wheel travel [m]");
  v.number("scrub_factor", scrub_factor, {0.1, 10.0},
           "how much wider than the geometric track the wheels act in a turn");
}

double wheelNoiseVariance(const WheelOdometryParams& params, double duration_s, const NoiseFactors& factors) {
  return factors.wheel * square(params.speed_std_mps) * kReferenceInterval_s / duration_s;
}

double newSlipVariance(const WheelOdometryParams& params, const WheelInterval& wheels, const NoiseFactors& factors) {
  const double way_m = std::max(std::abs(wheels.slipping_speed_mps) * wheels.duration_s, kLeastWay_m);
  return factors.fast_slip * square(params.slip_noise_std * wheels.slipping_speed_mps) * kReferenceWay_m / way_m;
}

Measurement forwardSpeedMeasurement(const WheelOdometryParams& params, const WheelInterval& wheels,
                                    const BodyMotion& motion, const VelocityJacobian& H_v, const VehicleState& vehicle,
                                    double slip_variance, const NoiseFactors& factors) {
  const double slip = vehicle.wheel_scale + vehicle.slow_slip + vehicle.fast_slip;
  const double slipping_mps = wheels.slipping_speed_mps;
  Measurement m(1);
  m.residual(0) = wheels.speed_mps - (motion.v_eb_b.x() + slipping_mps * slip);
  m.H = H_v.row(0);
  m.H(0, kWheelScale) = slipping_mps;
  m.H(0, kSlowSlip) = slipping_mps;
  m.H(0, kFastSlip) = slipping_mps;
  const double ahead_mps = std::max(0.0, std::abs(motion.v_eb_b.x()) - std::abs(slipping_mps));
  m.variance(0) = wheelNoiseVariance(params, wheels.duration_s, factors) + newSlipVariance(params, wheels, factors) +
                  square(ahead_mps) * (square(slip) + slip_variance) +
                  square(params.stamp_std_s * wheels.acceleration_mps2);
  return m;
}

Measurement yawRateMeasurement(const WheelOdometryParams& params, double wheel_yaw_rate_radps, double way_m,
                               const BodyMotion& motion) {
  Measurement m(1);
  m.residual(0) = wheel_yaw_rate_radps - motion.omega_ib_b.z();
  m.H(0, kGyroBias + 2) = -1.0;
  m.variance(0) =
      (square(degToRad(params.yaw_rate_std_deg_per_s)) + square(params.yaw_rate_scale_std * motion.omega_ib_b.z())) *
      std::max(1.0, params.yaw_rate_length_m / std::max(way_m, kLeastWay_m));
  return m;
}

}  // namespace slipnav
