#include "core/stopping/obedience_watch.h"

#include <cmath>

namespace slipnav {
namespace {

/// Above what slip, noise and the wheel interval leave of a speed [m/s].
constexpr double kClearlyFaster_mps = 0.15;
/// Longer than a base takes to follow a step of its command [s].
constexpr double kFollowing_s = 1.8;

}  // namespace

void ObedienceWatch::observe(std::optional<double> told_mps, const RoverObservation& observation) {
  const bool faster = told_mps && !observation.stationary && !observation.wheels_at_rest &&
                      std::abs(observation.forward_mps) > *told_mps + kClearlyFaster_mps;
  if (!faster) {
    faster_since_.reset();
  } else if (!faster_since_ || observation.stamp < *faster_since_) {
    faster_since_ = observation.stamp;
  }
  ignored_ = faster && toSeconds(observation.stamp - *faster_since_) >= kFollowing_s;
}

}  // namespace slipnav
