#pragma once
/// A rover that stands while its wheels turn: dug in, or lifted off the ground by a stone.
///
/// Neither sensor can tell alone: to an IMU a smooth floor looks like rest, and spinning wheels look like a drive.
/// All must agree: the IMU is clearly calmer than while driving, its means are those of rest, and
/// by the estimate the wheels have lost most of their travel.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Evidence at the end of a wheel interval.
struct SpinEvidence {
  Nanoseconds stamp = 0;
  bool level_of_rest = false;        ///< the means of specific force and rate are those of rest
  bool calmer_than_driving = false;  ///< driving over this ground shook the IMU clearly more
  double forward_mps = 0.0;          ///< estimate of the forward speed, mean over the interval
  double forward_std_mps = 0.0;
  double wheels_mps = 0.0;  ///< largest circumferential speed of a wheel
};

/// Stuck once everything has held for a second, until the IMU is no longer at rest or no longer calm.
class StuckDetector {
 public:
  void reset() { *this = StuckDetector(); }
  bool judge(const SpinEvidence& evidence);
  bool isStuck() const { return stuck_; }
  /// Whether it holds, even if only briefly so far.
  bool isSuspected() const { return since_ != 0; }

 private:
  bool stuck_ = false;
  Nanoseconds since_ = 0;  ///< all of it holds; 0 while it does not
};

}  // namespace slipnav
