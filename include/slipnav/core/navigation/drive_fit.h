#pragma once
/// The heading at the start, from a drive under satellite positions: the wheel-and-gyro track is fitted to the fixes.
///
/// p_i = o + s R(ψ) q_i with fixes p, track of the antenna q, heading ψ, start o and scale s (wheel radius, slip), by
/// weighted least squares in closed form (Umeyama 1991), weights from the fixes' own covariances, reweighted for a
/// Student-t distribution of their errors (Lange, Little, Taylor 1989): a fix that is off by more than its covariance
/// says counts little.

#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/earth/planet.h"
#include "slipnav/core/navigation/start_recording.h"

namespace slipnav {

/// Result of the fit.
struct DriveFit {
  double heading_rad = 0.0;              ///< at the start, clockwise from north
  double heading_std_rad = 0.0;          ///< by the fixes' own covariances
  double scale = 1.0;                    ///< distance by fixes over distance by wheels
  double distance_m = 0.0;               ///< from the start, by wheels and gyro
  double residual_m = 0.0;               ///< weighted root mean square of the residuals
  double fix_std_m = 0.0;                ///< the same, as the fixes claim
  Vector2 start_ne_m = Vector2::Zero();  ///< where the IMU was at the start, north and east of `reference`
};

/// The track of the antenna by wheels and gyro in the horizontal axes of the body at the start.
class DriveTrack {
 public:
  /// @param gyro_bias_radps about body z; @param lever_m from the IMU to the antenna, forward and right of the level
  /// body
  DriveTrack(const StartRecording& recording, Nanoseconds begin, double gyro_bias_radps, const Vector3& lever_m);

  /// Largest distance from the start [m].
  double reach() const { return reach_m_; }
  /// Nothing outside the recording.
  std::optional<Vector2> antennaAt(Nanoseconds stamp) const;

 private:
  struct Pose {
    Nanoseconds stamp;
    Vector2 position_m;
    double heading_rad;
  };
  std::vector<Pose> poses_;
  Vector2 lever_m_;
  double reach_m_ = 0.0;
};

/// Fit of the fixes from `begin` to `end`. @param lag the fixes are stamped this much too early
/// Nothing with fewer than two fixes or no distance between them.
std::optional<DriveFit> fitDrive(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end, Nanoseconds lag = 0);

/// Mean height of the fixes from `begin` to `end`, weighted as above; that of the first fix if there are none.
double meanHeight(const std::vector<PositionFix>& fixes, Nanoseconds begin, Nanoseconds end);

/// How much too early the fixes are stamped (below zero: too late) relative to wheels and gyro; nothing if they agree
/// as well as they can.
std::optional<double> lagOfFixes(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end);

/// In words, with cause and remedy.
std::string describeLag(double lag_s);

}  // namespace slipnav
