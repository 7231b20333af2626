#include "simulation/driver.h"

#include <algorithm>

namespace slipnav::sim {
namespace {

constexpr double kLookahead_m = 1.2;
/// Look-ahead time at high speed.
constexpr double kLookahead_s = 0.5;
constexpr double kMaxYawRate_radps = 0.5;
/// The turns of a fast rover are wide enough for this sideways acceleration.
constexpr double kMaxLateral_mps2 = 2.5;
constexpr double kTightestTurn_m = 2.5;
/// The path stays straight beyond the initialization drive, so that looking ahead does not bend its end.
constexpr double kStraightReserve_m = 3.0;
/// The planned path is longer than the drive: a rover that weaves or stops late must not run out of path.
constexpr double kSpareRoute = 1.1;
constexpr double kSpareRoute_m = 20.0;

}  // namespace

Driver::Driver(const SimulatorParams& params)
    : params_(params.drive), route_(routeOf(params)), start_stamp_(fromSeconds(params.start_time_s)) {}

Route Driver::routeOf(const SimulatorParams& params) {
  const DriveParams& drive = params.drive;
  const bool circle = drive.route == "circle";
  const RouteShape shape = circle                      ? RouteShape::kCircle
                           : drive.route == "straight" ? RouteShape::kStraight
                                                       : RouteShape::kWinding;
  const double widening = std::max(1.0, drive.speed_mps * drive.speed_mps / (kMaxLateral_mps2 * kTightestTurn_m));
  return {static_cast<std::uint64_t>(params.seed), drive.initial_straight_m + kStraightReserve_m,
          kSpareRoute * (drive.initial_straight_m + drive.distance_m) + kSpareRoute_m, shape,
          circle ? drive.circle_radius_m : widening};
}

Command Driver::command(const TruthState& truth) {
  advancePhase(truth);
  const bool driving = phase_ == Phase::kInitialStraight || phase_ == Phase::kRoute;
  if (!driving) {
    return {};
  }
  return {params_.speed_mps, steer(truth)};
}

void Driver::advancePhase(const TruthState& truth) {
  if (phase_ == Phase::kInitialRest && toSeconds(truth.stamp - start_stamp_) >= params_.initial_rest_s) {
    phase_ = Phase::kInitialStraight;
  }
  if (phase_ == Phase::kInitialStraight && truth.distance_m >= params_.initial_straight_m) {
    phase_ = Phase::kRoute;
    route_start_m_ = truth.distance_m;
  }
  if (phase_ == Phase::kRoute && truth.distance_m - route_start_m_ >= params_.distance_m) {
    phase_ = Phase::kFinalRest;
  }
  if (phase_ == Phase::kFinalRest) {
    if (!truth.standstill || rest_start_stamp_ == 0) {
      rest_start_stamp_ = truth.stamp;
    }
    if (toSeconds(truth.stamp - rest_start_stamp_) >= params_.final_rest_s) {
      phase_ = Phase::kFinished;
    }
  }
}

double Driver::steer(const TruthState& truth) {
  const RoutePoint pose{truth.position_enu_m.x(), truth.position_enu_m.y(), truth.heading_rad};
  const double curvature_per_m = route_.pursue(pose, std::max(kLookahead_m, kLookahead_s * params_.speed_mps));
  return std::clamp(params_.speed_mps * curvature_per_m, -kMaxYawRate_radps, kMaxYawRate_radps);
}

}  // namespace slipnav::sim
