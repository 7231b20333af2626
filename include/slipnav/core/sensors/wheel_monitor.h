#pragma once
/// Wheels that contradict the others for longer than slip explains: a dead encoder, a wheel in the air, swapped
/// joints.
///
/// Each wheel i gives a vehicle speed, u_i = v_i + ω_z y_i with the heading rate of the gyros and y_i to the
/// right. One that deviates from the median for some time is excluded until it has agreed for as long again.

#include <array>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/parameters/parameter_visitor.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Block `wheel_monitor`.
struct WheelMonitorParams {
  double max_speed_mps = 5.0;
  double difference_mps = 0.15;
  double difference_ratio = 0.4;
  double time_s = 1.0;
  void visit(ParameterVisitor& v);
};

/// Verdict on each wheel, in the order of the configuration.
class WheelMonitor {
 public:
  /// @param wheels as configured; with none or a single one, nothing is ever found
  WheelMonitor(const WheelMonitorParams& params, const std::vector<WheelParams>& wheels);

  /// Forgets everything.
  void reset();

  /// Takes the circumferential speeds [m/s] of all wheels over the interval that ends at `stamp`, and the mean heading
  /// rate of the gyros over it, positive to the right.
  void add(Nanoseconds stamp, const std::array<double, kMaxWheels>& speed_mps, double yaw_rate_radps);

  bool isFaulty(std::size_t wheel) const { return faulty_[wheel]; }
  std::size_t faultyCount() const;
  std::size_t count() const { return y_right_m_.size(); }

  /// Forward speed from the sound wheels [m/s]; meaningful if more than half of them are sound.
  double soundSpeed() const { return sound_speed_mps_; }
  /// Whether wheel speed may be used at all: fewer than half of the wheels are faulty.
  bool isUsable() const { return 2 * faultyCount() < count() || faultyCount() == 0; }

 private:
  WheelMonitorParams params_;
  std::vector<double> y_right_m_;
  std::array<bool, kMaxWheels> faulty_ = {};
  std::array<Nanoseconds, kMaxWheels> changing_since_ = {};  ///< opposite of faulty_ since then, 0 when not
  double sound_speed_mps_ = 0.0;
};

}  // namespace slipnav
