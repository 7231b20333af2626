#include "slipnav/sim/route.h"

#include <algorithm>
#include <cmath>

#include "slipnav/math/rotation.h"

namespace slipnav::sim {
namespace {

constexpr double kSpacing_m = 0.1;

std::size_t steps(double length_m) { return static_cast<std::size_t>(std::ceil(length_m / kSpacing_m)); }

}  // namespace

Route::Route(std::uint64_t seed, double straight_m, double length_m) {
  RandomStream stream(seed, "route");
  double bearing_rad = stream.uniform(-kPi, kPi);
  points_.push_back({0.0, 0.0, bearing_rad});
  while (points_.size() <= steps(straight_m)) {
    append(0.0);
  }
  // the operator tacks about a slowly wandering bearing: a leg with a gentle double bend, then a turn to the other side
  double side = stream.uniform() < 0.5 ? -1.0 : 1.0;
  while (points_.size() <= steps(length_m)) {
    bearing_rad += degToRad(12.0) * stream.normal();
    const double target_rad = bearing_rad + side * degToRad(stream.uniform(25.0, 60.0));
    const double turn_rad = wrapToPi(target_rad - points_.back().heading_rad);
    const double radius_m = stream.uniform(2.5, 6.0);
    for (std::size_t i = steps(std::abs(turn_rad) * radius_m); i > 0; --i) {
      append(std::copysign(1.0 / radius_m, turn_rad));
    }
    const std::size_t leg = steps(stream.uniform(15.0, 50.0));
    const double bend_per_m = stream.uniform(-0.05, 0.05);
    for (std::size_t i = 0; i < leg; ++i) {
      append(bend_per_m * std::sin(2.0 * kPi * static_cast<double>(i) / static_cast<double>(leg)));
    }
    side = -side;
  }
}

void Route::append(double curvature_per_m) {
  const RoutePoint& last = points_.back();
  const double heading_rad = last.heading_rad + curvature_per_m * kSpacing_m;
  const double mean_rad = 0.5 * (last.heading_rad + heading_rad);
  points_.push_back({last.east_m + kSpacing_m * std::sin(mean_rad), last.north_m + kSpacing_m * std::cos(mean_rad),
                     heading_rad});
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
