#include "simulation/route.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

struct Span {
  double min;
  double max;

  double draw(RandomStream& stream) const { return stream.uniform(min, max); }
};

constexpr double kSpacing_m = 0.1;
/// The operator tacks: legs lie alternately left and right of a bearing that wanders a little from leg to leg.
constexpr double kBearingWander_deg = 7.0;
constexpr Span kTack_deg{25.0, 57.0};
constexpr Span kLeg_m{15.0, 50.0};
constexpr Span kTurnRadius_m{2.5, 6.0};
constexpr double kMaxBend_per_m = 0.05;

std::size_t steps(double length_m) { return static_cast<std::size_t>(std::ceil(length_m / kSpacing_m)); }

}  // namespace

Route::Route(std::uint64_t seed, double straight_m, double length_m, RouteShape shape, double radius) {
  RandomStream stream(seed, "route");
  points_.push_back({0.0, 0.0, stream.uniform(-kPi, kPi)});
  while (points_.size() <= steps(straight_m)) {
    append(0.0);
  }
  if (shape == RouteShape::kWinding) {
    wind(stream, steps(length_m), radius);
  }
  while (points_.size() <= steps(length_m)) {
    append(shape == RouteShape::kCircle ? 1.0 / radius : 0.0);
  }
}

void Route::wind(RandomStream& stream, std::size_t count, double radius_factor) {
  double bearing_rad = points_.back().heading_rad;
  double side = stream.uniform() < 0.5 ? -1.0 : 1.0;
  while (points_.size() <= count) {
    bearing_rad += degToRad(kBearingWander_deg) * stream.normal();
    appendTurn(bearing_rad + side * degToRad(kTack_deg.draw(stream)), radius_factor * kTurnRadius_m.draw(stream));
    appendLeg(kLeg_m.draw(stream), stream.uniform(-kMaxBend_per_m, kMaxBend_per_m));
    side = -side;
  }
}

void Route::appendTurn(double heading_rad, double radius_m) {
  const double turn_rad = wrapToPi(heading_rad - points_.back().heading_rad);
  for (std::size_t i = steps(std::abs(turn_rad) * radius_m); i > 0; --i) {
    append(std::copysign(1.0 / radius_m, turn_rad));
  }
}

void Route::appendLeg(double length_m, double bend_per_m) {
  const std::size_t count = steps(length_m);
  for (std::size_t i = 0; i < count; ++i) {
    append(bend_per_m * std::sin(2.0 * kPi * static_cast<double>(i) / static_cast<double>(count)));
  }
}

void Route::append(double curvature_per_m) {
  const RoutePoint& last = points_.back();
  const double heading_rad = last.heading_rad + curvature_per_m * kSpacing_m;
  const double mean_rad = 0.5 * (last.heading_rad + heading_rad);
  points_.push_back(
      {last.east_m + kSpacing_m * std::sin(mean_rad), last.north_m + kSpacing_m * std::cos(mean_rad), heading_rad});
}

double Route::pursue(const RoutePoint& pose, double lookahead_m) {
  const auto distance_m = [&](std::size_t i) {
    return std::hypot(points_[i].east_m - pose.east_m, points_[i].north_m - pose.north_m);
  };
  while (nearest_ + 1 < points_.size() && distance_m(nearest_ + 1) < distance_m(nearest_)) {
    ++nearest_;
  }
  const RoutePoint& target = points_[std::min(nearest_ + steps(lookahead_m), points_.size() - 1)];
  const double east_m = target.east_m - pose.east_m;
  const double north_m = target.north_m - pose.north_m;
  const double right_m = east_m * std::cos(pose.heading_rad) - north_m * std::sin(pose.heading_rad);
  return 2.0 * right_m / std::max(east_m * east_m + north_m * north_m, kSpacing_m * kSpacing_m);
}

}  // namespace slipnav::sim
