#include "slipnav/core/ekf/models/nonholonomic.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// Smallest information of a mean over hardly any distance, relative to one over the full length.
constexpr double kLeastInformation = 0.05;

}  // namespace

void NonholonomicParams::visit(ParameterVisitor& v) {
  v.number("lateral_std_mps", lateral_std_mps, {1e-6, 10.0},
           "1σ of the mean lateral speed besides side slip, at any forward speed; larger values are learned [m/s]");
  v.number("lateral_slope_std", lateral_slope_std, {0.0, 1.0},
           "1σ of the mean lateral speed as a ratio of the forward speed: sway; larger values are learned");
  v.number("lateral_turn_std_m", lateral_turn_std_m, {0.0, 10.0},
           "1σ of the lateral speed per heading rate, for a turning point that wanders along the vehicle more than the "
           "sway that is learned [m]");
  v.number("vertical_std_mps", vertical_std_mps, {1e-6, 10.0},
           "1σ of the mean vertical speed, at any forward speed; larger values are learned [m/s]");
  v.number("vertical_slope_std", vertical_slope_std, {0.0, 1.0},
           "1σ of the mean vertical speed as a ratio of the forward speed: heave and pitch; larger values are learned");
  v.number("vertical_turn_std_m", vertical_turn_std_m, {0.0, 10.0},
           "1σ of the vertical speed per roll and pitch rate [m]");
  v.number("length_m", length_m, {0.0, 100.0}, "distance over which both are averaged, about the vehicle's length [m]");
  v.number("max_interval_s", max_interval_s, {0.0, 60.0}, "longest time over which both are averaged [s]");
  v.flag("see_attitude", see_attitude,
         "whether they depend on the attitude, which is correct; false for the paper's approximation");
}

VelocityJacobian constraintJacobian(const NonholonomicParams& params, const VelocityJacobian& H_v) {
  VelocityJacobian H = H_v;
  if (!params.see_attitude) {
    H.middleCols<3>(kAttitude).setZero();
  }
  return H;
}

double constraintInformation(const NonholonomicParams& params, double way_m) {
  return params.length_m > 0.0 ? std::clamp(way_m / params.length_m, kLeastInformation, 1.0) : 1.0;
}

Measurement lateralMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                               const VehicleState& vehicle, double factor) {
  const double v_x = motion.v_eb_b.x();
  const double angle = vehicle.mount_yaw_rad - vehicle.side_slip;
  Measurement m(1);
  m.residual(0) = -(motion.v_eb_b.y() + angle * v_x);
  m.H = H_v.row(1) + angle * H_v.row(0);
  m.H(0, kMountYaw) = v_x;
  m.H(0, kSideSlip) = -v_x;
  m.variance(0) = factor * (square(params.lateral_std_mps) + square(params.lateral_slope_std * v_x) +
                            square(params.lateral_turn_std_m * motion.omega_ib_b.z()));
  return m;
}

Measurement verticalMeasurement(const NonholonomicParams& params, const BodyMotion& motion, const VelocityJacobian& H_v,
                                const VehicleState& vehicle, double factor) {
  const double v_x = motion.v_eb_b.x();
  Measurement m(1);
  m.residual(0) = -(motion.v_eb_b.z() - vehicle.mount_pitch_rad * v_x);
  m.H = H_v.row(2) - vehicle.mount_pitch_rad * H_v.row(0);
  m.H(0, kMountPitch) = -v_x;
  m.variance(0) = factor * (square(params.vertical_std_mps) + square(params.vertical_slope_std * v_x) +
                            square(params.vertical_turn_std_m) * motion.omega_ib_b.head<2>().squaredNorm());
  return m;
}

double slipAngle(const Vector3& v_eb_b, const VehicleState& vehicle) {
  const double across = v_eb_b.y() + vehicle.mount_yaw_rad * v_eb_b.x();
  return v_eb_b.x() < 0.0 ? std::atan2(-across, -v_eb_b.x()) : std::atan2(across, v_eb_b.x());
}

}  // namespace slipnav
