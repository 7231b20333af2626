#pragma once
/// The square of a number.

namespace slipnav {

constexpr double square(double x) { return x * x; }

}  // namespace slipnav
