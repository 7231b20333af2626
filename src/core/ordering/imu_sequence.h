#pragma once
/// IMU samples on their way from the sensor: in order, without single wrong stamps, in a time that continues when the
/// clock is set back.

#include <cstdint>

#include "core/ordering/continuous_time.h"
#include "core/ordering/imu_sorter.h"
#include "core/ordering/jump_filter.h"

namespace slipnav {

/// For one source. Depends only on stamps and, within the limits of ImuSorter, not on the order of arrival.
class ImuSequence {
 public:
  /// Passes to `sink` each sample that is due, with its stamp by the clock, and its stamp in continuous time.
  template <class Sink>
  void push(const ImuSample& sample, const Sink& sink) {
    jumps_.push(sample, [this, &sink](const ImuSample& passed) {
      sorter_.push(passed, [this, &sink](const ImuSample& sorted) { sink(sorted, time_.add(sorted.stamp)); });
    });
  }

  /// How the clock was set back.
  const ContinuousTime& time() const { return time_; }
  /// Samples dropped for their stamps.
  std::uint64_t leftOut() const { return jumps_.leftOut(); }
  /// Samples that were put back in order.
  std::uint64_t overtaken() const { return sorter_.overtaken(); }

 private:
  JumpFilter<ImuSample> jumps_;
  ImuSorter sorter_;
  ContinuousTime time_;
};

}  // namespace slipnav
