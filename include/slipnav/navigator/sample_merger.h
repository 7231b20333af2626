#pragma once
/// Brings the samples of several sensors, each of which comes in its own order, into one order by stamp.
///
/// A sample is let go when every other sensor has gone past its stamp, or has been silent for so long that nothing is
/// expected of it. Within one sensor the order of arrival stays. A sensor whose stamps go back by a second or more has
/// started anew: what follows belongs after everything of all sensors before their own such step.

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <variant>

#include "slipnav/filter/filter_data.h"
#include "slipnav/measurement/position_fix.h"

namespace slipnav {

using Sample = std::variant<ImuSample, WheelMotion, PositionFix>;

inline Nanoseconds stampOf(const Sample& sample) {
  return std::visit([](const auto& s) { return s.stamp; }, sample);
}

class SampleMerger {
 public:
  using Sink = std::function<void(const Sample&)>;

  /// @param max_wait_s how far, in stamps, the other sensors may be ahead of a silent one before it is not waited for
  explicit SampleMerger(double max_wait_s) : max_wait_(fromSeconds(max_wait_s)) {}

  void push(const Sample& sample);

  /// Lets go what has become certain.
  /// @param trusted newest stamp by which silence is judged: samples later than that may have overtaken others
  void advance(const Sink& sink) { advance(newest_, sink); }
  void advanceTrusting(Nanoseconds trusted, const Sink& sink) { advance({newest_.session, trusted}, sink); }

  /// Lets go everything.
  void flush(const Sink& sink);

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

  void advance(const Instant& trusted, const Sink& sink);
  Stream* earliest();
  bool isCertain(const Entry& entry, const Instant& trusted) const;

  Nanoseconds max_wait_;
  std::array<Stream, std::variant_size_v<Sample>> streams_;
  Instant newest_;
};

}  // namespace slipnav
