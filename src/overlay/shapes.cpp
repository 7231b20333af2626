#include "overlay/shapes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

constexpr int kOutlineSegments = 48;
constexpr double kStandingSpeed_mps = 0.05;
constexpr double kSmoothing_s = 3.0;
constexpr double kTurnFading_s = 5.0;

/// Closed outline of center + cos·a + sin·b.
std::vector<Vector3> outline(const Vector3& center, const Vector3& a, const Vector3& b) {
  std::vector<Vector3> points;
  points.reserve(kOutlineSegments + 1);
  for (int i = 0; i <= kOutlineSegments; ++i) {
    const double angle_rad = 2.0 * kPi * static_cast<double>(i % kOutlineSegments) / kOutlineSegments;
    points.emplace_back(center + std::cos(angle_rad) * a + std::sin(angle_rad) * b);
  }
  return points;
}

Vector3 horizontal(double length, double direction_rad) {
  return {length * std::cos(direction_rad), length * std::sin(direction_rad), 0.0};
}

double directionAfter(const Course& course, double time_s) {
  return course.direction_rad + course.turn_rate_radps * kTurnFading_s * (1.0 - std::exp(-time_s / kTurnFading_s));
}

/// An angle's difference in [−π, π].
double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * kPi); }

}  // namespace

std::vector<Vector3> errorEllipse(const Vector3& center_enu_m, const Matrix3& covariance_enu_m2, double sigmas) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_enu_m2.topLeftCorner<2, 2>());
  const Vector2 lengths = sigmas * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  Vector3 a = Vector3::Zero();
  Vector3 b = Vector3::Zero();
  a.head<2>() = lengths(0) * axes.eigenvectors().col(0);
  b.head<2>() = lengths(1) * axes.eigenvectors().col(1);
  return outline(center_enu_m, a, b);
}

std::vector<Vector3> circle(const Vector3& center_enu_m, double radius_m) {
  return outline(center_enu_m, radius_m * Vector3::UnitX(), radius_m * Vector3::UnitY());
}

void CourseEstimate::add(Nanoseconds stamp, const Vector3& position_enu_m, const Vector3& velocity_enu_mps) {
  const double dt_s = toSeconds(stamp - stamp_);
  stamp_ = stamp;
  course_.position_enu_m = position_enu_m;
  const double speed_mps = velocity_enu_mps.head<2>().norm();
  if (speed_mps < kStandingSpeed_mps) {
    return;
  }
  const double direction_rad = std::atan2(velocity_enu_mps.y(), velocity_enu_mps.x());
  if (!known_ || dt_s <= 0.0) {
    course_ = {position_enu_m, direction_rad, speed_mps, 0.0};
    known_ = true;
    return;
  }
  // Direction and turn rate as an alpha-beta filter with one time constant, critically damped.
  const double gain = std::min(1.0, dt_s / kSmoothing_s);
  const double predicted_rad = course_.direction_rad + course_.turn_rate_radps * dt_s;
  const double residual_rad = wrapped(direction_rad - predicted_rad);
  course_.direction_rad = wrapped(predicted_rad + 2.0 * gain * residual_rad);
  course_.turn_rate_radps += gain * residual_rad / kSmoothing_s;
  course_.speed_mps += gain * (speed_mps - course_.speed_mps);
}

Vector3 positionAfter(const Course& course, double time_s) {
  constexpr double kStep_s = 0.5;
  Vector3 position = course.position_enu_m;
  for (double t_s = 0.0; t_s < time_s; t_s += kStep_s) {
    const double step_s = std::min(kStep_s, time_s - t_s);
    position += horizontal(course.speed_mps * step_s, directionAfter(course, t_s + 0.5 * step_s));
  }
  return position;
}

std::vector<FanSection> forecastFan(const Course& course, const std::vector<double>& times_s,
                                    const std::vector<double>& bounds_m, std::size_t max_sections) {
  const std::size_t n = std::min(times_s.size(), bounds_m.size());
  const std::size_t stride = std::max<std::size_t>(1, (n + max_sections - 1) / std::max<std::size_t>(1, max_sections));
  std::vector<FanSection> sections;
  for (std::size_t i = (n + stride - 1) % stride; i < n; i += stride) {
    const Vector3 to_left = horizontal(bounds_m[i], directionAfter(course, times_s[i]) + 0.5 * kPi);
    const Vector3 center = positionAfter(course, times_s[i]);
    sections.push_back({times_s[i], bounds_m[i], center, center + to_left, center - to_left});
  }
  return sections;
}

}  // namespace slipnav
