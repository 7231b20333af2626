#pragma once
/// From commanded to actual wheel speed: limited acceleration, smooth, exact standstill.

namespace slipnav::sim {

/// A ramp of limited slope followed by a critically damped second-order lag.
class SpeedRamp {
 public:
  explicit SpeedRamp(double acceleration_mps2) : acceleration_mps2_(acceleration_mps2) {}

  void advance(double target_mps, double dt_s);
  double speed() const { return speed_mps_; }
  /// Exactly zero, and staying so while the target is zero.
  bool atRest() const { return speed_mps_ == 0.0 && rate_mps2_ == 0.0 && ramp_mps_ == 0.0; }

 private:
  double acceleration_mps2_;
  double ramp_mps_ = 0.0;
  double speed_mps_ = 0.0;
  double rate_mps2_ = 0.0;
};

}  // namespace slipnav::sim
