#pragma once
/// Slip of the whole vehicle over one wheel interval, as estimated by the filter.

#include <array>
#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Slower than this a slip ratio says nothing [m/s].
inline constexpr double kMinSpeedForSlip_mps = 0.05;

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

/// @param estimate of a step in which a wheel interval ended
VehicleSlip vehicleSlip(const Estimate& estimate, const WheelGeometry& geometry);

}  // namespace slipnav
