#pragma once
/// Whether the time source of the nodes exists at all.

#include <cstdint>

namespace slipnav {

/// With `use_sim_time`, time is whatever is published. If that parameter is left over from a recording or a
/// simulation, nobody publishes: messages arrive, and time stands still. Polled in real time.
class ClockWatch {
 public:
  /// A message has been handled.
  void heard() { ++messages_; }

  /// @param simulated use_sim_time is set; @param time_s current ROS time
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
