#include "slipnav/measurement/wheel_odometry.h"

#include "slipnav/math/square.h"

namespace slipnav {

void WheelOdometryParams::visit(ParameterVisitor& v) {
  v.choice("source", source, {"auto", "joint_states", "wheel_odometry"},
           "which message the wheels' speeds are taken from; auto: joint_states from its first usable message on");
  v.number("stamp_delay_s", stamp_delay_s, {-1.0, 1.0},
           "how much later than the end of the interval, which its speeds are the mean of, a sample is stamped [s]");
  v.number("speed_std_mps", speed_std_mps, {1e-6, 10.0}, "1σ of the wheel speed whatever the speed [m/s]");
  v.number("slip_noise_std", slip_noise_std, {0.0, 1.0}, "1σ of slip that is new in every sample, a ratio of speed");
  v.number("yaw_rate_std_deg_per_s", yaw_rate_std_deg_per_s, {1e-6, 1e3}, "1σ of the heading rate from wheels [°/s]");
  v.number("yaw_rate_scale_std", yaw_rate_scale_std, {0.0, 10.0},
           "1σ of the heading rate from wheels as a ratio of the rate: scrubbing");
  v.number("scrub_factor", scrub_factor, {0.1, 10.0},
           "how much wider than the geometric track the wheels act in a turn");
}

Measurement forwardSpeedMeasurement(const WheelOdometryParams& params, double wheel_speed_mps,
                                    double slipping_speed_mps, const BodyMotion& motion, const VelocityJacobian& H_v,
                                    const VehicleState& vehicle, double slip_variance, double ground) {
  const double slip = vehicle.wheel_scale + vehicle.slow_slip + vehicle.fast_slip;
  Measurement m(1);
  m.residual(0) = wheel_speed_mps - (motion.v_eb_b.x() + slipping_speed_mps * slip);
  m.H = H_v.row(0);
  m.H(0, kWheelScale) = slipping_speed_mps;
  m.H(0, kSlowSlip) = slipping_speed_mps;
  m.H(0, kFastSlip) = slipping_speed_mps;
  const double changed_mps = wheel_speed_mps - slipping_speed_mps;
  m.variance(0) = square(params.speed_std_mps) + ground * square(params.slip_noise_std * slipping_speed_mps) +
                  square(changed_mps) * (square(slip) + slip_variance);
  return m;
}

Measurement yawRateMeasurement(const WheelOdometryParams& params, double wheel_yaw_rate_radps,
                               const BodyMotion& motion) {
  Measurement m(1);
  m.residual(0) = wheel_yaw_rate_radps - motion.omega_ib_b.z();
  m.H(0, kGyroBias + 2) = -1.0;
  m.variance(0) =
      square(degToRad(params.yaw_rate_std_deg_per_s)) + square(params.yaw_rate_scale_std * motion.omega_ib_b.z());
  return m;
}

}  // namespace slipnav
