#include "core/slip/vehicle_slip.h"

#include <cmath>

#include "core/slip/slip_ratio.h"
#include "slipnav/core/ekf/models/nonholonomic.h"

namespace slipnav {

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
  slip.mean_ratio = slipRatio(slip.forward_mps, estimate.wheels.motion.forward_mps, kMinSpeedForSlip_mps);
  if (std::abs(slip.forward_mps) >= kMinSpeedForSlip_mps) {
    slip.angle_rad = slipAngle(estimate.motion.v_eb_b, estimate.vehicle);
  }
  for (std::size_t i = 0; i < slip.count; ++i) {
    const double at_wheel_mps = slip.forward_mps + estimate.motion.omega_ib_b.z() * geometry.wheel(i).y_m;
    slip.ratio[i] = slipRatio(at_wheel_mps, slip.circumferential_mps[i], kMinSpeedForSlip_mps);
  }
  return slip;
}

}  // namespace slipnav
