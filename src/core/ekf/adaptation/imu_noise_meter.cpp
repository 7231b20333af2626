#include "slipnav/core/ekf/adaptation/imu_noise_meter.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

constexpr double kMemory_s = 4.0;
constexpr double kRecent_s = 0.5;
constexpr double kEnough_s = 0.5;
/// For white noise, relative to the variance of one block mean.
constexpr double kThirdDifferenceVariance = 20.0;
/// Variance of the mean of n of their squares, relative to its own square, times n: 2 (1 + 2 Σ ρ²) with correlations
/// -15/20, 6/20 and -1/20 of differences that share blocks.
constexpr double kMeanSquareVariance = 4.62;

}  // namespace

void ImuNoiseMeter::interrupt() {
  for (Scale& scale : scales_) {
    scale.blocks = 0;
    scale.samples = 0;
    scale.duration_s = 0.0;
    scale.sum.setZero();
  }
}

void ImuNoiseMeter::add(const Vector3& f_ib_b, const Vector3& omega_ib_b, double duration_s) {
  Vector6 increment;
  increment << f_ib_b, omega_ib_b;
  increment *= duration_s;
  for (int i = 0; i < kScales; ++i) {
    Scale& scale = scales_[static_cast<std::size_t>(i)];
    scale.sum += increment;
    scale.duration_s += duration_s;
    if (++scale.samples == 1 << i) {
      closeBlock(scale);
    }
  }
}

void ImuNoiseMeter::closeBlock(Scale& scale) {
  const Vector6 mean = scale.sum / scale.duration_s;
  if (scale.blocks == 3) {
    const Vector6 difference = mean - 3.0 * (scale.before[0] - scale.before[1]) - scale.before[2];
    const Vector6 density = difference.cwiseAbs2() * (scale.duration_s / kThirdDifferenceVariance);
    scale.weight_s = std::min(scale.weight_s + scale.duration_s, kMemory_s);
    scale.density += scale.duration_s / scale.weight_s * (density - scale.density);
    scale.recent += scale.duration_s / std::min(scale.weight_s, kRecent_s) * (density - scale.recent);
  } else {
    ++scale.blocks;
  }
  scale.block_s = scale.duration_s;
  scale.before[2] = scale.before[1];
  scale.before[1] = scale.before[0];
  scale.before[0] = mean;
  scale.samples = 0;
  scale.duration_s = 0.0;
  scale.sum.setZero();
}

ImuNoiseDensity ImuNoiseMeter::density() const {
  Vector6 least = Vector6::Zero();
  bool any = false;
  for (const Scale& scale : scales_) {
    if (scale.weight_s >= kEnough_s) {
      const double doubt = 1.0 + std::sqrt(kMeanSquareVariance * scale.block_s / scale.weight_s);
      const Vector6 density = (doubt * scale.density).cwiseMax(scale.recent);
      least = any ? least.cwiseMin(density) : density;
      any = true;
    }
  }
  return {least.head<3>(), least.tail<3>()};
}

}  // namespace slipnav
