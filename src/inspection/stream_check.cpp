#include "inspection/stream_check.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"

namespace slipnav {
namespace {

/// Longer than this many usual intervals, and than kGap_s, is a loss and not jitter.
constexpr double kGapFactor = 3.0;
constexpr double kGap_s = 0.5;
/// Stamps from a clock read at the time of sampling scatter by less than this share of an interval.
constexpr double kEvenJitter = 0.1;
/// Relative to the usual interval.
constexpr double kOffPace = 0.25;
/// A clock ahead by this much more than messages were delayed was set.
constexpr double kLongestJump_s = 60.0;
/// An occasional repeated stamp does no harm.
constexpr double kFewEqual = 0.01;

struct Intervals {
  std::vector<double> forward_s;
  StreamStatistics counts;
};

Intervals intervalsOf(const std::vector<MessageTime>& times) {
  Intervals result;
  Nanoseconds before = 0;
  for (const MessageTime& time : times) {
    result.counts.zero += time.stamp == 0 ? 1 : 0;
    if (before != 0 && time.stamp != 0) {
      const Nanoseconds interval = time.stamp - before;
      if (interval > 0) {
        result.forward_s.push_back(toSeconds(interval));
      } else if (interval == 0) {
        ++result.counts.equal;
      } else if (interval <= -kRestartBackstep) {
        result.counts.set_back_s.push_back(toSeconds(-interval));  // the usual interval is added once known
      } else {
        ++result.counts.backwards;
      }
    }
    before = time.stamp;
  }
  return result;
}

void noteIntervals(const std::vector<double>& forward_s, StreamStatistics& statistics) {
  if (forward_s.empty()) {
    return;
  }
  statistics.interval_s = median(forward_s);
  for (double& step_s : statistics.set_back_s) {
    step_s += statistics.interval_s;
  }
  statistics.jitter_s = 0.5 * (percentile(forward_s, 98.0) - percentile(forward_s, 2.0));
  double covered_s = 0.0;
  statistics.off_pace =
      static_cast<std::size_t>(std::count_if(forward_s.begin(), forward_s.end(), [&statistics](double interval_s) {
        return std::abs(interval_s / statistics.interval_s - 1.0) > kOffPace;
      }));
  for (const double interval_s : forward_s) {
    if (interval_s > std::max(kGapFactor * statistics.interval_s, kGap_s)) {
      statistics.gaps_s.push_back(interval_s);
    } else {
      covered_s += interval_s;
    }
  }
  const auto usual = static_cast<double>(forward_s.size() + statistics.equal - statistics.gaps_s.size());
  statistics.rate_hz = covered_s > 0.0 ? usual / covered_s : 0.0;
}

/// Until a clock is set back: after that it means something else.
double medianDelay(const std::vector<MessageTime>& times) {
  std::vector<double> delays_s;
  Nanoseconds before = 0;
  for (const MessageTime& time : times) {
    if (time.stamp - before <= -kRestartBackstep && time.stamp != 0) {
      break;
    }
    if (time.stamp != 0) {
      delays_s.push_back(toSeconds(time.received - time.stamp));
      before = time.stamp;
    }
  }
  return delays_s.empty() ? 0.0 : median(std::move(delays_s));
}

void checkSetting(const std::string& topic, const StreamStatistics& statistics, Findings& findings) {
  if (statistics.zero > 0) {
    const bool all = statistics.zero == statistics.messages;
    findings.push_back({all ? Severity::kUnusable : Severity::kDoubtful, topic,
                        "stamps of " + topic + " are zero in " + std::to_string(statistics.zero) + " of " +
                            counted(statistics.messages, "message"),
                        "set header.stamp in the driver, to when the sample was taken"});
  }
  if (!statistics.set_back_s.empty()) {
    const double largest_s = *std::max_element(statistics.set_back_s.begin(), statistics.set_back_s.end());
    findings.push_back({Severity::kDoubtful, topic,
                        "the clock was set back " + counted(statistics.set_back_s.size(), "time") + ", by up to " +
                            decimal(largest_s, 2) + " s",
                        "the estimate continues across steps up to a minute; let a time server slew the clock instead "
                        "(chronyd without makestep)"});
  }
}

void checkOrder(const std::string& topic, const StreamStatistics& statistics, Findings& findings) {
  const auto messages = static_cast<double>(statistics.messages);
  if (static_cast<double>(statistics.equal) > kFewEqual * messages) {
    findings.push_back({Severity::kDoubtful, topic,
                        std::to_string(statistics.equal) + " of " + counted(statistics.messages, "message") +
                            " have the stamp of the previous message",
                        "stamp each sample when it was taken; until then the estimator spreads them evenly"});
  }
  if (statistics.backwards > 0) {
    findings.push_back({Severity::kDoubtful, topic,
                        counted(statistics.backwards, "message") + " stamped before the one that came earlier",
                        "look for a second publisher of the topic, or a network that reorders"});
  }
  if (!statistics.gaps_s.empty()) {
    const double largest_s = *std::max_element(statistics.gaps_s.begin(), statistics.gaps_s.end());
    findings.push_back({Severity::kDoubtful, topic,
                        counted(statistics.gaps_s.size(), "gap") + ", the longest " + decimal(largest_s, 2) + " s",
                        "record on the robot itself, and with rosbag record --buffsize=0"});
  }
}

void checkPace(const std::string& topic, const StreamStatistics& statistics, const StreamNeeds& needs,
               Findings& findings) {
  if (statistics.rate_hz > 0.0 &&
      (statistics.rate_hz < needs.least_rate_hz || statistics.rate_hz > needs.most_rate_hz)) {
    findings.push_back({Severity::kDoubtful, topic,
                        "comes at " + decimal(statistics.rate_hz, 1) + " Hz, where " + decimal(needs.least_rate_hz, 0) +
                            " to " + decimal(needs.most_rate_hz, 0) + " Hz are required",
                        "choose another rate in the driver"});
  }
  if (needs.even && statistics.jitter_s > kEvenJitter * statistics.interval_s) {
    findings.push_back({Severity::kDoubtful, topic,
                        "stamp intervals scatter by ±" + decimal(1e3 * statistics.jitter_s, 1) + " ms about " +
                            decimal(1e3 * statistics.interval_s, 1) + " ms",
                        "let the driver stamp when the sample was taken; see wheel.stamp_std_s"});
  } else if (statistics.off_pace > 0 && statistics.jitter_s <= kEvenJitter * statistics.interval_s) {
    findings.push_back({Severity::kRemark, topic,
                        counted(statistics.off_pace, "interval") + " off the usual " +
                            decimal(1e3 * statistics.interval_s, 1) + " ms by more than a quarter",
                        "nothing: single stamps are corrected or rejected"});
  }
}

}  // namespace

StreamStatistics statisticsOf(const std::vector<MessageTime>& times) {
  const Intervals intervals = intervalsOf(times);
  StreamStatistics statistics = intervals.counts;
  statistics.messages = times.size();
  noteIntervals(intervals.forward_s, statistics);
  statistics.delay_s = medianDelay(times);
  return statistics;
}

void checkStream(const std::string& topic, const StreamStatistics& statistics, const StreamNeeds& needs,
                 Findings& findings) {
  checkSetting(topic, statistics, findings);
  checkOrder(topic, statistics, findings);
  checkPace(topic, statistics, needs, findings);
}

std::vector<double> continuousTimes(const std::vector<MessageTime>& times, Nanoseconds origin) {
  const double usual_s = statisticsOf(times).interval_s;
  std::vector<double> result;
  result.reserve(times.size());
  double offset_s = 0.0;
  const MessageTime* before = nullptr;
  for (const MessageTime& time : times) {
    if (time.stamp == 0) {
      result.push_back(toSeconds(time.received - origin));
      continue;
    }
    if (before != nullptr) {
      const double stamps_s = toSeconds(time.stamp - before->stamp);
      const double received_s = toSeconds(time.received - before->received);
      if (stamps_s <= -toSeconds(kRestartBackstep) || stamps_s - received_s > kLongestJump_s) {
        offset_s += std::clamp(received_s, std::min(usual_s, kLongestJump_s), kLongestJump_s) - stamps_s;
      }
    }
    before = &time;
    result.push_back(toSeconds(time.stamp - origin) + offset_s);
  }
  return result;
}

}  // namespace slipnav
