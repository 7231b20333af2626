#pragma once
/// Merges the samples of several sensors in order of stamp, whatever the order of arrival.
///
/// A sample is released once the IMU has advanced by the wait since; anything later is out of order, and
/// rejected by the receiver. IMU samples are sorted separately before that (ImuSequence). Where the stamps of a sensor
/// go back by a second or more, later samples belong after everything before the corresponding step of all sensors;
/// unless the clock has restarted, time continues (ContinuousTime). Single samples with a wrong stamp are dropped
/// (JumpFilter).

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "core/ordering/imu_sequence.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/models/gnss_fix.h"

namespace slipnav {

using Sample = std::variant<ImuSample, WheelMotion, PositionFix, VelocityFix>;

/// One queue per sensor; the earliest sample of all goes first. Samples come in with clock stamps and go out in
/// continuous time.
class SampleMerger {
 public:
  using Sink = std::function<void(const Sample&)>;

  /// @param max_wait_s how late a sample may be, in stamps of the IMU
  /// @param fix_jump limit for positions, for which slow receivers need a larger one
  explicit SampleMerger(double max_wait_s, Nanoseconds fix_jump = JumpFilter<PositionFix>::kJump)
      : max_wait_(fromSeconds(max_wait_s)) {
    std::get<JumpFilter<PositionFix>>(filters_) = JumpFilter<PositionFix>(fix_jump);
  }

  void push(const Sample& sample);

  /// Releases everything that nothing can precede any more.
  void advance(const Sink& sink) { advance(newest_imu_, sink); }
  /// The same, judged by an earlier IMU stamp.
  /// @param trusted newest stamp that nothing can have overtaken
  void advanceTrusting(Nanoseconds trusted, const Sink& sink) { advance({newest_imu_.session, trusted}, sink); }

  /// Releases everything.
  void flush(const Sink& sink);

  /// Stamp of the newest IMU sample by the clock, 0 before the first.
  Nanoseconds newestImuStamp() const { return newest_imu_.stamp; }
  /// The same in continuous time.
  Nanoseconds newestImuTime() const { return newest_imu_.stamp + offsetAfter(newest_imu_.session); }

  /// Offset to add to clock stamps.
  /// @param steps how often the clock had gone back before, for whatever reason
  Nanoseconds offsetAfter(std::size_t steps) const;
  /// How the IMU clock was set back.
  const ContinuousTime& time() const { return imu_.time(); }

  /// Samples dropped for their stamps, over all sensors.
  std::uint64_t leftOut() const;

  /// IMU samples that were put back in order.
  std::uint64_t overtaken() const { return imu_.overtaken(); }

 private:
  /// Stamps are comparable within a session, sessions follow each other.
  struct Instant {
    std::uint32_t session = 0;
    Nanoseconds stamp = 0;
    bool operator<(const Instant& other) const {
      return std::pair(session, stamp) < std::pair(other.session, other.stamp);
    }
  };
  struct Entry {
    Instant instant;
    Sample sample;
  };
  struct Stream {
    std::deque<Entry> waiting;
    Instant newest;
  };

  Instant sessionOf(const Sample& sample);
  void insert(const Sample& sample);
  void advance(const Instant& trusted, const Sink& sink);
  void release(Stream& stream, const Sink& sink);
  Stream* earliest();
  bool isCertain(const Instant& instant, const Instant& trusted) const;

  Nanoseconds max_wait_;
  ImuSequence imu_;
  std::tuple<JumpFilter<WheelMotion>, JumpFilter<PositionFix>, JumpFilter<VelocityFix>> filters_;
  std::vector<Nanoseconds> offsets_;  ///< by session
  std::array<Stream, std::variant_size_v<Sample>> streams_;
  Instant newest_imu_;
};

}  // namespace slipnav
