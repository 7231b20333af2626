#pragma once
/// The speed that slip is expressed as a ratio of.

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// The smallest wheel speed of the last second. A wheel that loses grip runs fast for about as long, and so does
/// not change the reference of its slip: with the current speed, or its mean, the end of each slip would
/// look like a loss of vehicle speed. A braking rover lowers it at once.
class SlippingSpeed {
 public:
  void reset() { lowest_.clear(); }

  void add(Nanoseconds stamp, double wheel_speed_mps);

  /// With the sign of the wheel motion [m/s]; 0 before the first sample.
  double value() const { return lowest_.empty() ? 0.0 : lowest_.front().speed_mps; }

 private:
  struct Sample {
    Nanoseconds stamp = 0;
    double speed_mps = 0.0;
  };
  RingQueue<Sample> lowest_;  ///< candidates, by stamp, each larger than the previous one
};

}  // namespace slipnav
