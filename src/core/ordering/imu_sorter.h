#pragma once
/// Puts IMU samples that overtook each other back in order.
///
/// Where a sample seems to be missing, later ones wait until it arrives, or until two of them wait: no transport
/// reorders by more. So a lost sample delays an estimate by two intervals, and nothing else waits.

#include <cstdint>

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ordering/sample_interval.h"

namespace slipnav {

/// For one source; samples that are repeated or too late are passed on for others to judge.
class ImuSorter {
 public:
  /// Passes to `sink` the samples that are due.
  template <class Sink>
  void push(const ImuSample& sample, const Sink& sink) {
    if (sample.stamp <= interval_.newest() - kRestartBackstep) {  // a source that has restarted
      release(0, sink);
      interval_.restart(sample.stamp);
    }
    if (sample.stamp <= interval_.newest()) {
      sink(sample);
      return;
    }
    overtaken_ += !waiting_.empty() && sample.stamp < waiting_.back().stamp ? 1 : 0;
    waiting_.insertSorted(sample, [](const ImuSample& a, const ImuSample& b) { return a.stamp < b.stamp; });
    release(kPlaces, sink);
  }

  /// How many have been put back in order.
  std::uint64_t overtaken() const { return overtaken_; }

 private:
  bool isAfterHole(const ImuSample& sample) const {
    return interval_.isLearned() && interval_.isHole(interval_.newest(), sample.stamp);
  }

  static constexpr std::size_t kPlaces = 2;
  static constexpr double kLongestInterval_s = 0.2;

  /// Releases what follows without a hole, and anything beyond `places`.
  template <class Sink>
  void release(std::size_t places, const Sink& sink) {
    while (!waiting_.empty() && (waiting_.size() > places || !isAfterHole(waiting_.front()))) {
      const ImuSample sample = waiting_.front();
      waiting_.pop_front();
      interval_.add(sample.stamp);
      sink(sample);
    }
  }

  SampleInterval interval_{kLongestInterval_s};
  RingQueue<ImuSample> waiting_;
  std::uint64_t overtaken_ = 0;
};

}  // namespace slipnav
