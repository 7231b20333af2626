#pragma once
/// Stamps of one topic: rate, jitter, losses, repeated and missing ones, clocks set back.

#include <string>
#include <vector>

#include "inspection/finding.h"
#include "inspection/recording.h"

namespace slipnav {

/// Everything that follows from the stamps alone.
struct StreamStatistics {
  std::size_t messages = 0;
  std::size_t zero = 0;            ///< stamps that are not set
  std::size_t equal = 0;           ///< stamps equal to that of the previous message
  std::size_t backwards = 0;       ///< stamps before that of the previous message, by less than a second
  std::vector<double> set_back_s;  ///< by how much the clock was set back, a second or more
  std::vector<double> gaps_s;      ///< intervals of more than three usual ones and half a second
  std::size_t off_pace = 0;        ///< intervals that differ from the usual one by more than a quarter
  double interval_s = 0.0;         ///< median
  double rate_hz = 0.0;            ///< messages over the time without gaps
  double jitter_s = 0.0;           ///< half of the span from the 2nd to the 98th percentile of the intervals
  double delay_s = 0.0;            ///< median of receive time less stamp
};

StreamStatistics statisticsOf(const std::vector<MessageTime>& times);

template <class Record>
std::vector<MessageTime> timesOf(const Record& record) {
  std::vector<MessageTime> times;
  times.reserve(record.samples.size());
  for (const auto& sample : record.samples) {
    times.push_back(sample.time);
  }
  return times;
}

/// Requirements of a role on its topic.
struct StreamNeeds {
  double least_rate_hz = 0.0;  ///< below, it is of little use
  double most_rate_hz = 1e9;
  bool even = false;  ///< irregular intervals do harm, and are not checked elsewhere
};

void checkStream(const std::string& topic, const StreamStatistics& statistics, const StreamNeeds& needs,
                 Findings& findings);

/// Stamps [s] in a time that continues across clock steps, judged by arrival; the time of receipt for stamps that
/// are not set.
std::vector<double> continuousTimes(const std::vector<MessageTime>& times, Nanoseconds origin);

}  // namespace slipnav
