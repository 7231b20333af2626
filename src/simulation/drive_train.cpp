#include "simulation/drive_train.h"

#include <algorithm>
#include <cmath>

namespace slipnav::sim {
namespace {

constexpr double kLag_s = 0.06;
/// Below these the brake holds the wheel; the step in speed is far below what an IMU can see.
constexpr double kHoldSpeed_mps = 1e-6;
constexpr double kHoldRate_mps2 = 1e-5;

}  // namespace

void SpeedRamp::advance(double target_mps, double dt_s) {
  const double step_mps = acceleration_mps2_ * dt_s;
  ramp_mps_ += std::clamp(target_mps - ramp_mps_, -step_mps, step_mps);
  rate_mps2_ += dt_s * ((ramp_mps_ - speed_mps_) / kLag_s - 2.0 * rate_mps2_) / kLag_s;
  speed_mps_ += dt_s * rate_mps2_;
  const bool holding = std::abs(speed_mps_) < kHoldSpeed_mps && std::abs(rate_mps2_) < kHoldRate_mps2;
  if (ramp_mps_ == 0.0 && target_mps == 0.0 && holding) {
    speed_mps_ = 0.0;
    rate_mps2_ = 0.0;
  }
}

}  // namespace slipnav::sim
