#pragma once
/// Correlation of predicted slip over the horizon, in a form that a covariance propagation can carry.

#include <Eigen/Core>

#include "core/forecast/slip_model.h"

namespace slipnav {

/// Predicted slip error = constant + first-order Gauss–Markov process: autocovariance
/// bias_stddev² + stddev² e^{−|Δt|/time_constant_s}.
struct GaussMarkovSlip {
  double bias_stddev = 0.0;      ///< of the part that persists over the whole horizon
  double stddev = 0.0;           ///< of the varying part
  double time_constant_s = 0.0;  ///< of that part; zero if there is none
};

/// Reduces a joint covariance on an even grid with the given interval, at least three points.
///
/// The autocovariance at each lag is the mean along that diagonal. The bias variance is its mean over the second half
/// of the lags, the variance of the rest is the excess at lag zero, and the time constant is the integral of the
/// rest's correlation (trapezoidal): the variance of the accumulated slip, and with it that of the distance, then
/// equals that of the given covariance. Throws std::invalid_argument for a matrix that is not square or too small.
GaussMarkovSlip summarizeCorrelation(const Eigen::MatrixXd& covariance, double interval_s);

/// The same for a model's prediction over `horizon_s` from `start_s`, on a grid of about `points`.
GaussMarkovSlip summarizeCorrelation(const SlipModel& model, double start_s, double horizon_s, int points = 121);

}  // namespace slipnav
