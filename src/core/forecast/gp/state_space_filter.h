#pragma once
/// The Kalman filter behind StateSpaceGaussianProcess, with a fixed number of states D for speed. A model with fewer
/// states leaves the last ones unused: without output, covariance and transition they stay zero.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/forecast/gp/gaussian_process.h"
#include "core/forecast/gp/markov_shape.h"
#include "core/forecast/gp/paired_blocks.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// One component of the model and the positions of its states and hyperparameters.
struct MarkovComponent {
  MarkovShape shape;
  bool brownian;
  bool has_length_scale;
  Eigen::Index first_state;
  Eigen::Index first_parameter;
  double variance = 1.0;
  double length_scale_s = 1.0;

  double tau(double interval_s) const { return has_length_scale ? interval_s / length_scale_s : 0.0; }
  double priorVariance(double time) const { return brownian ? variance * time : variance; }
};

/// Interface that hides the number of states.
class StateSpaceFilter {
 public:
  explicit StateSpaceFilter(std::vector<MarkovComponent> components);
  virtual ~StateSpaceFilter() = default;

  Eigen::Index parameterCount() const { return parameter_count_; }
  void setLogParameters(const Eigen::VectorXd& log_parameters);

  /// −log p; leaves the filter at the last sample. The gradient also yields the whitened sensitivities.
  virtual double run(const Eigen::VectorXd& times, const Eigen::VectorXd& values, Eigen::VectorXd* gradient) = 0;
  /// Expected information of the samples on the log hyperparameters, at the last run with a gradient.
  Eigen::MatrixXd information() const { return whitened_.transpose() * whitened_; }
  virtual LatentPrediction predict(double last_time, const Eigen::VectorXd& times) const = 0;
  virtual Eigen::MatrixXd predictCovariance(double last_time, const Eigen::VectorXd& times) const = 0;

 protected:
  void addNoise(double count_less_chi_square, Eigen::VectorXd& gradient);
  double priorVariance(double time) const;
  double priorCovariance(double earlier, double later) const;

  std::vector<MarkovComponent> components_;
  Eigen::Index parameter_count_ = 1;
  double noise_variance_ = 1.0;
  /// By hyperparameter, two rows a sample: the derivatives of the innovation variance S over √2 S, and those of the
  /// innovation over √S.
  Eigen::MatrixXd whitened_;
};

/// The filter for components with at most D states in total.
template <int D>
class FixedStateSpaceFilter : public StateSpaceFilter {
 public:
  explicit FixedStateSpaceFilter(std::vector<MarkovComponent> components);
  double run(const Eigen::VectorXd& times, const Eigen::VectorXd& values, Eigen::VectorXd* gradient) override;
  LatentPrediction predict(double last_time, const Eigen::VectorXd& times) const override;
  Eigen::MatrixXd predictCovariance(double last_time, const Eigen::VectorXd& times) const override;

 private:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// Filter state, or its derivative with respect to one log hyperparameter.
  struct Belief {
    Vector mean = Vector::Zero();
    Matrix reduction = Matrix::Zero();  ///< posterior minus prior covariance, negative semidefinite
  };
  /// One update: innovation, its variance, and the covariance of the state with it.
  struct Innovation {
    double value = 0.0;
    double variance = 0.0;
    Vector gain = Vector::Zero();
  };

  /// Contribution of one component, in the full state.
  struct Block {
    Matrix drift = Matrix::Zero();      ///< F in its rows and columns
    Vector unit_gain = Vector::Zero();  ///< P∞ h in its rows
  };

  bool hasPairs() const;
  void predict(const Matrix& phi, Belief& belief) const;
  Matrix transition(double interval_s) const;
  Vector outputAfter(double interval_s) const;
  void predictSensitivities(const Matrix& phi, double interval_s);
  Innovation innovate(double time, double value) const;
  void updateSensitivities(const Innovation& innovation, double time, Eigen::Index sample, Eigen::VectorXd& gradient);
  void updateBelief(const Innovation& innovation);

  std::vector<Block> blocks_;  ///< one per component
  Vector output_ = Vector::Zero();
  bool has_pairs_;
  Belief belief_;
  std::vector<Belief> sensitivities_;  ///< one per hyperparameter except the noise
};

