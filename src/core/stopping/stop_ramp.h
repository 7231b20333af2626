#pragma once
/// Brings a rover to rest from any command.

#include "core/stopping/velocity_command.h"

namespace slipnav {

/// Multiplies commands by a factor that falls from one to zero, as fast as both deceleration limits allow, so that
/// the rover slows down along the arc the operator steers. The output never exceeds the input, has its
/// sign, and its linear speed never grows; a zero command is zero at once, and nothing moves the rover again after it.
class StopRamp {
 public:
  StopRamp(double deceleration_mps2, double angular_deceleration_radps2)
      : deceleration_mps2_(deceleration_mps2), angular_deceleration_radps2_(angular_deceleration_radps2) {}

  /// Other limits from now on, also for a stop in progress.
  void retune(double deceleration_mps2, double angular_deceleration_radps2) {
    deceleration_mps2_ = deceleration_mps2;
    angular_deceleration_radps2_ = angular_deceleration_radps2;
  }

  /// A stop begins. @param linear_speed_mps what was last commanded, magnitude
  void begin(Nanoseconds stamp, double linear_speed_mps);

  /// The command to give at `stamp` instead of `in`.
  VelocityCommand shorten(const VelocityCommand& in, Nanoseconds stamp);

 private:
  double deceleration_mps2_;
  double angular_deceleration_radps2_;
  Nanoseconds stamp_ = 0;
  double factor_ = 1.0;
  double linear_speed_mps_ = 0.0;  ///< commanded last
};

}  // namespace slipnav
