#include "overlay/palette.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

Colour mix(const Colour& from, const Colour& to, double fraction) {
  const auto f = static_cast<float>(std::clamp(fraction, 0.0, 1.0));
  const auto blend = [f](float a, float b) { return a + f * (b - a); };
  return {blend(from.red, to.red), blend(from.green, to.green), blend(from.blue, to.blue), blend(from.alpha, to.alpha)};
}

Colour boundColour(double ratio) {
  return ratio < 0.5 ? mix(kSafeColour, kWarningColour, 2.0 * ratio)
                     : mix(kWarningColour, kLimitColour, 2.0 * ratio - 1.0);
}

Colour slipColour(double slip, double full_scale) {
  return mix(kNoSlipColour, slip > 0.0 ? kSpinningColour : kSkiddingColour, std::abs(slip) / full_scale);
}

}  // namespace slipnav
