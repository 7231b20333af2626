#include "core/slip/slip_ratio.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

std::optional<double> slipRatio(double v_x_mps, double r_omega_mps, double min_speed_mps) {
  if (!std::isfinite(v_x_mps) || !std::isfinite(r_omega_mps) ||
      std::max(std::abs(v_x_mps), std::abs(r_omega_mps)) < min_speed_mps) {
    return std::nullopt;
  }
  const double direction = r_omega_mps < 0.0 ? -1.0 : 1.0;
  const double v_x = direction * v_x_mps;
  const double r_omega = direction * r_omega_mps;
  const double slip = v_x < r_omega ? 1.0 - v_x / r_omega : r_omega / v_x - 1.0;
  return std::clamp(slip, -1.0, 1.0);
}

}  // namespace slipnav
