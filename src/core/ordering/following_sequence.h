#pragma once
/// Samples of a sensor beside the IMU on their way to the filter: without single wrong stamps, in the continuous time
/// of the IMU, whose clock steps are reported by the mechanization.

#include <cstddef>
#include <cstdint>

#include "core/ordering/continuous_time.h"
#include "core/ordering/jump_filter.h"
#include "slipnav/core/base/ring_queue.h"

namespace slipnav {

/// A step of the clock and the samples after it arrive by two routes, so either may be first.
template <class Sample>
class FollowingSequence {
 public:
  /// @param jump see JumpFilter
  explicit FollowingSequence(Nanoseconds jump = JumpFilter<Sample>::kJump) : jumps_(jump) {}

  /// Passes to `sink` the samples whose time is now known: the given one, or none while a step of the clock is still to
  /// be reported.
  template <class Sink>
  void push(const Sample& sample, const Sink& sink) {
    jumps_.push(sample, [this, &sink](const Sample& passed) {
      count_.add(passed.stamp);
      if (count_.steps() == 0) {  // a clock that has restarted
        waiting_.clear();
      }
      if (waiting_.size() == kMaxWaiting) {
        waiting_.pop_front();
      }
      waiting_.push_back({passed, count_.steps()});
      release(sink);
    });
  }

  /// Takes the mechanization's view of the clock, and passes on the samples whose time is known from it.
  /// @return whether it is new
  template <class Sink>
  bool learn(const ContinuousTime& time, const Sink& sink) {
    const bool is_new = time.steps().size() != time_.steps().size();
    if (is_new) {
      time_ = time;
      release(sink);
    }
    return is_new;
  }

  /// The mechanization has restarted: earlier steps no longer count.
  void recount() {
    count_.setSteps(time_.steps().size());
    waiting_.clear();
  }

  const ContinuousTime& time() const { return time_; }
  /// Samples dropped for their stamps.
  std::uint64_t leftOut() const { return jumps_.leftOut(); }

 private:
  template <class Sink>
  void release(const Sink& sink) {
    for (; !waiting_.empty() && waiting_.front().steps <= time_.steps().size(); waiting_.pop_front()) {
      Sample sample = waiting_.front().sample;
      sample.stamp = time_.toContinuous(sample.stamp, waiting_.front().steps);
      sink(sample);
    }
  }

  static constexpr std::size_t kMaxWaiting = 65536;

  struct Waiting {
    Sample sample;
    std::size_t steps = 0;
  };

  JumpFilter<Sample> jumps_;
  ContinuousTime time_;
  StepCount count_;
  RingQueue<Waiting> waiting_;
};

}  // namespace slipnav
