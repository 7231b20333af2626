#include "overlay/palette.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

Color mix(const Color& from, const Color& to, double fraction) {
  const auto f = static_cast<float>(std::clamp(fraction, 0.0, 1.0));
  const auto blend = [f](float a, float b) { return a + f * (b - a); };
  return {blend(from.red, to.red), blend(from.green, to.green), blend(from.blue, to.blue), blend(from.alpha, to.alpha)};
}

Color boundColor(double ratio) {
  return ratio < 0.5 ? mix(kSafeColor, kWarningColor, 2.0 * ratio) : mix(kWarningColor, kLimitColor, 2.0 * ratio - 1.0);
}

Color slipColor(double slip, double full_scale) {
  return mix(kNoSlipColor, slip > 0.0 ? kSpinningColor : kSkiddingColor, std::abs(slip) / full_scale);
}

}  // namespace slipnav
