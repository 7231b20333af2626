#pragma once
/// The path the operator follows: a straight start, then gentle bends and an occasional sharp turn.

#include <vector>

#include "simulation/random.h"
#include "slipnav/core/base/types.h"

namespace slipnav::sim {

/// A point of the path in the tangent plane at the start.
struct RoutePoint {
  double east_m = 0.0;
  double north_m = 0.0;
  double heading_rad = 0.0;  ///< from north towards east
};

/// What follows the straight start.
enum class RouteShape { kWinding, kCircle, kStraight };

/// A polyline, and the rover's progress on it.
class Route {
 public:
  /// @param straight_m length of the straight start
  /// @param length_m total length that must be available
  /// @param radius of the circle [m]; of a winding route: factor on the radii of its turns
  Route(std::uint64_t seed, double straight_m, double length_m, RouteShape shape = RouteShape::kWinding,
        double radius = 1.0);

  /// Heading of the straight start [rad].
  double startHeading() const { return points_.front().heading_rad; }

  /// Curvature [1/m], positive to the right, of the arc from the pose to the point `lookahead_m` further on the path
  /// (pure pursuit). Moves the progress forward to the point nearest to the pose, never back.
  double pursue(const RoutePoint& pose, double lookahead_m);

 private:
  void append(double curvature_per_m);
  /// Legs and turns until the length is reached.
  void wind(RandomStream& stream, std::size_t count, double radius_factor);
  /// An arc to a heading, the shorter way round.
  void appendTurn(double heading_rad, double radius_m);
  /// A gentle double bend that ends with its initial heading.
  void appendLeg(double length_m, double bend_per_m);

  std::vector<RoutePoint> points_;  ///< kSpacing apart
  std::size_t nearest_ = 0;
};

}  // namespace slipnav::sim
