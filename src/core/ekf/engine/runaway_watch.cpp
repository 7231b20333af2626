#include "slipnav/core/ekf/engine/runaway_watch.h"

#include <algorithm>

#include "core/ins/leveling.h"

namespace slipnav {
namespace {

constexpr double kFactor = 2.0;     // a wheel that locks at speed leaves the vehicle at that speed, once
constexpr double kBackward = 0.25;  // a vehicle that stands on spinning wheels may seem to move, either way
constexpr double kApart = 0.5;
constexpr double kLasting_s = 1.0;
constexpr double kLeast_mps = 0.1;   // wheels that have hardly turned yet give no reference
constexpr double kLeveling_s = 5.0;  // rocking over stones averages out, the approach to a slope is still included
constexpr double kShortest_s = 0.1;  // for leveling

}  // namespace

void RunawayWatch::addImu(const Vector3& f_ib_b, double duration_s) {
  averaged_s_ = std::min(averaged_s_ + duration_s, kLeveling_s);
  f_mean_b_ += duration_s / std::max(averaged_s_, duration_s) * (f_ib_b - f_mean_b_);
}

bool RunawayWatch::addWheels(Nanoseconds stamp, double wheels_mps, double speed_mps, double backward_mps,
                             double interval_s) {
  fastest_mps_ = std::max(fastest_mps_, wheels_mps);
  const double limit_mps = std::max(fastest_mps_, kLeast_mps);
  const double apart_mps = std::max(speed_mps - limit_mps, wheels_mps + backward_mps);
  way_apart_m_ = apart_mps > kApart * limit_mps ? way_apart_m_ + apart_mps * interval_s : 0.0;
  const bool explained = speed_mps <= kFactor * limit_mps && backward_mps <= kBackward * limit_mps;
  if (wheels_mps <= 0.0 || explained) {
    since_ = 0;
    return false;
  }
  since_ = since_ == 0 ? stamp : since_;
  if (toSeconds(stamp - since_) < kLasting_s) {
    return false;
  }
  since_ = 0;
  way_beyond_m_ = way_apart_m_;
  return true;
}

Vector2 RunawayWatch::level() const { return levelAtRest(f_mean_b_); }

double RunawayWatch::levelStd_rad(double gravity_mps2) const {
  return std::max(fastest_mps_, kLeast_mps) / std::max(averaged_s_, kShortest_s) / gravity_mps2;
}

}  // namespace slipnav
