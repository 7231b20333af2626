#pragma once
/// Slip ratios that can last.

namespace slipnav {

/// A vehicle is not faster than its wheels for long. Where it seems so their radius is wrong, by no more than this;
/// what is beyond is an error of the estimate, which must not make room for itself.
inline constexpr double kMostNegativeSlip = -1.0 / 3.0;
/// The wheels turn and the vehicle stands.
inline constexpr double kMostSlip = 1.0;

inline bool canLast(double slip) { return slip > kMostNegativeSlip && slip < kMostSlip; }

}  // namespace slipnav
