#pragma once
/// Whether something that arrives regularly has stopped.

#include <optional>

namespace slipnav {

/// Two clocks must agree on the silence: the ROS clock, which a recording or simulation may run fast or slowly, and
/// one of real time, since the ROS clock may lag behind and then jump.
class SilenceWatch {
 public:
  explicit SilenceWatch(double limit_s) : limit_s_(limit_s) {}

  void setLimit(double limit_s) { limit_s_ = limit_s; }

  /// One instant on both clocks.
  struct Now {
    double ros_s;
    double real_s;
  };

  void heard(const Now& now) { last_ = now; }
  bool hasHeard() const { return last_.has_value(); }
  /// False until something has been heard.
  bool isSilent(const Now& now) const {
    return last_ && now.ros_s - last_->ros_s > limit_s_ && now.real_s - last_->real_s > limit_s_;
  }

 private:
  double limit_s_;
  std::optional<Now> last_;
};

}  // namespace slipnav
