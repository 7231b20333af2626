#pragma once
/// A time that continues when a robot's clock is set back while driving.
///
/// A clock set back, by a time server or by hand, says nothing about the rover, which keeps driving. Stamps of all
/// sensors then continue from the previous one, after one usual IMU interval, and published stamps are converted
/// back to the clock. If a clock goes back by more than a minute, or to where it started, a recording
/// is being played again, or another one: then nothing is carried over.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "slipnav/core/base/types.h"
#include "slipnav/core/ordering/usual_interval.h"

namespace slipnav {

/// A clock that goes back by more has restarted.
inline constexpr Nanoseconds kLongestSetBack = 60 * kSecond;
/// So has one that goes back to this soon after its first stamp.
inline constexpr Nanoseconds kBeginning = 2 * kSecond;

/// From `begin` on, continuous time is the clock plus `offset`.
struct ClockStep {
  Nanoseconds begin = 0;  ///< in continuous time
  Nanoseconds offset = 0;
};

/// Converts stamps to continuous time and back. Depends only on stamps.
class ContinuousTime {
 public:
  ContinuousTime() = default;
  /// With steps found elsewhere.
  explicit ContinuousTime(std::vector<ClockStep> steps) : steps_(std::move(steps)) {}

  /// The stamp of an IMU sample, in the order in which they are processed, in continuous time.
  Nanoseconds add(Nanoseconds stamp);

  /// @param steps number of steps before the stamp was made; if that many are not known the last one counts
  Nanoseconds toContinuous(Nanoseconds stamp, std::size_t steps) const;
  Nanoseconds toClock(Nanoseconds continuous) const;

  /// Since the clock started.
  const std::vector<ClockStep>& steps() const { return steps_; }

  /// By how much the newest step set the clock back; nothing if there was none [s].
  std::optional<double> newestStep_s() const;

 private:
  std::vector<ClockStep> steps_;
  UsualInterval usual_;
  Nanoseconds first_ = 0;   ///< by the clock, since it started
  Nanoseconds newest_ = 0;  ///< likewise
};

/// Counts how often the clock of one sensor was set back, as ContinuousTime does for the IMU.
class StepCount {
 public:
  void add(Nanoseconds stamp);

  /// Since the clock started.
  std::size_t steps() const { return steps_; }
  void setSteps(std::size_t steps) { steps_ = steps; }
  /// In total, including those at which the clock restarted.
  std::size_t all() const { return all_; }

 private:
  Nanoseconds first_ = 0;
  Nanoseconds newest_ = 0;
  std::size_t steps_ = 0;
  std::size_t all_ = 0;
};

}  // namespace slipnav
