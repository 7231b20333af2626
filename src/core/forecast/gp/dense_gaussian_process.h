#pragma once
/// Exact Gaussian process regression by Cholesky factorization: the reference, O(N³) per likelihood.
///
/// Source: Rasmussen & Williams, algorithm 2.1 and equation 5.9.

#include "core/forecast/gp/gaussian_process.h"
#include "core/forecast/gp/kernel.h"

namespace slipnav {

/// Regression with any kernel; matrices are kept between calls and grow with the window.
class DenseGaussianProcess : public GaussianProcess {
 public:
  /// @param latent the kernel of f; its parameters are overwritten by those of each call
  explicit DenseGaussianProcess(KernelPtr latent);

  Eigen::Index parameterCount() const override { return latent_->parameterCount() + 1; }
  void setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) override;
  double negativeLogLikelihood(const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient) override;
  double condition(const Eigen::VectorXd& log_parameters) override;
  LatentPrediction predict(const Eigen::VectorXd& times) const override;
  Eigen::MatrixXd predictCovariance(const Eigen::VectorXd& times) const override;

  /// What had to be added to the diagonal to make the last covariance positive definite in floating point, relative to
  /// its mean; zero for every well-posed one.
  double relativeJitter() const { return relative_jitter_; }

 private:
  void factorize(bool with_derivatives);
  void setLogParameters(const Eigen::VectorXd& log_parameters);
  void fillCovariance(bool with_derivatives);
  void likelihoodGradient(Eigen::VectorXd& gradient);
  void requireConditioned() const;
  double crossCovariance(double time, Kernel::Out out) const;  ///< with the samples; returns the prior variance

  KernelPtr latent_;
  double noise_variance_ = 1.0;
  Eigen::VectorXd times_;
  Eigen::VectorXd values_;
  Eigen::MatrixXd factor_;          ///< lower triangle: covariance of the samples, then its Cholesky factor L
  Eigen::MatrixXd inverse_factor_;  ///< L⁻¹
  Eigen::MatrixXd precision_;       ///< lower triangle: inverse of the covariance of the samples
  Eigen::VectorXd alpha_;           ///< K⁻¹ y
  Eigen::MatrixXd derivatives_;     ///< of the lower triangle's columns, stacked, by latent parameter
  Eigen::VectorXd weights_;         ///< K⁻¹ − α αᵀ in the same order
  double relative_jitter_ = 0.0;
  bool conditioned_ = false;
};

}  // namespace slipnav
