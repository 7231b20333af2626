/// The part of FilterEngine that takes satellite fixes.

#include <algorithm>
#include <limits>
#include <utility>

#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {
namespace {

constexpr std::size_t kMaxFixes = 4096;  // not yet applied

bool earlier(const AntennaFix& a, const AntennaFix& b) {
  return std::pair(stampOf(a), a.index()) < std::pair(stampOf(b), b.index());
}

}  // namespace

bool FilterEngine::push(const AntennaFix& fix) {
  const bool finite = std::visit([](const auto& f) { return isFinite(f); }, fix);
  if (!finite || (initialized_ && stampOf(fix) <= state_.stamp)) {
    return false;
  }
  if (fixes_.size() >= kMaxFixes) {
    fixes_.pop_front();
  }
  fixes_.insertSorted(fix, earlier);
  return true;
}

Nanoseconds FilterEngine::fixesKnownUntil() const {
  if (!setup_.gnss.always()) {
    return std::numeric_limits<Nanoseconds>::max();
  }
  Nanoseconds known = fix_interval_.newest();
  for (std::size_t i = 0; i < fixes_.size() && !fix_interval_.isHole(known, stampOf(fixes_[i])); ++i) {
    known = stampOf(fixes_[i]);
  }
  return std::max({known, fix_interval_.quietUntil() - 1, fixes_complete_until_});
}

bool FilterEngine::applyFixes(const InsStep& step) {
  const Vector3& lever_b = setup_.lever_imu_to_antenna_b;
  bool corrected = false;
  while (!fixes_.empty() && stampOf(fixes_.front()) <= state_.stamp) {
    MeasurementSet set;
    if (const auto* position = std::get_if<PositionFix>(&fixes_.front())) {
      addFix(*position, set);
    } else {
      set.add(kFixVelocity, velocityMeasurement(planet_, std::get<VelocityFix>(fixes_.front()), state_, step.f_ib_b,
                                                step.omega_ib_b, lever_b));
    }
    const Nanoseconds stamp = stampOf(fixes_.front());
    if (update(set)) {
      corrected = true;
      used_fix_ = stamp;
    }
    if (stamp > fix_interval_.newest()) {
      fix_interval_.add(stamp);
    }
    fixes_.pop_front();
  }
  return corrected;
}

/// Gated by the receiver's covariance, and weighted by what it adds to earlier fixes.
void FilterEngine::addFix(const PositionFix& fix, MeasurementSet& set) const {
  const double factor = setup_.gnss.always() && used_fix_ != 0
                            ? repeatedFixFactor(toSeconds(fix.stamp - used_fix_), setup_.gnss.correlation_s)
                            : 1.0;
  set.add(kFixPosition, positionMeasurement(planet_, fix, state_, setup_.lever_imu_to_antenna_b), factor);
}

}  // namespace slipnav
