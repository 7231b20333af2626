#pragma once
/// The speed that slip is a ratio of.

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// The smallest wheel speed of the last second. A wheel that loses its grip runs ahead for about as long, and so does
/// not change what its slip is measured against: were it the present speed, or its mean, the end of each slip would
/// look like a loss of vehicle speed. A rover that brakes takes it along at once.
class SlippingSpeed {
 public:
  void reset() { lowest_.clear(); }

  void add(Nanoseconds stamp, double wheel_speed_mps);

  /// With the sign of the wheels' motion [m/s]; 0 before the first sample.
  double value() const { return lowest_.empty() ? 0.0 : lowest_.front().speed_mps; }

 private:
  struct Sample {
    Nanoseconds stamp = 0;
    double speed_mps = 0.0;
  };
  RingQueue<Sample> lowest_;  ///< candidates, by stamp, each larger than the one before
};

}  // namespace slipnav
