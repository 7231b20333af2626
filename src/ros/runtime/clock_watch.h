#pragma once
/// Whether the time that nodes are told to go by is there at all.

#include <cstdint>

namespace slipnav {

/// With `use_sim_time`, time is what somebody publishes. Where that parameter is left over from a recording or a
/// simulation, nobody does: messages come, and time stands still. Asked regularly by real time.
class ClockWatch {
 public:
  /// A message has been handled.
  void heard() { ++messages_; }

  /// @param simulated use_sim_time is set; @param time_s what ROS takes for the time
  /// @return whether messages have come since the last call while time stood still
  bool standsStill(bool simulated, double time_s) {
    const bool still = simulated && asked_ && time_s == time_s_ && messages_ != messages_before_;
    asked_ = true;
    time_s_ = time_s;
    messages_before_ = messages_;
    return still;
  }

 private:
  std::uint64_t messages_ = 0;
  std::uint64_t messages_before_ = 0;
  double time_s_ = 0.0;
  bool asked_ = false;
};

}  // namespace slipnav
