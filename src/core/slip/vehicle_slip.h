#pragma once
/// Slip of a wheel, and of the whole vehicle over one wheel interval as estimated by the filter.

#include <array>
#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Slower than this a slip ratio says nothing [m/s].
inline constexpr double kMinSpeedForSlip_mps = 0.05;

/// Longitudinal slip ratio of a wheel (the paper's equation of s, both branches):
/// s = 1 − v_x/(rω) when driving (v_x < rω), rω/v_x − 1 when braking, in [−1, 1]; the same mirrored in reverse.
/// @param v_x_mps velocity of the wheel center along the vehicle; @param r_omega_mps circumferential speed
/// @param min_speed_mps below this, for both speeds, the ratio is undefined
/// @return nothing where it is undefined or a speed is not finite
std::optional<double> slipRatio(double v_x_mps, double r_omega_mps, double min_speed_mps = kMinSpeedForSlip_mps);

/// Slip ratios and slip angle of one interval.
struct VehicleSlip {
  Nanoseconds stamp = 0;  ///< end of the interval
  double duration_s = 0.0;
  double forward_mps = 0.0;                             ///< of the vehicle over ground
  std::optional<double> mean_ratio;                     ///< mean wheel speed relative to forward speed
  std::optional<double> angle_rad;                      ///< from body x to the course, positive to the right
  std::size_t count = 0;                                ///< number of wheels below
  std::array<std::optional<double>, kMaxWheels> ratio;  ///< of each wheel against the speed over ground at its place
  std::array<double, kMaxWheels> circumferential_mps = {};  ///< of each wheel
};

/// Mean wheel speed relative to forward speed, as topic `slip` and the paper's forecast take it; nothing at a
/// standstill, or where a ratio says nothing. The other forecasts take the same ratio over stretches of way.
/// @param estimate of a step in which a wheel interval ended
std::optional<double> meanSlip(const Estimate& estimate);

/// @param estimate likewise
VehicleSlip vehicleSlip(const Estimate& estimate, const WheelGeometry& geometry);

}  // namespace slipnav
