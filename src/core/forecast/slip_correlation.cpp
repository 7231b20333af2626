#include "core/forecast/slip_correlation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slipnav {

GaussMarkovSlip summarizeCorrelation(const Eigen::MatrixXd& covariance, double interval_s) {
  const Eigen::Index n = covariance.rows();
  if (n < 3 || covariance.cols() != n || !(interval_s > 0.0)) {
    throw std::invalid_argument("slip correlation: needs a square covariance of at least three evenly spaced times");
  }
  const Eigen::Index lags = n / 2 + 1;  // longer lags have few pairs, all at the ends of the horizon
  Eigen::VectorXd autocovariance(lags);
  for (Eigen::Index lag = 0; lag < lags; ++lag) {
    autocovariance(lag) = covariance.diagonal(-lag).mean();
  }
  const double bias_variance = std::clamp(autocovariance.tail(lags / 2).mean(), 0.0, std::max(0.0, autocovariance(0)));
  const double variance = autocovariance(0) - bias_variance;
  GaussMarkovSlip summary;
  summary.bias_stddev = std::sqrt(bias_variance);
  if (variance > 0.0) {
    const Eigen::ArrayXd correlation = (autocovariance.array() - bias_variance) / variance;
    summary.stddev = std::sqrt(variance);
    summary.time_constant_s = std::max(0.0, interval_s * (correlation.sum() - 0.5));
  }
  return summary;
}

GaussMarkovSlip summarizeCorrelation(const SlipModel& model, double start_s, double horizon_s, int points) {
  const Eigen::VectorXd times_s = Eigen::VectorXd::LinSpaced(points, start_s, start_s + horizon_s);
  return summarizeCorrelation(model.predictCovariance(times_s), horizon_s / (points - 1));
}

}  // namespace slipnav
