#include "calibration/mount_calibration.h"

#include <algorithm>
#include <cmath>

#include "calibration/batch_regression.h"

namespace slipnav {
namespace {

/// An angle known less well than this is not reported.
constexpr double kWorstStd_rad = 0.02;
/// With less turning the center of turn cannot be separated from the mounting.
constexpr double kLeastTurnForCenter_rad = 1.5;

/// Ground has its slope over twice this distance; anything shorter is stones under single wheels.
constexpr double kStones_m = 1.0;
/// Standard deviation of that slope across the drive, as a sine, below which it does not show how a rover slips down
/// it.
constexpr double kLeastCrossSlope = 0.01;
/// Side slip decorrelates only after several meters: stretches that count as independent are longer by this factor, ...
constexpr double kSideSlipStretch = 3.0;
/// ... unless the drive had fewer of them.
constexpr double kLeastStretches = 10.0;

/// Cross slope of the ground at each sample.
Eigen::VectorXd crossSlopes(const std::vector<MotionSample>& samples) {
  Eigen::VectorXd slopes(static_cast<Eigen::Index>(samples.size()));
  auto first = samples.begin();
  auto last = samples.begin();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const double here_m = samples[static_cast<std::size_t>(i)].travel_m;
    for (; last != samples.end() && last->travel_m <= here_m + kStones_m; ++last) {
      sum += last->cross_slope;
    }
    for (; first->travel_m < here_m - kStones_m; ++first) {
      sum -= first->cross_slope;
    }
    slopes(i) = sum / static_cast<double>(last - first);
  }
  return slopes;
}

double standardDeviation(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// Mean variance of the smoothed attitude about one axis, weighted like the regression.
double meanVariance(const std::vector<MotionSample>& samples, int axis) {
  double sum = 0.0;
  double weights = 0.0;
  for (const MotionSample& sample : samples) {
    const double weight = sample.v_eb_b.x() * sample.v_eb_b.x();
    sum += weight * sample.tilt_variance_b(axis);
    weights += weight;
  }
  return sum / weights;
}

/// The attitude error hardly changes over the drive, so the residuals do not show it.
std::optional<Calibrated> angleOf(const RegressionResult& fit, double attitude_variance) {
  const double std = std::sqrt(fit.covariance(0, 0) + attitude_variance);
  if (fit.effective_batches(0) < kLeastBatches || std > kWorstStd_rad) {
    return std::nullopt;
  }
  return Calibrated{std::atan(fit.estimate(0)), std};
}

/// v_y = −tan ψ v_x + κ v_x sin φ − x_c ω_z: course against nose, side slip down a cross slope of φ, and the point that
/// does not move sideways in turns.
void calibrateYaw(double batch_m, const std::vector<MotionSample>& samples, CalibrationResult& result) {
  const Eigen::VectorXd slopes = crossSlopes(samples);
  const bool slips_down = standardDeviation(slopes) >= kLeastCrossSlope;
  const bool turns = result.turned_rad >= kLeastTurnForCenter_rad;
  const int center = slips_down ? 2 : 1;
  const double stretch_m = std::clamp(samples.back().travel_m / kLeastStretches, batch_m, kSideSlipStretch * batch_m);
  RegressionProblem problem(center + (turns ? 1 : 0));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector3& v_eb_b = samples[i].v_eb_b;
    Eigen::Vector3d row(-v_eb_b.x(), slopes(static_cast<Eigen::Index>(i)) * v_eb_b.x(), 0.0);
    row(center) = -samples[i].omega_eb_b.z();
    problem.add(row.head(problem.parameters()), v_eb_b.y(), static_cast<std::size_t>(samples[i].travel_m / stretch_m));
  }
  const RegressionResult fit = regress(problem);
  result.mount_yaw_rad = angleOf(fit, meanVariance(samples, 2));
  if (!result.mount_yaw_rad) {
    result.not_observable.push_back("yaw of the IMU: its heading is too uncertain; drive longer, with turns and stops");
  }
  if (turns && fit.effective_batches(center) >= kLeastBatches) {
    result.turn_center_m = Calibrated{fit.estimate(center), std::sqrt(fit.covariance(center, center))};
  }
}

/// v_z = tan θ v_x: the nose against the slope that the vehicle climbs.
void calibratePitch(double batch_m, const std::vector<MotionSample>& samples, CalibrationResult& result) {
  RegressionProblem problem(1);
  Eigen::VectorXd row(1);
  for (const MotionSample& sample : samples) {
    row(0) = sample.v_eb_b.x();
    problem.add(row, sample.v_eb_b.z(), static_cast<std::size_t>(sample.travel_m / batch_m));
  }
  result.mount_pitch_rad = angleOf(regress(problem), meanVariance(samples, 1));
  if (!result.mount_pitch_rad) {
    result.not_observable.push_back("pitch of the IMU: its attitude is too uncertain; drive longer, with turns");
  }
}

}  // namespace

void calibrateMount(const Config& config, const std::vector<MotionSample>& samples, CalibrationResult& result) {
  calibrateYaw(config.calibration.batch_m, samples, result);
  calibratePitch(config.calibration.batch_m, samples, result);
  result.not_observable.push_back("roll of the IMU: not visible in any course; level the vehicle on a known surface");
}

}  // namespace slipnav
