#pragma once
/// Lets a rover resume after a stop, without a jump in its command.

#include "core/stopping/velocity_command.h"

namespace slipnav {

/// Multiplies commands by a factor that rises from zero to one, no faster than both limits allow; never more than
/// commanded, and with the same sign. It ends with the factor one, or with a zero command: then the operator starts
/// again.
class ReleaseRamp {
 public:
  /// The rover may resume. Before the first call, commands pass.
  void begin(Nanoseconds stamp);
  /// Commands pass from now on.
  void end() { factor_ = 1.0; }

  /// The command to give at `stamp` in place of `in`.
  VelocityCommand shorten(const VelocityCommand& in, Nanoseconds stamp, double acceleration_mps2,
                          double angular_acceleration_radps2);

 private:
  Nanoseconds stamp_ = 0;
  double factor_ = 1.0;
};

}  // namespace slipnav
