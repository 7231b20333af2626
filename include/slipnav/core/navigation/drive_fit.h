#pragma once
/// The heading at the start, from a drive under satellite positions: the track by wheels and gyro is laid on the fixes.
///
/// p_i = o + s R(ψ) q_i with fixes p, track of the antenna q, heading ψ, start o and scale s (wheel radius, slip), by
/// weighted least squares in closed form (Umeyama 1991), weights from the fixes' own covariances, reweighted for a
/// Student-t distribution of their errors (Lange, Little, Taylor 1989): a fix that is off beyond what it says of itself
/// counts little.

#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/earth/planet.h"
#include "slipnav/core/navigation/start_recording.h"

namespace slipnav {

/// What the drive says.
struct DriveFit {
  double heading_rad = 0.0;              ///< at the start, clockwise from north
  double heading_std_rad = 0.0;          ///< by the fixes' own covariances
  double scale = 1.0;                    ///< way by fixes over way by wheels
  double distance_m = 0.0;               ///< from the start, by wheels and gyro
  double residual_m = 0.0;               ///< root mean square of what is left, by the weights
  double fix_std_m = 0.0;                ///< the same, as the fixes say
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
  /// None outside the recording.
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

/// Of the fixes from `begin` to `end`. @param lag the fixes are stamped this much too early
/// None with fewer than two fixes or no way between them.
std::optional<DriveFit> fitDrive(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end, Nanoseconds lag = 0);

/// Mean height of the fixes from `begin` to `end`, weighted as above; the first fix's where there are none.
double meanHeight(const std::vector<PositionFix>& fixes, Nanoseconds begin, Nanoseconds end);

/// By how much the fixes are stamped too early (or late, below zero) against wheels and gyro; none where they agree as
/// well as they can.
std::optional<double> lagOfFixes(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end);

/// In words, with cause and remedy.
std::string describeLag(double lag_s);

}  // namespace slipnav
