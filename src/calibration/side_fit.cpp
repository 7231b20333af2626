#include "calibration/side_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "calibration/batch_regression.h"
#include "core/base/square.h"

namespace slipnav {
namespace {

/// Smallest share of the noise that is proportional to speed.
constexpr double kLeastSpeedNoise = 0.01;
/// Cells are shorter than turns and longer than the interplay of slip and steering.
constexpr double kCellsPerBatch = 4.0;

/// Means over a cell of the drive: y = row · (half difference, gain) + error.
struct TurnRow {
  Eigen::Vector2d row = Eigen::Vector2d::Zero();
  double y_mps = 0.0;
  double speed_mps = 0.0;  ///< of the fastest wheel
  double duration_s = 0.0;
  std::size_t batch = 0;
};

/// u_left − u_right = −d (u_left + u_right) + k B ω_z, with ω_z about down.
///
/// Slip of one side makes noise of ω_z, and the driver corrects it by the wheels a meter or two later. Over cells
/// of some meters ω_z is what the path demands and the wheels are what it took, so that neither noise nor steering
/// biases the gain.
std::vector<TurnRow> turnRows(const Sides& sides, double batch_m, const std::vector<MotionSample>& samples) {
  std::map<std::size_t, TurnRow> cells;
  for (const MotionSample& sample : samples) {
    const double left_mps = sides.leftSpeed(sample.wheels);
    const double right_mps = sides.rightSpeed(sample.wheels);
    TurnRow& cell = cells[batchOf(sample, batch_m / kCellsPerBatch)];
    const double dt_s = sample.duration_s;
    cell.row += dt_s * Eigen::Vector2d(-(left_mps + right_mps), sides.track() * sample.omega_eb_b.z());
    cell.y_mps += dt_s * (left_mps - right_mps);
    cell.speed_mps += dt_s * sample.wheels.largest_speed_mps;
    cell.duration_s += dt_s;
    cell.batch = batchOf(sample, batch_m);
  }
  std::vector<TurnRow> rows;
  rows.reserve(cells.size());
  for (const auto& [index, cell] : cells) {
    rows.push_back({cell.row / cell.duration_s, cell.y_mps / cell.duration_s, cell.speed_mps / cell.duration_s,
                    cell.duration_s, cell.batch});
  }
  return rows;
}

/// Variance of an error: one part proportional to wheel speed (slip), one to turning (varying scrub).
struct TurnNoise {
  double by_speed = 1.0;
  double by_turn = 0.0;

  double std(const TurnRow& row) const {
    return std::sqrt(by_speed * square(row.speed_mps) + by_turn * square(row.row(1)));
  }
};

/// Least squares on squared errors; neither part below zero, and speed always with some.
TurnNoise noiseOf(const std::vector<TurnRow>& rows, const Eigen::Vector2d& estimate) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const TurnRow& row : rows) {
    const Eigen::Vector2d squares(square(row.speed_mps), square(row.row(1)));
    information += squares * squares.transpose();
    moment += squares * square(row.y_mps - row.row.dot(estimate));
  }
  const double speed_alone = moment(0) / information(0, 0);
  const Eigen::Vector2d both = information.ldlt().solve(moment);
  if (!both.allFinite() || both(1) <= 0.0) {
    return {speed_alone, 0.0};
  }
  return {std::max(both(0), kLeastSpeedNoise * speed_alone), both(1)};
}

RegressionResult fitRows(const std::vector<TurnRow>& rows, const TurnNoise& noise) {
  RegressionProblem problem(2);
  for (const TurnRow& row : rows) {
    const double std = noise.std(row);
    problem.add(row.row / std, row.y_mps / std, row.batch);
  }
  return regress(problem);
}

/// The whole drive, twice: the second time weighted by the errors found in the first.
SideFit fitTurns(const std::vector<TurnRow>& rows) {
  const RegressionResult fit = fitRows(rows, noiseOf(rows, fitRows(rows, {}).estimate));
  SideFit sides;
  sides.half_difference = fit.estimate(0);
  sides.half_difference_std = std::sqrt(fit.covariance(0, 0));
  if (fit.effective_batches(1) >= kLeastBatches) {
    sides.turn_gain = Calibrated{fit.estimate(1), std::sqrt(fit.covariance(1, 1))};
  }
  return sides;
}

/// The same for a drive without turns, whose scrub factor must be taken as configured.
SideFit fitStraight(const std::vector<TurnRow>& rows, double assumed_scrub) {
  RegressionProblem problem(1);
  for (const TurnRow& row : rows) {
    const Eigen::VectorXd regressor = row.row.head<1>() / row.speed_mps;
    problem.add(regressor, (row.y_mps - assumed_scrub * row.row(1)) / row.speed_mps, row.batch);
  }
  const RegressionResult fit = regress(problem);
  return {fit.estimate(0), std::sqrt(fit.covariance(0, 0)), std::nullopt};
}

}  // namespace

SideFit fitSides(const Sides& sides, double batch_m, double assumed_scrub, bool with_scrub,
                 const std::vector<MotionSample>& samples) {
  const std::vector<TurnRow> rows = turnRows(sides, batch_m, samples);
  return with_scrub ? fitTurns(rows) : fitStraight(rows, assumed_scrub);
}

std::size_t batchOf(const MotionSample& sample, double batch_m) {
  return static_cast<std::size_t>(sample.travel_m / batch_m);
}

}  // namespace slipnav
