#include "slipnav/calibration/mount_calibration.h"

#include <cmath>

#include "slipnav/calibration/batch_regression.h"

namespace slipnav {
namespace {

/// An angle that is less well known than this is not worth giving.
constexpr double kWorstStd_rad = 0.02;
/// Less turning than this does not tell the centre of turn from the mounting.
constexpr double kLeastTurnForCentre_rad = 1.5;

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

/// The attitude's own error hardly changes over the drive, so the residuals do not show it.
std::optional<Calibrated> angleOf(const RegressionResult& fit, double attitude_variance) {
  const double std = std::sqrt(fit.covariance(0, 0) + attitude_variance);
  if (fit.effective_batches(0) < kLeastBatches || std > kWorstStd_rad) {
    return std::nullopt;
  }
  return Calibrated{std::atan(fit.estimate(0)), std};
}

/// v_y = −tan ψ v_x − x_c ω_z: course against nose, and the point that does not move sideways in turns.
void calibrateYaw(double batch_m, const std::vector<MotionSample>& samples, CalibrationResult& result) {
  const bool turns = result.turned_rad >= kLeastTurnForCentre_rad;
  RegressionProblem problem(turns ? 2 : 1);
  for (const MotionSample& sample : samples) {
    const Eigen::Vector2d row(-sample.v_eb_b.x(), -sample.omega_eb_b.z());
    problem.add(row.head(problem.parameters()), sample.v_eb_b.y(), static_cast<std::size_t>(sample.travel_m / batch_m));
  }
  const RegressionResult fit = regress(problem);
  result.mount_yaw_rad = angleOf(fit, meanVariance(samples, 2));
  if (!result.mount_yaw_rad) {
    result.not_observable.push_back("yaw of the IMU: its heading is too uncertain; drive longer, with turns and stops");
  }
  if (turns && fit.effective_batches(1) >= kLeastBatches) {
    result.turn_centre_m = Calibrated{fit.estimate(1), std::sqrt(fit.covariance(1, 1))};
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
  result.not_observable.push_back("roll of the IMU: no course shows it; level the vehicle on a known surface for that");
}

}  // namespace slipnav
