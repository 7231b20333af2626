#include "slipnav/forecast/dense_gaussian_process.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "slipnav/types.h"

namespace slipnav {
namespace {

// Tried in turn until the factorisation succeeds. Noise at the level that the fits allow never needs any but the first.
constexpr std::array<double, 4> kRelativeJitters = {0.0, 1e-12, 1e-10, 1e-8};

// A sample whose covariance with a prediction is below this share of the prior variance tells nothing in double
// precision, even summed over thousands of samples. Taken as zero: what follows would be slow on denormal numbers.
constexpr double kNegligibleCorrelation = 1e-20;

// Inverse of the lower triangular `l` into the lower triangle of `out`, whose upper triangle must be zero:
// [A 0; B C]⁻¹ = [A⁻¹ 0; −C⁻¹ B A⁻¹ C⁻¹], a third of the work of solving for the identity.
void invertLowerTriangle(const Eigen::Ref<const Eigen::MatrixXd>& l, Eigen::Ref<Eigen::MatrixXd> out) {
  constexpr Eigen::Index kDirect = 16;
  const Eigen::Index n = l.rows();
  if (n <= kDirect) {
    out.setIdentity();
    l.triangularView<Eigen::Lower>().solveInPlace(out);
    return;
  }
  const Eigen::Index a = n / 2;
  const Eigen::Index c = n - a;
  invertLowerTriangle(l.topLeftCorner(a, a), out.topLeftCorner(a, a));
  invertLowerTriangle(l.bottomRightCorner(c, c), out.bottomRightCorner(c, c));
  out.bottomLeftCorner(c, a).noalias() = -l.bottomLeftCorner(c, a) * out.topLeftCorner(a, a);
  out.bottomLeftCorner(c, a) = out.bottomRightCorner(c, c).triangularView<Eigen::Lower>() * out.bottomLeftCorner(c, a);
}

// Lower triangle of out = WᵀW for lower triangular W, in the same blocks: [AᵀA + BᵀB ·; CᵀB CᵀC].
void multiplyTransposedByLowerTriangle(const Eigen::Ref<const Eigen::MatrixXd>& w, Eigen::Ref<Eigen::MatrixXd> out) {
  constexpr Eigen::Index kDirect = 32;
  const Eigen::Index n = w.rows();
  if (n <= kDirect) {
    out.triangularView<Eigen::Lower>() = w.transpose() * w;
    return;
  }
  const Eigen::Index a = n / 2;
  const Eigen::Index c = n - a;
  multiplyTransposedByLowerTriangle(w.topLeftCorner(a, a), out.topLeftCorner(a, a));
  multiplyTransposedByLowerTriangle(w.bottomRightCorner(c, c), out.bottomRightCorner(c, c));
  out.topLeftCorner(a, a).selfadjointView<Eigen::Lower>().rankUpdate(w.bottomLeftCorner(c, a).transpose());
  out.bottomLeftCorner(c, a) =
      w.bottomRightCorner(c, c).triangularView<Eigen::Lower>().transpose() * w.bottomLeftCorner(c, a);
}

}  // namespace

DenseGaussianProcess::DenseGaussianProcess(KernelPtr latent)
    : latent_(std::move(latent)), total_(latent_ + std::make_shared<WhiteKernel>(1.0)) {}

void DenseGaussianProcess::setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) {
  checkSamples(times, values);
  times_ = times;
  values_ = values;
  factor_.resize(times.size(), times.size());
  conditioned_ = false;
}

void DenseGaussianProcess::fillCovariance() {
  const Eigen::Index n = times_.size();
  for (Eigen::Index j = 0; j < n; ++j) {
    total_->column(times_.tail(n - j), times_(j), factor_.col(j).tail(n - j));
  }
}

void DenseGaussianProcess::factorize() {
  for (const double jitter : kRelativeJitters) {
    fillCovariance();
    factor_.diagonal().array() += jitter * factor_.diagonal().mean();
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(factor_);
    if (cholesky.info() == Eigen::Success && factor_.diagonal().allFinite()) {
      relative_jitter_ = jitter;
      return;
    }
  }
  throw std::runtime_error("gaussian process: the covariance of the samples is not positive definite");
}

