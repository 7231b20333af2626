#pragma once
/// The Kalman filter behind StateSpaceGaussianProcess, of a fixed number of states D for speed. A model with fewer
/// states leaves the last ones unused: without output, covariance and transition they stay zero.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "slipnav/forecast/gaussian_process.h"
#include "slipnav/forecast/markov_shape.h"
#include "slipnav/types.h"

namespace slipnav {

/// One component of the model and where its states and hyperparameters stand.
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

  /// −log p; leaves the filter at the last sample.
  virtual double run(const Eigen::VectorXd& times, const Eigen::VectorXd& values, Eigen::VectorXd* gradient) = 0;
  virtual LatentPrediction predict(double last_time, const Eigen::VectorXd& times) const = 0;
  virtual Eigen::MatrixXd predictCovariance(double last_time, const Eigen::VectorXd& times) const = 0;

 protected:
  double priorVariance(double time) const;
  double priorCovariance(double earlier, double later) const;

  std::vector<MarkovComponent> components_;
  Eigen::Index parameter_count_ = 1;
  double noise_variance_ = 1.0;
};

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

  /// What one component contributes, in the full state.
  struct Block {
    Matrix drift = Matrix::Zero();      ///< F in its rows and columns
    Vector unit_gain = Vector::Zero();  ///< P∞ h in its rows
  };

  bool hasPairs() const;
  Matrix fromLeft(const Matrix& drift_like, const Matrix& m) const;
  Belief predicted(const Matrix& phi, const Belief& belief) const;
  Matrix transition(double interval_s) const;
  Vector outputAfter(double interval_s) const;
  void predictSensitivities(const Matrix& phi, double interval_s, const Belief& predicted_belief);
  Innovation innovate(double time, double value) const;
  void updateSensitivities(const Innovation& innovation, double time, Eigen::VectorXd& gradient);
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

// Whether drift, and with it the transition, has nothing but blocks of 2×2 on its diagonal: conjugate pairs of poles,
// and single states. Products with them then take a quarter of the work, with the same result to the last bit.
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

// B·M for a B with the zeros of the drift.
template <int D>
typename FixedStateSpaceFilter<D>::Matrix FixedStateSpaceFilter<D>::fromLeft(const Matrix& drift_like,
                                                                             const Matrix& m) const {
  Matrix product;
  if (!has_pairs_) {
    product.noalias() = drift_like * m;
    return product;
  }
  for (Eigen::Index i = 0; i < D; i += 2) {
    product.template middleRows<2>(i) = drift_like.template block<2, 2>(i, i).lazyProduct(m.template middleRows<2>(i));
  }
  return product;
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
typename FixedStateSpaceFilter<D>::Belief FixedStateSpaceFilter<D>::predicted(const Matrix& phi,
                                                                              const Belief& belief) const {
  Belief next;
  next.mean = phi * belief.mean;
  const Matrix half = fromLeft(phi, belief.reduction);
  if (!has_pairs_) {
    next.reduction.noalias() = half * phi.transpose();
    return next;
  }
  for (Eigen::Index i = 0; i < D; i += 2) {
    next.reduction.template middleCols<2>(i) =
        half.template middleCols<2>(i).lazyProduct(phi.template block<2, 2>(i, i).transpose());
  }
  return next;
}

template <int D>
void FixedStateSpaceFilter<D>::predictSensitivities(const Matrix& phi, double interval_s,
                                                    const Belief& predicted_belief) {
  for (Belief& sensitivity : sensitivities_) {
    sensitivity = predicted(phi, sensitivity);
  }
  for (std::size_t c = 0; c < components_.size(); ++c) {
    if (!components_[c].has_length_scale) {
      continue;
    }
    // ∂Φ/∂log ℓ = −τ F Φ
    Belief& sensitivity = sensitivities_[static_cast<std::size_t>(components_[c].first_parameter + 1)];
    const Matrix rate = -components_[c].tau(interval_s) * blocks_[c].drift;
    const Matrix change = fromLeft(rate, predicted_belief.reduction);
    sensitivity.mean += rate * predicted_belief.mean;
    sensitivity.reduction += change + change.transpose();
  }
}

template <int D>
typename FixedStateSpaceFilter<D>::Innovation FixedStateSpaceFilter<D>::innovate(double time, double value) const {
  Innovation innovation;
  innovation.gain = belief_.reduction * output_;
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
  belief_.reduction.noalias() -= scaled * innovation.gain.transpose();
}

// Derivatives of updateBelief() and of the likelihood of one sample.
template <int D>
void FixedStateSpaceFilter<D>::updateSensitivities(const Innovation& innovation, double time,
                                                   Eigen::VectorXd& gradient) {
  const double inverse = 1.0 / innovation.variance;
  const Vector scaled = innovation.gain * inverse;
  const double whitened = innovation.value * inverse;
  const auto updateOne = [&](Eigen::Index parameter, const Vector& prior_gain) {
    Belief& sensitivity = sensitivities_[static_cast<std::size_t>(parameter)];
    const Vector gain = sensitivity.reduction * output_ + prior_gain;
    const double variance = output_.dot(gain);
    const double value = -output_.dot(sensitivity.mean);
    const Vector scaled_change = gain * inverse - scaled * (variance * inverse);
    sensitivity.mean += scaled_change * innovation.value + scaled * value;
    const Matrix outer = gain * scaled.transpose();
    sensitivity.reduction -= outer + outer.transpose() - (variance * scaled) * scaled.transpose();
    gradient(parameter) += 0.5 * variance * (inverse - whitened * whitened) + whitened * value;
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
  }
  double log_variances = 0.0;
  double chi_square = 0.0;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const double interval_s = k == 0 ? 0.0 : times(k) - times(k - 1);
    const Matrix phi = transition(interval_s);
    const Belief next = predicted(phi, belief_);
    if (gradient != nullptr) {
      predictSensitivities(phi, interval_s, next);
    }
    belief_ = next;
    const Innovation innovation = innovate(times(k), values(k));
    if (gradient != nullptr) {
      updateSensitivities(innovation, times(k), *gradient);
    }
    updateBelief(innovation);
    log_variances += std::log(innovation.variance);
    chi_square += innovation.value * innovation.value / innovation.variance;
  }
  const auto count = static_cast<double>(times.size());
  if (gradient != nullptr) {
    // Scaling all variances together scales the covariance, whose derivative is known; the noise is what remains.
    double of_components = 0.0;
    for (const MarkovComponent& component : components_) {
      of_components += (*gradient)(component.first_parameter);
    }
    (*gradient)(parameter_count_ - 1) = 0.5 * (count - chi_square) - of_components;
  }
  return 0.5 * (log_variances + chi_square + count * std::log(2.0 * kPi));
}

template <int D>
typename FixedStateSpaceFilter<D>::Vector FixedStateSpaceFilter<D>::outputAfter(double interval_s) const {
  return transition(interval_s).transpose() * output_;
}

template <int D>
LatentPrediction FixedStateSpaceFilter<D>::predict(double last_time, const Eigen::VectorXd& times) const {
  LatentPrediction prediction{Eigen::VectorXd(times.size()), Eigen::VectorXd(times.size())};
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const Vector output = outputAfter(times(i) - last_time);
    prediction.mean(i) = output.dot(belief_.mean);
    prediction.variance(i) = std::max(0.0, priorVariance(times(i)) + output.dot(belief_.reduction * output));
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
