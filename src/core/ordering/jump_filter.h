#pragma once
/// Keeps single samples with a wrong stamp from being taken for a clock jump.
///
/// A sample whose stamp is a second or more away from its predecessors is held until the next one arrives. If that
/// one continues from the held sample, time has really jumped (a gap, or a source that has restarted) and both are
/// released; if it continues from the earlier samples, the held one is dropped.

#include <cstdint>
#include <optional>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// @tparam Sample has a member `stamp`
template <class Sample>
class JumpFilter {
 public:
  /// Stamps of one source that differ by this much are a jump.
  static constexpr Nanoseconds kJump = kSecond;

  /// @param jump another limit, for a source that is slower than one sample a second
  explicit JumpFilter(Nanoseconds jump = kJump) : jump_(jump) {}

  /// Passes to `sink` what may be used now: nothing, the sample, or the held one and the sample.
  template <class Sink>
  void push(const Sample& sample, const Sink& sink) {
    if (sample.stamp <= 0) {  // never set
      ++left_out_;
    } else if (newest_ == 0 || isNear(sample.stamp, newest_)) {
      discardHeld();
      pass(sample, sink);
    } else if (held_ && goesOnFromHeld(sample.stamp)) {
      const Sample held = *held_;
      held_.reset();
      newest_ = held.stamp;
      sink(held);
      pass(sample, sink);
    } else {
      discardHeld();
      held_ = sample;
    }
  }

  /// Number of dropped samples, since the beginning.
  std::uint64_t leftOut() const { return left_out_; }

 private:
  bool isNear(Nanoseconds stamp, Nanoseconds other) const { return stamp > other - jump_ && stamp < other + jump_; }

  /// A slow sensor jumps with every sample, so any progress is enough; but one that went back must not be ahead again.
  bool goesOnFromHeld(Nanoseconds stamp) const {
    const bool held_went_back = held_->stamp < newest_;
    return stamp > held_->stamp - jump_ && (!held_went_back || stamp < newest_);
  }

  void discardHeld() {
    left_out_ += held_ ? 1 : 0;
    held_.reset();
  }

  template <class Sink>
  void pass(const Sample& sample, const Sink& sink) {
    newest_ = sample.stamp > newest_ || !isNear(sample.stamp, newest_) ? sample.stamp : newest_;
    sink(sample);
  }

  Nanoseconds jump_;
  Nanoseconds newest_ = 0;  ///< of the present run of samples
  std::optional<Sample> held_;
  std::uint64_t left_out_ = 0;
};

}  // namespace slipnav
