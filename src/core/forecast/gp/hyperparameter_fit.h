#pragma once
/// Hyperparameters of a Gaussian process by maximum a posteriori: marginal likelihood times log-normal priors, in
/// bounds.
///
/// The likelihood of a short window has several maxima. One at a length scale below the sampling interval and without
/// noise interpolates the samples and forecasts nothing, one at infinite length scale explains a trend. The priors and
/// bounds keep a fit away from them, see hyperparameter_prior.h.

#include <Eigen/Core>
#include <vector>

#include "core/forecast/gp/gaussian_process.h"

namespace slipnav {

/// Prior of one hyperparameter, all in natural logarithms: normal, truncated at the bounds.
struct LogPrior {
  double mean = 0.0;
  double stddev = 1.0;
  double lower = 0.0;
  double upper = 0.0;
  double typical_step = 1.0;  ///< roughly how well the samples determine it: the unit step of the optimizer
};

/// When a local fit ends.
struct FitSettings {
  int max_evaluations = 60;
  double tolerance = 1e-4;  ///< of the objective, a log probability, between two steps
};

/// How it ended.
enum class FitOutcome {
  kConverged,
  kBudgetSpent,  ///< max_evaluations reached; the best point found is returned
  kFailed        ///< no finite likelihood, or the optimizer gave up; the start is returned
};

/// Result of one local fit.
struct HyperparameterFit {
  FitOutcome outcome = FitOutcome::kFailed;
  Eigen::VectorXd log_parameters;
  double objective = 0.0;                ///< −log posterior, without the constants of the priors
  double negative_log_likelihood = 0.0;  ///< its first part
  int evaluations = 0;
};

/// Moves `start` into the bounds.
Eigen::VectorXd clampToBounds(const Eigen::VectorXd& start, const std::vector<LogPrior>& priors);

/// −log posterior; `gradient` may be null. Throws as GaussianProcess::negativeLogLikelihood() does.
double negativeLogPosterior(GaussianProcess& process, const std::vector<LogPrior>& priors,
                            const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient);

/// Local fit from `start` (clamped) to the samples in `process`. Never throws for numerical reasons; throws
/// std::invalid_argument if the lengths do not agree.
HyperparameterFit fitHyperparameters(GaussianProcess& process, const std::vector<LogPrior>& priors,
                                     const Eigen::VectorXd& start, const FitSettings& settings);

/// Local fit for an expensive likelihood, from a start near its end with the curvature there: the second derivatives of
/// −log posterior, positive definite and approximately right, from a cheaper form of the process. Newton steps within
/// the bounds; each updates the curvature (BFGS; J. Nocedal, S. Wright, Numerical Optimization, 2006, procedure 18.2).
/// Ends when the next step promises to gain less than the tolerance. Fails and throws like fitHyperparameters().
HyperparameterFit refineHyperparameters(GaussianProcess& process, const std::vector<LogPrior>& priors,
                                        const Eigen::VectorXd& start, const Eigen::MatrixXd& curvature,
                                        const FitSettings& settings);

}  // namespace slipnav
