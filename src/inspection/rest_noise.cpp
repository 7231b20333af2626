#include "inspection/rest_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/statistics.h"

namespace slipnav {
namespace {

constexpr std::array<double, 3> kBlocks_s = {0.1, 0.2, 0.4};
/// Of unit white noise: 1 + 9 + 9 + 1.
constexpr double kThirdDifference = 20.0;
/// Known to a sixth then.
constexpr double kLeastDifferences = 40.0;
constexpr std::size_t kLeastSamples = 3;  // in a block

/// Σ of squared third differences of block means.
struct Differences {
  Vector3 force = Vector3::Zero();
  Vector3 rate = Vector3::Zero();
  double count = 0.0;
};

void add(const ImuTrack& imu, const StillTime& rest, double block_s, Differences& sums) {
  std::array<Vector3, 4> force;
  std::array<Vector3, 4> rate;
  std::size_t blocks = 0;
  for (double t_s = rest.begin_s; t_s + block_s <= rest.end_s; t_s += block_s) {
    if (imu.firstAfter(t_s + block_s) - imu.firstAfter(t_s) < kLeastSamples) {
      blocks = 0;
      continue;
    }
    force[blocks % 4] = imu.meanForce(t_s, t_s + block_s);
    rate[blocks % 4] = imu.meanRate(t_s, t_s + block_s);
    if (++blocks >= 4) {
      const auto third = [blocks](const std::array<Vector3, 4>& means) {
        return Vector3(means[(blocks - 1) % 4] - 3.0 * means[(blocks - 2) % 4] + 3.0 * means[(blocks - 3) % 4] -
                       means[blocks % 4]);
      };
      sums.force += third(force).cwiseAbs2();
      sums.rate += third(rate).cwiseAbs2();
      sums.count += 1.0;
    }
  }
}

}  // namespace

RestNoise restNoise(const ImuTrack& imu, const std::vector<StillTime>& rests) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  std::vector<double> force(3, kUnknown);
  std::vector<double> rate(3, kUnknown);
  for (const double block_s : kBlocks_s) {
    Differences sums;
    for (const StillTime& rest : rests) {
      add(imu, rest, block_s, sums);
    }
    for (std::size_t axis = 0; axis < 3 && sums.count >= kLeastDifferences; ++axis) {
      const auto random_walk = [&](const Vector3& squares) {
        return std::sqrt(block_s * squares(static_cast<Eigen::Index>(axis)) / (kThirdDifference * sums.count));
      };
      force[axis] = std::min(force[axis], random_walk(sums.force));
      rate[axis] = std::min(rate[axis], random_walk(sums.rate));
    }
  }
  return force[0] == kUnknown ? RestNoise{} : RestNoise{true, median(force), median(rate)};
}

}  // namespace slipnav
