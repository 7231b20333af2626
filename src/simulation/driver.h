#pragma once
/// The scripted operator, who sees the true pose: rest, straight initialization drive, winding route, rest.

#include "simulation/params.h"
#include "simulation/route.h"
#include "simulation/simulator.h"
#include "simulation/truth_state.h"

namespace slipnav::sim {

/// Advances through its phases by what it sees of the rover.
class Driver {
 public:
  explicit Driver(const SimulatorParams& params);

  /// The path defined by these parameters.
  static Route routeOf(const SimulatorParams& params);

  /// Command for the next interval. A rover given a different one, because it is being stopped, continues from
  /// where it is.
  Command command(const TruthState& truth);

  /// The initial rest and the straight drive are over: the counted distance has begun.
  bool initializationDriveDone() const { return phase_ >= Phase::kRoute; }
  /// Distance and final rest are done.
  bool finished() const { return phase_ == Phase::kFinished; }

 private:
  enum class Phase { kInitialRest, kInitialStraight, kRoute, kFinalRest, kFinished };

  void advancePhase(const TruthState& truth);
  double steer(const TruthState& truth);

  DriveParams params_;
  Route route_;
  Nanoseconds start_stamp_;
  Nanoseconds rest_start_stamp_ = 0;
  double route_start_m_ = 0.0;
  Phase phase_ = Phase::kInitialRest;
};

}  // namespace slipnav::sim
