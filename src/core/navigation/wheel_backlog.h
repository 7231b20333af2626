#pragma once
/// Wheel samples by session: each restart of the recording's clock has its own, with its own initial state.

#include <algorithm>

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// The initial state of a session comes by a different route than the wheel samples, so either may be first.
class WheelBacklog {
 public:
  /// Passes the sample to `sink`, unless its session's initial state is still awaited.
  template <class Sink>
  void push(const WheelMotion& wheels, const Sink& sink) {
    if (wheels.stamp <= newest_ - kRestartBackstep) {
      newest_ = wheels.stamp;
      started_ = outdated_;
      outdated_ = false;
      waiting_.clear();
    }
    newest_ = std::max(newest_, wheels.stamp);
    if (outdated_) {
      return;
    }
    if (started_) {
      sink(wheels);
      return;
    }
    if (waiting_.size() == kMaxWaiting) {
      waiting_.pop_front();
    }
    waiting_.push_back(wheels);
  }

  /// The initial state of the next session has arrived. Passes its samples so far to `sink`.
  template <class Sink>
  void startNext(const Sink& sink) {
    outdated_ = started_;
    started_ = true;
    for (; !waiting_.empty(); waiting_.pop_front()) {
      sink(waiting_.front());
    }
  }

  /// The filter pauses; samples wait for the initial state of a new start in the same session.
  void pause() { started_ = outdated_ = false; }

 private:
  static constexpr std::size_t kMaxWaiting = 65536;

  RingQueue<WheelMotion> waiting_;  ///< of the session whose initial state is awaited
  Nanoseconds newest_ = 0;
  bool started_ = false;   ///< samples go to the filter
  bool outdated_ = false;  ///< until the clock goes back, they still belong to the previous session
};

}  // namespace slipnav
