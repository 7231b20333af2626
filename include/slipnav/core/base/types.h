#pragma once
/// Basic types, time and unit conversion shared by the whole core.
///
/// Inside the core everything is SI and radians; names in other units carry a suffix (`_deg`, `_deg_per_h`).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

namespace slipnav {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

/// Stamps are integer nanoseconds of the message header: differences are exact and equal stamps compare equal.
using Nanoseconds = std::int64_t;

inline constexpr Nanoseconds kSecond = 1'000'000'000;
/// Stamps of one source that go back by this much mean that it has restarted.
inline constexpr Nanoseconds kRestartBackstep = kSecond;

inline constexpr double kPi = 3.14159265358979323846;

constexpr double toSeconds(Nanoseconds t) { return static_cast<double>(t) * 1e-9; }
inline Nanoseconds fromSeconds(double t_s) { return static_cast<Nanoseconds>(std::llround(t_s * 1e9)); }

constexpr double degToRad(double angle_deg) { return angle_deg * (kPi / 180.0); }
/// Data sheets count accelerations in standard gravity, on any planet.
inline constexpr double kMicroG = 9.80665e-6;  // m/s²
constexpr double degPerHourToRadps(double rate_deg_per_h) { return degToRad(rate_deg_per_h) / 3600.0; }
constexpr double radToDeg(double angle_rad) { return angle_rad * (180.0 / kPi); }

}  // namespace slipnav
