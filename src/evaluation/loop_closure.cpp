#include "evaluation/loop_closure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "evaluation/motion.h"
#include "evaluation/truth_track.h"
#include "evaluation/verdict.h"

namespace slipnav {
namespace {

/// Length of the estimate's own path [m].
double ownDistance(const EstimateTrack& estimates) {
  std::vector<TruthSample> samples;
  samples.reserve(estimates.size());
  for (const EstimateSample& estimate : estimates) {
    samples.push_back({estimate.stamp, estimate.position_enu_m});
  }
  return distanceDriven(TruthTrack(std::move(samples)), estimates.front().stamp, estimates.back().stamp);
}

/// Longer half axis of the 3σ ellipse [m].
double threeSigma(const Eigen::Matrix2d& covariance_m2) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_m2, Eigen::EigenvaluesOnly);
  return 3.0 * std::sqrt(std::max(axes.eigenvalues().maxCoeff(), 0.0));
}

}  // namespace

void addLoopClosure(const EstimateTrack& estimates, bool uses_stops, Metrics& metrics) {
  if (estimates.empty()) {
    throw std::invalid_argument("loop closure: no estimate");
  }
  const Vector3 open_m = estimates.back().position_enu_m - estimates.front().position_enu_m;
  const Matrix3 grown_m2 = estimates.back().covariance_enu_m2 - estimates.front().covariance_enu_m2;
  metrics.closure_m = open_m.head<2>().norm();
  metrics.closure_up_m = open_m.z();
  metrics.closure_3sigma_m = threeSigma(grown_m2.topLeftCorner<2, 2>());
  if (!metrics.distance_m) {
    metrics.distance_m = ownDistance(estimates);
  }
  if (*metrics.distance_m > 0.0) {
    metrics.closure_pct = 100.0 * *metrics.closure_m / *metrics.distance_m;
  }
  metrics.verdict = verdictOf(metrics, uses_stops);
}

}  // namespace slipnav
