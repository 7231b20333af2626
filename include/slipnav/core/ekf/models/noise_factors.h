#pragma once
/// What has been learned about wheel and ground noise, as factors on the configured variances.

#include <array>

namespace slipnav {

/// One everywhere: as configured.
struct NoiseFactors {
  double wheel = 1.0;      ///< white noise of the wheel speed
  double fast_slip = 1.0;  ///< slip that changes within a meter
  double slow_slip = 1.0;  ///< slip that persists
  double lateral = 1.0;    ///< sway of the body
  double side_slip = 1.0;  ///< side slip that persists
  double vertical = 1.0;   ///< heave and pitch of the body

  static constexpr std::size_t kCount = 6;
  std::array<double, kCount> toArray() const { return {wheel, fast_slip, slow_slip, lateral, side_slip, vertical}; }
  static NoiseFactors fromArray(const std::array<double, kCount>& a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }
};

}  // namespace slipnav
