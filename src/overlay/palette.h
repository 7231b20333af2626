#pragma once
/// The colors of everything that is drawn, in rviz and in reports.
///
/// Okabe and Ito's set, which people with any of the common color vision deficiencies can tell apart (M. Okabe, K.
/// Ito, "Color Universal Design", 2008), and the brown–teal scale of ColorBrewer ("BrBG") for slip of either sign.
/// scripts/slipnav_report/palette.py and the files in rviz/ have the same values; a test compares them.

#include <cstdint>

namespace slipnav {

/// Components in [0, 1], not premultiplied.
struct Color {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  float alpha = 1.0F;
};

/// @param rgb 0xRRGGBB
constexpr Color colorFromHex(std::uint32_t rgb) {
  return {static_cast<float>((rgb >> 16U) & 0xFFU) / 255.0F, static_cast<float>((rgb >> 8U) & 0xFFU) / 255.0F,
          static_cast<float>(rgb & 0xFFU) / 255.0F, 1.0F};
}

constexpr Color withAlpha(Color color, float alpha) {
  color.alpha = alpha;
  return color;
}

inline constexpr Color kEstimateColor = colorFromHex(0x0072B2);       ///< blue
inline constexpr Color kTruthColor = colorFromHex(0xE69F00);          ///< orange
inline constexpr Color kDeadReckoningColor = colorFromHex(0xCC79A7);  ///< reddish purple
inline constexpr Color kStopColor = colorFromHex(0x009E73);           ///< bluish green
inline constexpr Color kErrorColor = colorFromHex(0xD55E00);          ///< vermilion
inline constexpr Color kTextColor = colorFromHex(0x222222);

inline constexpr Color kSafeColor = colorFromHex(0x56B4E9);     ///< sky blue: far below the threshold
inline constexpr Color kWarningColor = colorFromHex(0xF0E442);  ///< yellow: half way and more
inline constexpr Color kLimitColor = kErrorColor;               ///< the threshold is reached

inline constexpr Color kNoSlipColor = colorFromHex(0xD0D0D0);
inline constexpr Color kSpinningColor = colorFromHex(0x8C510A);  ///< wheels faster than the ground: slip 1
inline constexpr Color kSkiddingColor = colorFromHex(0x01665E);  ///< wheels slower than the ground: slip −1

/// Between two colors, component by component.
Color mix(const Color& from, const Color& to, double fraction);

/// Color of an error bound.
/// @param ratio of the bound to the threshold; 1 and more is the limit
Color boundColor(double ratio);

/// Color of a slip ratio.
/// @param full_scale slip whose color is the full one
Color slipColor(double slip, double full_scale);

}  // namespace slipnav
