#pragma once
/// Wheel samples by session: each restart of the recording's clock has its own, with its own initial state.

#include <deque>
#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// The initial state of a session comes by a different route than the wheel samples, so either may be first.
class WheelSessions {
 public:
  /// Samples for the filter now: the given one, or none while its session's initial state is awaited.
  std::vector<WheelMotion> push(const WheelMotion& wheels);

  /// The initial state of the next session has arrived. @return its samples so far
  std::vector<WheelMotion> startNext();

  /// The filter pauses; samples wait for the initial state of a new start in the same session.
  void pause() { started_ = outdated_ = false; }

 private:
  std::deque<WheelMotion> waiting_;  ///< of the session whose initial state is awaited
  Nanoseconds newest_ = 0;
  bool started_ = false;   ///< samples go to the filter
  bool outdated_ = false;  ///< until the clock goes back, they still belong to the previous session
};

}  // namespace slipnav
