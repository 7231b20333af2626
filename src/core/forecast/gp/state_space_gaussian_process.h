#pragma once
/// Gaussian process regression by Kalman filtering, O(N) per likelihood and gradient.
///
/// A component v · c(t, t') is the output of the process of markov_shape.h. Multiplied by min(t, t') it stays Markov:
/// the Kronecker product of a Wiener process (one state, transition 1, variance t) with the stationary one has
/// transition Φ and covariance t·P∞ at time t, hence process noise Q_k = t_k P∞ − t_{k−1} Φ P∞ Φᵀ ⪰ 0, and covariance
/// Φ(t−t') P∞ min(t, t') between two times, which is exactly the product kernel. The filter carries D = P − v t P∞,
/// the reduction of the prior covariance by the samples: it is predicted by D ← Φ D Φᵀ alone, and Q is never formed.
///
/// Equal to the dense regression for Matérn and constant components; an RBF is approximated (markov_shape.h). The
/// gradient is by forward sensitivities. Predictions are for times from the last sample on; there is no smoother.

#include <memory>

#include "core/forecast/gp/gaussian_process.h"
#include "core/forecast/gp/latent_model.h"

namespace slipnav {

class StateSpaceFilter;

/// Regression with the components of latent_model.h.
class StateSpaceGaussianProcess : public GaussianProcess {
 public:
  /// Throws std::invalid_argument if the components have no states or more than eight in total.
  explicit StateSpaceGaussianProcess(const LatentModel& model);
  ~StateSpaceGaussianProcess() override;

  Eigen::Index parameterCount() const override;
  void setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) override;
  double negativeLogLikelihood(const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient) override;
  double condition(const Eigen::VectorXd& log_parameters) override;
  /// Approximate second derivatives of −log p by the log hyperparameters, from first ones only: with S the variance of
  /// an innovation v, Σ ½ ∂S ∂Sᵀ/S² + ∂v ∂vᵀ/S. Positive semidefinite, and Fisher's information on average (A. Harvey,
  /// Forecasting, Structural Time Series Models and the Kalman Filter, 1989, 3.4.69). Earlier conditioning is
  /// lost.
  Eigen::MatrixXd information(const Eigen::VectorXd& log_parameters);
  /// Throws std::invalid_argument for a time before the last sample.
  LatentPrediction predict(const Eigen::VectorXd& times) const override;
  /// Throws std::invalid_argument for a time before the last sample.
  Eigen::MatrixXd predictCovariance(const Eigen::VectorXd& times) const override;

 private:
  void requirePredictable(const Eigen::VectorXd& times) const;

  std::unique_ptr<StateSpaceFilter> filter_;
  Eigen::VectorXd times_;
  Eigen::VectorXd values_;
  bool conditioned_ = false;
};

}  // namespace slipnav
