#pragma once
/// A time that goes on when the clock of a robot is set back while it drives.
///
/// A clock that is set back, by a time server or by hand, says nothing about the rover, which drives on. Stamps of all
/// sensors then go on from the last one before, after one usual interval of the IMU, and what is published is turned
/// back into what the clock says. Where a clock goes back by more than a minute, or to where it has begun, a recording
/// is played again, or another one: then nothing is carried over.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "slipnav/core/base/types.h"
#include "slipnav/core/ordering/usual_interval.h"

namespace slipnav {

/// A clock that goes back by more has begun again.
inline constexpr Nanoseconds kLongestSetBack = 60 * kSecond;
/// So has one that goes back to this soon after its first stamp.
inline constexpr Nanoseconds kBeginning = 2 * kSecond;

/// From `begin` on, continuous time is that of the clock and `offset`.
struct ClockStep {
  Nanoseconds begin = 0;  ///< in continuous time
  Nanoseconds offset = 0;
};

/// Turns stamps into continuous time and back. Depends on stamps alone.
class ContinuousTime {
 public:
  ContinuousTime() = default;
  /// The steps that somebody else has found.
  explicit ContinuousTime(std::vector<ClockStep> steps) : steps_(std::move(steps)) {}

  /// The stamp of an IMU sample, in the order in which they are processed, in continuous time.
  Nanoseconds add(Nanoseconds stamp);

  /// @param steps how many there were before the stamp was made; of those that are not known the last one counts
  Nanoseconds toContinuous(Nanoseconds stamp, std::size_t steps) const;
  Nanoseconds toClock(Nanoseconds continuous) const;

  /// Since the clock has begun.
  const std::vector<ClockStep>& steps() const { return steps_; }

  /// By how much the clock was set back by the newest step; nothing when there was none [s].
  std::optional<double> newestStep_s() const;

 private:
  std::vector<ClockStep> steps_;
  UsualInterval usual_;
  Nanoseconds first_ = 0;   ///< by the clock, since it has begun
  Nanoseconds newest_ = 0;  ///< likewise
};

/// Counts how often the clock of one sensor was set back, as ContinuousTime does for the IMU.
class StepCount {
 public:
  void add(Nanoseconds stamp);

  /// Since the clock has begun.
  std::size_t steps() const { return steps_; }
  void setSteps(std::size_t steps) { steps_ = steps; }
  /// Ever, those after which the clock has begun again counted in.
  std::size_t all() const { return all_; }

 private:
  Nanoseconds first_ = 0;
  Nanoseconds newest_ = 0;
  std::size_t steps_ = 0;
  std::size_t all_ = 0;
};

}  // namespace slipnav
