#include "ros/messages/fix_input.h"

#include <limits>
#include <optional>

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kKept = 300 * kSecond;  // of a recording played fast, until a start is known

}  // namespace

FixInput::FixInput(const Config& config)
    : topic_(config.topics.gps_fix),
      stamp_offset_(fromSeconds(config.initialization.fix_stamp_offset_s)),
      max_wait_(fromSeconds(config.gnss.max_wait_s)) {}

std::vector<PositionFix> FixInput::take(const sensor_msgs::NavSatFix& message, const ContinuousTime& time) {
  std::vector<PositionFix> fixes;
  problem_ = complaintOf(message, topic_);
  std::optional<GnssFix> fix = problem_.empty() ? toGnssFix(message) : std::nullopt;
  if (fix) {
    fix->stamp += stamp_offset_;
    jumps_.push(toPositionFix(*fix), [&](PositionFix passed) {
      steps_.add(passed.stamp);
      passed.stamp = time.toContinuous(passed.stamp, steps_.steps());
      keep(passed);
      fixes.push_back(passed);
    });
  }
  return fixes;
}

/// A fix that is a second older than the newest one comes from a clock that has restarted.
void FixInput::keep(const PositionFix& fix) {
  if (!newest_.empty() && fix.stamp <= newest_.back().stamp - kRestartBackstep) {
    newest_.clear();
  }
  newest_.push_back(fix);
  while (newest_.front().stamp < fix.stamp - kKept) {
    newest_.pop_front();
  }
}

std::vector<PositionFix> FixInput::after(Nanoseconds stamp) const {
  std::vector<PositionFix> fixes;
  for (const PositionFix& fix : newest_) {
    if (fix.stamp > stamp && fix.stamp < stamp + kKept) {
      fixes.push_back(fix);
    }
  }
  return fixes;
}

Nanoseconds FixInput::decidedAt(Nanoseconds known) const {
  constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();
  return known == kNever ? kNever : known + max_wait_;
}

}  // namespace slipnav