template <int D>
FixedStateSpaceFilter<D>::FixedStateSpaceFilter(std::vector<MarkovComponent> components)
    : StateSpaceFilter(std::move(components)) {
  for (const MarkovComponent& component : components_) {
    const Eigen::Index i = component.first_state;
    const Eigen::Index n = component.shape.dimension();
    Block block;
    block.drift.block(i, i, n, n) = component.shape.drift();
    block.unit_gain.segment(i, n) = component.shape.stationaryGain();
    blocks_.push_back(block);
    output_.segment(i, n) = component.shape.output();
  }
  has_pairs_ = hasPairs();
}

// Whether drift, and with it the transition, has only 2×2 blocks on its diagonal: conjugate pairs of poles,
// and single states. Products with them then go block by block, and those above the diagonal mirror those below.
template <int D>
bool FixedStateSpaceFilter<D>::hasPairs() const {
  Matrix outside = Matrix::Zero();
  for (const Block& block : blocks_) {
    outside += block.drift;
  }
  for (Eigen::Index i = 0; i < D; i += 2) {
    outside.template block<2, 2>(i, i).setZero();
  }
  return outside.isZero(0.0);
}

template <int D>
typename FixedStateSpaceFilter<D>::Matrix FixedStateSpaceFilter<D>::transition(double interval_s) const {
  Matrix phi = Matrix::Zero();
  for (const MarkovComponent& component : components_) {
    const Eigen::Index i = component.first_state;
    const Eigen::Index n = component.shape.dimension();
    component.shape.transition(component.tau(interval_s), phi.block(i, i, n, n));
  }
  return phi;
}

template <int D>
void FixedStateSpaceFilter<D>::predict(const Matrix& phi, Belief& belief) const {
  belief.mean = phi.lazyProduct(belief.mean).eval();
  if (has_pairs_) {
    transformPairs(phi, belief.reduction);
  } else {
    belief.reduction = (phi * belief.reduction).eval() * phi.transpose();
  }
}

template <int D>
void FixedStateSpaceFilter<D>::predictSensitivities(const Matrix& phi, double interval_s) {
  for (Belief& sensitivity : sensitivities_) {
    predict(phi, sensitivity);
  }
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const MarkovComponent& component = components_[c];
    if (!component.has_length_scale) {
      continue;
    }
    // ∂Φ/∂log ℓ = −τ F Φ
    Belief& sensitivity = sensitivities_[static_cast<std::size_t>(component.first_parameter + 1)];
    const Matrix rate = -component.tau(interval_s) * blocks_[c].drift;
    sensitivity.mean += rate.lazyProduct(belief_.mean);
    if (has_pairs_) {
      addRateOfPairs(rate, belief_.reduction, component.first_state,
                     component.first_state + component.shape.dimension(), sensitivity.reduction);
    } else {
      const Matrix change = rate * belief_.reduction;
      sensitivity.reduction += change + change.transpose();
    }
  }
}

template <int D>
typename FixedStateSpaceFilter<D>::Innovation FixedStateSpaceFilter<D>::innovate(double time, double value) const {
  Innovation innovation;
  innovation.gain = belief_.reduction.lazyProduct(output_);
  for (std::size_t c = 0; c < components_.size(); ++c) {
    innovation.gain += components_[c].priorVariance(time) * blocks_[c].unit_gain;
  }
  innovation.value = value - output_.dot(belief_.mean);
  innovation.variance = output_.dot(innovation.gain) + noise_variance_;
  if (!(innovation.variance > 0.0)) {
    throw std::runtime_error("gaussian process: the covariance of the samples is not positive definite");
  }
  return innovation;
}

template <int D>
void FixedStateSpaceFilter<D>::updateBelief(const Innovation& innovation) {
  const Vector scaled = innovation.gain / innovation.variance;
  belief_.mean += scaled * innovation.value;
  belief_.reduction -= scaled.lazyProduct(innovation.gain.transpose());
}

