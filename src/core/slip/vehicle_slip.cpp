#include "core/slip/vehicle_slip.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/ekf/models/nonholonomic.h"

namespace slipnav {

std::optional<double> slipRatio(double v_x_mps, double r_omega_mps, double min_speed_mps) {
  if (!std::isfinite(v_x_mps) || !std::isfinite(r_omega_mps) ||
      std::max(std::abs(v_x_mps), std::abs(r_omega_mps)) < min_speed_mps) {
    return std::nullopt;
  }
  const bool backwards = r_omega_mps < 0.0;
  const double v_x = backwards ? -v_x_mps : v_x_mps;
  const double r_omega = backwards ? -r_omega_mps : r_omega_mps;
  const double slip = v_x < r_omega ? 1.0 - v_x / r_omega : r_omega / v_x - 1.0;
  return std::clamp(slip, -1.0, 1.0);
}

std::optional<double> meanSlip(const Estimate& estimate) {
  return estimate.stationary ? std::nullopt : slipRatio(estimate.motion.v_eb_b.x(), estimate.wheels.motion.forward_mps);
}

VehicleSlip vehicleSlip(const Estimate& estimate, const WheelGeometry& geometry) {
  VehicleSlip slip;
  slip.stamp = estimate.wheels.stamp;
  slip.duration_s = estimate.motion.duration_s;
  slip.forward_mps = estimate.motion.v_eb_b.x();
  slip.count = estimate.wheels.count;
  slip.circumferential_mps = estimate.wheels.circumferential_mps;
  if (estimate.stationary) {
    return slip;
  }
  slip.mean_ratio = meanSlip(estimate);
  if (std::abs(slip.forward_mps) >= kMinSpeedForSlip_mps) {
    slip.angle_rad = slipAngle(estimate.motion.v_eb_b, estimate.vehicle);
  }
  for (std::size_t i = 0; i < slip.count; ++i) {
    const double at_wheel_mps = slip.forward_mps + estimate.motion.omega_ib_b.z() * geometry.wheel(i).y_m;
    slip.ratio[i] = slipRatio(at_wheel_mps, slip.circumferential_mps[i]);
  }
  return slip;
}

}  // namespace slipnav
