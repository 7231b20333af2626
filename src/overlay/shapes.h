#pragma once
/// Outlines of the navigation's own error: ellipse now, fan ahead.

#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Horizontal ellipse of `sigmas` standard deviations as a closed outline (the last point is the first).
/// @param covariance_enu_m2 of the position; only its horizontal part counts
std::vector<Vector3> errorEllipse(const Vector3& center_enu_m, const Matrix3& covariance_enu_m2, double sigmas);

/// Horizontal circle as a closed outline.
std::vector<Vector3> circle(const Vector3& center_enu_m, double radius_m);

/// Where the rover is and how it moves.
struct Course {
  Vector3 position_enu_m = Vector3::Zero();
  double direction_rad = 0.0;    ///< of the motion over ground, from east, counter-clockwise
  double speed_mps = 0.0;        ///< along it, not negative
  double turn_rate_radps = 0.0;  ///< counter-clockwise
};

/// Follows the motion, smoothed over seconds so that a rocking rover does not swing its forecast. Standing keeps the
/// last motion.
class CourseEstimate {
 public:
  void clear() { known_ = false; }
  /// @param velocity_enu_mps of the rover over ground; stamps ascend
  void add(Nanoseconds stamp, const Vector3& position_enu_m, const Vector3& velocity_enu_mps);

  bool known() const { return known_; }
  const Course& course() const { return course_; }

 private:
  bool known_ = false;
  Nanoseconds stamp_ = 0;
  Course course_;
};

/// Position on the course after a time. The turn fades within seconds: rovers turn for a moment and drive straight on.
Vector3 positionAfter(const Course& course, double time_s);

/// One cross-section of the forecast fan.
struct FanSection {
  double time_s = 0.0;
  double bound_m = 0.0;
  Vector3 center_enu_m = Vector3::Zero();
  Vector3 left_enu_m = Vector3::Zero();   ///< `bound_m` to the left of the center
  Vector3 right_enu_m = Vector3::Zero();  ///< and to the right
};

/// Cross-sections of half-width `bounds_m[i]` at `times_s[i]` along the course. At most `max_sections` of them; the
/// last one is always included.
std::vector<FanSection> forecastFan(const Course& course, const std::vector<double>& times_s,
                                    const std::vector<double>& bounds_m, std::size_t max_sections = 61);

}  // namespace slipnav
