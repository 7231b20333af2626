#pragma once
/// Wheel messages on their way to the filter: read, cleared of single wrong stamps, converted to IMU time and held
/// until their session has begun.

#include <functional>
#include <optional>
#include <string>

#include "core/navigation/continuous_wheels.h"
#include "core/navigation/wheel_sessions.h"
#include "core/ordering/jump_filter.h"
#include "ros/messages/wheel_input.h"
#include "ros/runtime/sensor_watch.h"

namespace slipnav {

/// The wheels of the Filter nodelet.
class FilterWheels {
 public:
  /// @param use is called with each sample when the filter is to use it
  FilterWheels(const Config& config, std::function<void(const WheelMotion&)> use);

  /// The content of one message, for push(); nothing if it is rejected, and problem() says why.
  template <class Message>
  std::optional<WheelMotion> read(const Message& message, const SilenceWatch::Now& now) {
    ++messages_;
    const std::optional<WheelMotion> motion = input_.take(message);
    if (motion) {
      watch_.used(now);
    } else if (!problem().empty()) {
      watch_.refused(problem(), now);
    }
    return motion;
  }
  void push(const WheelMotion& motion);

  /// What was wrong with the newest message, "" if nothing.
  const std::string& problem() const { return input_.problem(); }
  /// See WheelInput.
  const std::string& remark() const { return input_.remark(); }
  /// What is wrong with the wheels now, "" if nothing.
  std::string failure(const SilenceWatch::Now& now) const { return watch_.problem(input_.topic(), now); }

  /// Takes what the mechanization knows about the clock. @return whether that is new
  bool learn(const ContinuousTime& time);
  const ContinuousTime& time() const { return in_time_.time(); }
  /// The mechanization has restarted.
  void recount() { in_time_.recount(); }

  /// See WheelSessions.
  void startNext();
  void pause() { sessions_.pause(); }

  std::uint64_t messages() const { return messages_; }
  /// Samples with a wrong stamp.
  std::uint64_t leftOut() const { return jumps_.leftOut(); }

 private:
  void sort(const std::vector<WheelMotion>& samples);

  WheelInput input_;
  SensorWatch watch_;
  JumpFilter<WheelMotion> jumps_;
  ContinuousWheels in_time_;
  WheelSessions sessions_;
  std::function<void(const WheelMotion&)> use_;
  std::uint64_t messages_ = 0;
};

}  // namespace slipnav
