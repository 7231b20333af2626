#pragma once
/// When to stand still: what decides it in a closed loop.

#include <memory>
#include <string>

#include "slipnav/types.h"

namespace slipnav {

class StopPolicy {
 public:
  virtual ~StopPolicy() = default;

  /// Asked once per control interval, with stamps in ascending order.
  /// @param standstill whether the rover stands now
  /// @return whether it shall be stopped, or kept stopped
  virtual bool hold(Nanoseconds stamp, bool standstill) = 0;
};

/// Drives on whatever happens.
class NeverStop : public StopPolicy {
 public:
  bool hold(Nanoseconds, bool) override { return false; }
};

/// Drives for `every_s`, stops, stands for `hold_s`, and so on (Kilic et al. 2019).
class PeriodicStops : public StopPolicy {
 public:
  /// Throws std::invalid_argument unless both are above zero.
  PeriodicStops(double every_s, double hold_s);
  bool hold(Nanoseconds stamp, bool standstill) override;

 private:
  double every_s_;
  double hold_s_;
  Nanoseconds driving_since_ = 0;
  Nanoseconds standing_since_ = 0;
  bool holding_ = false;
};

/// Policy by its name on the command line: `none` or `periodic:EVERY_S:HOLD_S`.
/// Throws std::invalid_argument that names anything else.
std::unique_ptr<StopPolicy> makeStopPolicy(const std::string& text);

}  // namespace slipnav
