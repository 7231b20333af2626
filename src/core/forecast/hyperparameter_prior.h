#pragma once
/// Priors, bounds and start values of the hyperparameters, derived only from the scale of the window.
///
/// Nothing here depends on seconds or the magnitude of slip: with another unit, origin or sampling rate the same
/// samples get the same fit. Each prior is wide (a factor of e^{±1} and more); the likelihood of a whole window
/// outweighs it wherever the samples say anything.

#include <Eigen/Core>
#include <vector>

#include "core/forecast/gp/hyperparameter_fit.h"
#include "core/forecast/gp/latent_model.h"
#include "core/forecast/slip_window.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `forecast.prior`.
struct PriorParameters {
  double min_length_scale_samples = 3.0;  ///< shorter ones are indistinguishable from noise, and only interpolate
  double max_length_scale_spans = 0.5;    ///< longer ones are trends of the window, not varying slip
  double length_scale_log_stddev = 1.5;   ///< about the geometric mean of sample interval and span
  double variance_log_stddev = 2.0;       ///< about the power of slip in the window
  double noise_log_stddev = 1.5;          ///< about half the mean square of successive differences
  double min_noise_ratio = 0.05;          ///< smallest noise variance relative to that
  double max_noise_ratio = 4.0;           ///< largest noise variance relative to that

  void visit(ParameterVisitor& v);
};

/// One prior per hyperparameter, in the order of hyperparameterNames(). Their means are the start of a cold fit.
std::vector<LogPrior> makePriors(const LatentModel& model, const WindowScale& scale, const PriorParameters& parameters);

/// Means of the priors, clamped to the bounds, with the length scale of the components of role kSlip `factor` times the
/// prior's: the factor distinguishes the start points of a cold fit.
Eigen::VectorXd startPoint(const LatentModel& model, const std::vector<LogPrior>& priors, double factor);

}  // namespace slipnav
