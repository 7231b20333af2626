#pragma once
/// Stationary correlation functions as linear stochastic differential equations.
///
/// With τ the time over the length scale: dz = F z dτ + L dw, f = hᵀ z, and hᵀ e^{Fτ} P∞ h is the correlation, one at
/// τ = 0. Matérn shapes are exact. The RBF has no finite-dimensional state: the reciprocal of its spectral density is
/// expanded to the sixth order, which leaves an error of at most 0.0043 in the correlation.
///
/// Source: J. Hartikainen, S. Särkkä, Kalman filtering and smoothing solutions to temporal Gaussian process regression
/// models, IEEE MLSP 2010.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/forecast/gp/latent_model.h"

namespace slipnav {

/// One shape: its matrices, and the transition over a time. Immutable.
class MarkovShape {
 public:
  explicit MarkovShape(Correlation correlation);

  /// Number of states.
  Eigen::Index dimension() const { return output_.size(); }
  /// F, per length scale.
  const Eigen::MatrixXd& drift() const { return drift_; }
  /// P∞, with hᵀ P∞ h = 1.
  const Eigen::MatrixXd& stationaryCovariance() const { return stationary_covariance_; }
  /// P∞ h.
  const Eigen::VectorXd& stationaryGain() const { return stationary_gain_; }
  /// h.
  const Eigen::VectorXd& output() const { return output_; }

  /// phi = e^{F tau} for tau ≥ 0; phi must be zero on entry, since entries that are zero for all tau are not written.
  void transition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const;

  /// hᵀ e^{F tau} P∞ h for tau ≥ 0: the actual correlation of the state.
  double correlation(double tau) const;

 private:
  void buildConstant();
  void buildMatern(MaternOrder order);
  void buildRbf();
  void maternTransition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const;
  void modalTransition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const;

  Correlation correlation_;
  Eigen::MatrixXd drift_;
  Eigen::MatrixXd stationary_covariance_;
  Eigen::VectorXd stationary_gain_;
  Eigen::VectorXd output_;
  double rate_ = 0.0;                              ///< Matérn: the only pole is −rate
  std::vector<Eigen::MatrixXd> nilpotent_powers_;  ///< Matérn: ((F + rate·I)^k)/k!
  std::vector<std::complex<double>> poles_;        ///< RBF: one of each conjugate pair
};

}  // namespace slipnav
