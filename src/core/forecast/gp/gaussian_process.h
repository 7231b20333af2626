#pragma once
/// Gaussian process regression of a function of time: y(t) = f(t) + ε, f ~ GP(0, k), ε ~ N(0, σₙ²).
///
/// Times are seconds since the origin of the process, which the caller has chosen and subtracted: a nonstationary
/// kernel, like the Brownian one, depends on it. The hyperparameters are one vector of natural logarithms: those
/// of the kernel in its order, then log σₙ².
///
/// Two implementations: DenseGaussianProcess, exact for every kernel, and StateSpaceGaussianProcess, whose cost grows
/// linearly with the number of samples.

#include <Eigen/Core>

namespace slipnav {

/// Mean and variance of the latent f, without the noise of an observation.
struct LatentPrediction {
  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
};

/// Regression on one set of samples: likelihood of hyperparameters, and prediction with those chosen.
class GaussianProcess {
 public:
  virtual ~GaussianProcess() = default;

  /// Length of the hyperparameter vector.
  virtual Eigen::Index parameterCount() const = 0;

  /// Takes the samples: `times` strictly increasing and not negative, everything finite, at least one sample.
  /// Throws std::invalid_argument otherwise. Earlier conditioning is lost.
  virtual void setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) = 0;

  /// −log p(y | θ); `gradient`, if given, becomes its derivative with respect to the log hyperparameters.
  /// Throws std::runtime_error if the covariance of the samples is not positive definite.
  virtual double negativeLogLikelihood(const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient) = 0;

  /// Conditions on the samples with these hyperparameters; predictions refer to the last call.
  /// @return −log p(y | θ). Throws as negativeLogLikelihood() does.
  virtual double condition(const Eigen::VectorXd& log_parameters) = 0;

  /// Posterior at `times` (not negative, any order). Throws std::logic_error before condition().
  virtual LatentPrediction predict(const Eigen::VectorXd& times) const = 0;

  /// Joint posterior covariance of f at `times` (n × n), symmetric. Throws std::logic_error before condition().
  virtual Eigen::MatrixXd predictCovariance(const Eigen::VectorXd& times) const = 0;
};

/// The checks that setSamples() promises, for implementations. Throws std::invalid_argument.
void checkSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values);

}  // namespace slipnav