// Derivatives of updateBelief() and of the likelihood of one sample.
template <int D>
void FixedStateSpaceFilter<D>::updateSensitivities(const Innovation& innovation, double time, Eigen::Index sample,
                                                   Eigen::VectorXd& gradient) {
  const double inverse = 1.0 / innovation.variance;
  const Vector scaled = innovation.gain * inverse;
  const double whitened = innovation.value * inverse;
  const auto updateOne = [&](Eigen::Index parameter, const Vector& prior_gain) {
    Belief& sensitivity = sensitivities_[static_cast<std::size_t>(parameter)];
    const Vector gain = sensitivity.reduction.lazyProduct(output_) + prior_gain;
    const double variance = output_.dot(gain);
    const double value = -output_.dot(sensitivity.mean);
    const Vector scaled_change = gain * inverse - scaled * (variance * inverse);
    sensitivity.mean += scaled_change * innovation.value + scaled * value;
    const Vector half = gain - (0.5 * variance) * scaled;
    for (Eigen::Index i = 0; i < D; ++i) {
      sensitivity.reduction.col(i) -= half * scaled(i) + scaled * half(i);
    }
    gradient(parameter) += 0.5 * variance * (inverse - whitened * whitened) + whitened * value;
    whitened_(2 * sample, parameter) = std::sqrt(0.5) * inverse * variance;
    whitened_(2 * sample + 1, parameter) = std::sqrt(inverse) * value;
  };
  for (std::size_t c = 0; c < components_.size(); ++c) {
    updateOne(components_[c].first_parameter, components_[c].priorVariance(time) * blocks_[c].unit_gain);
    if (components_[c].has_length_scale) {
      updateOne(components_[c].first_parameter + 1, Vector::Zero());
    }
  }
}

template <int D>
double FixedStateSpaceFilter<D>::run(const Eigen::VectorXd& times, const Eigen::VectorXd& values,
                                     Eigen::VectorXd* gradient) {
  belief_ = Belief();
  if (gradient != nullptr) {
    sensitivities_.assign(static_cast<std::size_t>(parameter_count_ - 1), Belief());
    gradient->setZero(parameter_count_);
    whitened_.resize(2 * times.size(), parameter_count_);
  }
  double log_variances = 0.0;
  double chi_square = 0.0;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const double interval_s = k == 0 ? 0.0 : times(k) - times(k - 1);
    const Matrix phi = transition(interval_s);
    predict(phi, belief_);
    if (gradient != nullptr) {
      predictSensitivities(phi, interval_s);
    }
    const Innovation innovation = innovate(times(k), values(k));
    if (gradient != nullptr) {
      updateSensitivities(innovation, times(k), k, *gradient);
    }
    updateBelief(innovation);
    log_variances += std::log(innovation.variance);
    chi_square += innovation.value * innovation.value / innovation.variance;
  }
  const auto count = static_cast<double>(times.size());
  if (gradient != nullptr) {
    addNoise(count - chi_square, *gradient);
  }
  return 0.5 * (log_variances + chi_square + count * std::log(2.0 * kPi));
}

template <int D>
typename FixedStateSpaceFilter<D>::Vector FixedStateSpaceFilter<D>::outputAfter(double interval_s) const {
  return transition(interval_s).transpose().lazyProduct(output_);
}

template <int D>
LatentPrediction FixedStateSpaceFilter<D>::predict(double last_time, const Eigen::VectorXd& times) const {
  LatentPrediction prediction{Eigen::VectorXd(times.size()), Eigen::VectorXd(times.size())};
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const Vector output = outputAfter(times(i) - last_time);
    prediction.mean(i) = output.dot(belief_.mean);
    prediction.variance(i) = std::max(0.0, priorVariance(times(i)) + output.dot(belief_.reduction.lazyProduct(output)));
  }
  return prediction;
}

template <int D>
Eigen::MatrixXd FixedStateSpaceFilter<D>::predictCovariance(double last_time, const Eigen::VectorXd& times) const {
  const Eigen::Index n = times.size();
  Eigen::MatrixXd outputs(D, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    outputs.col(i) = outputAfter(times(i) - last_time);
  }
  Eigen::MatrixXd covariance = outputs.transpose() * belief_.reduction * outputs;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      covariance(i, j) += priorCovariance(std::min(times(i), times(j)), std::max(times(i), times(j)));
      covariance(j, i) = covariance(i, j);
    }
  }
  return covariance;
}

}  // namespace slipnav
