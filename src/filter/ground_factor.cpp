#include "slipnav/filter/ground_factor.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

/// One outlier must not turn a road into sand.
constexpr double kLargestNis = 10.0;

}  // namespace

void GroundFactorParams::visit(ParameterVisitor& v) {
  v.number("gain", gain, {0.0, 1.0}, "how fast it follows the innovations, per sample");
  v.number("least_std", least_std, {1e-3, 1.0}, "smallest factor on 1σ of slip and side slip; 1 switches it off");
  v.number("expected_nis", expected_nis, {0.1, 2.0}, "normalised innovation squared that it aims at");
}

void GroundFactor::learn(double nis) {
  const double surprise = std::min(nis, kLargestNis) - params_.expected_nis;
  variance_ = std::clamp(variance_ * std::exp(params_.gain * surprise), params_.least_std * params_.least_std, 1.0);
}

}  // namespace slipnav