double DenseGaussianProcess::negativeLogLikelihood(const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient) {
  conditioned_ = false;
  total_->setLogParameters(log_parameters);
  factorize();
  alpha_ = values_;
  factor_.triangularView<Eigen::Lower>().solveInPlace(alpha_);
  const double fit = 0.5 * alpha_.squaredNorm();
  factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(alpha_);
  if (gradient != nullptr) {
    likelihoodGradient(*gradient);
  }
  const double half_log_2pi = 0.5 * std::log(2.0 * kPi);
  return fit + factor_.diagonal().array().log().sum() + static_cast<double>(values_.size()) * half_log_2pi;
}

// ∂(−log p)/∂θ = −½ tr((α αᵀ − K⁻¹) ∂K/∂θ), column by column over the lower triangle.
void DenseGaussianProcess::likelihoodGradient(Eigen::VectorXd& gradient) {
  const Eigen::Index n = times_.size();
  inverse_factor_.setZero(n, n);
  invertLowerTriangle(factor_, inverse_factor_);
  precision_.resize(n, n);
  multiplyTransposedByLowerTriangle(inverse_factor_, precision_);
  weights_.resize(n);
  gradient.setZero(parameterCount());
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Ref<Eigen::VectorXd> weights = weights_.tail(n - j);
    weights = precision_.col(j).tail(n - j) - alpha_(j) * alpha_.tail(n - j);
    weights(0) *= 0.5;  // entries below the diagonal stand for two
    total_->addColumnGradient(times_.tail(n - j), times_(j), weights, gradient);
  }
}

double DenseGaussianProcess::condition(const Eigen::VectorXd& log_parameters) {
  const double value = negativeLogLikelihood(log_parameters, nullptr);
  conditioned_ = true;
  return value;
}

void DenseGaussianProcess::requireConditioned() const {
  if (!conditioned_) {
    throw std::logic_error("gaussian process: prediction before conditioning");
  }
}

double DenseGaussianProcess::crossCovariance(double time, Kernel::Out out) const {
  const double prior_variance = latent_->variance(time);
  latent_->column(times_, time, out);
  out = (out.array().abs() > kNegligibleCorrelation * prior_variance).select(out, 0.0);
  return prior_variance;
}

LatentPrediction DenseGaussianProcess::predict(const Eigen::VectorXd& times) const {
  requireConditioned();
  LatentPrediction prediction{Eigen::VectorXd::Zero(times.size()), Eigen::VectorXd(times.size())};
  // Far from the samples the posterior is the prior; only the columns that differ from it are solved for, together.
  Eigen::MatrixXd cross(times_.size(), times.size());
  std::vector<Eigen::Index> informed;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const auto count = static_cast<Eigen::Index>(informed.size());
    prediction.variance(i) = crossCovariance(times(i), cross.col(count));
    if ((cross.col(count).array() != 0.0).any()) {
      prediction.mean(i) = cross.col(count).dot(alpha_);
      informed.push_back(i);
    }
  }
  const auto count = static_cast<Eigen::Index>(informed.size());
  factor_.triangularView<Eigen::Lower>().solveInPlace(cross.leftCols(count));
  for (Eigen::Index k = 0; k < count; ++k) {
    double& variance = prediction.variance(informed[static_cast<std::size_t>(k)]);
    variance = std::max(0.0, variance - cross.col(k).squaredNorm());
  }
  return prediction;
}

Eigen::MatrixXd DenseGaussianProcess::predictCovariance(const Eigen::VectorXd& times) const {
  requireConditioned();
  const Eigen::Index n = times.size();
  Eigen::MatrixXd whitened(times_.size(), n);
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    crossCovariance(times(j), whitened.col(j));
    latent_->column(times, times(j), covariance.col(j));
  }
  factor_.triangularView<Eigen::Lower>().solveInPlace(whitened);
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(whitened.transpose(), -1.0);
  return covariance.selfadjointView<Eigen::Lower>();
}

}  // namespace slipnav
