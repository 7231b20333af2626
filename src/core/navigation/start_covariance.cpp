#include "core/navigation/start_covariance.h"

#include <cmath>

namespace slipnav {
namespace {

/// A mean rate at rest more than this many σ from the configured bias is taken as the bias.
constexpr double kSurprisingBias = 3.0;
/// Above the rotation of any planet here, which every gyro at rest sees.
constexpr double kPlanetRate_radps = 1e-4;

}  // namespace

void believeSurprisingBias(const Vector3& rate, InitialState& initial) {
  for (int axis = 0; axis < 3; ++axis) {
    double& variance = initial.P(kGyroBias + axis, kGyroBias + axis);
    const double surprise = rate(axis) - initial.nav.gyro_bias_b(axis);
    if (std::abs(surprise) > kSurprisingBias * std::sqrt(variance) + kPlanetRate_radps) {
      initial.nav.gyro_bias_b(axis) = rate(axis);
      variance += square(surprise);
    }
  }
}

}  // namespace slipnav
