#include "core/forecast/gp/dense_gaussian_process.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {
namespace {

// Tried in turn until the factorization succeeds. Noise at the level allowed by the fits never needs any but the first.
constexpr std::array<double, 4> kRelativeJitters = {0.0, 1e-12, 1e-10, 1e-8};

// A sample whose covariance with a prediction is below this share of the prior variance contributes nothing in double
// precision, even summed over thousands of samples. Treated as zero: denormal numbers would be slow.
constexpr double kNegligibleCorrelation = 1e-20;

// Two columns are multiples of each other if they differ by less than this share: a few times the rounding of an
// exponential. The contribution of the samples to a prediction then differs by less than 1e-9 of itself.
constexpr double kSameShape = 1e-14;

// The f with column = f · other, or zero if there is none.
double multipleOf(const Eigen::Ref<const Eigen::VectorXd>& other, const Eigen::Ref<const Eigen::VectorXd>& column) {
  Eigen::Index largest = 0;
  const double size = other.cwiseAbs().maxCoeff(&largest);
  if (size == 0.0) {
    return 0.0;
  }
  const double factor = column(largest) / other(largest);
  const double difference = (column - factor * other).cwiseAbs().maxCoeff();
  return difference <= kSameShape * std::abs(factor) * size ? factor : 0.0;
}

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

DenseGaussianProcess::DenseGaussianProcess(KernelPtr latent) : latent_(std::move(latent)) {}

void DenseGaussianProcess::setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) {
  checkSamples(times, values);
  times_ = times;
  values_ = values;
  factor_.resize(times.size(), times.size());
  conditioned_ = false;
}

void DenseGaussianProcess::setLogParameters(const Eigen::VectorXd& log_parameters) {
  const Eigen::Index latent_parameters = latent_->parameterCount();
  latent_->setLogParameters(log_parameters.head(latent_parameters));
  noise_variance_ = std::exp(log_parameters(latent_parameters));
}

void DenseGaussianProcess::fillCovariance(bool with_derivatives) {
  const Eigen::Index n = times_.size();
  if (with_derivatives) {
    derivatives_.resize(n * (n + 1) / 2, latent_->parameterCount());
  }
  Eigen::Index row = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index length = n - j;
    if (with_derivatives) {
      latent_->columnWithDerivatives(times_.tail(length), times_(j), factor_.col(j).tail(length),
                                     derivatives_.middleRows(row, length));
      row += length;
    } else {
      latent_->column(times_.tail(length), times_(j), factor_.col(j).tail(length));
    }
  }
  factor_.diagonal().array() += noise_variance_;
}

void DenseGaussianProcess::factorize(bool with_derivatives) {
  for (const double jitter : kRelativeJitters) {
    fillCovariance(with_derivatives);
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
  setLogParameters(log_parameters);
  factorize(gradient != nullptr);
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

// ∂(−log p)/∂θ = −½ tr((α αᵀ − K⁻¹) ∂K/∂θ), over the lower triangle.
void DenseGaussianProcess::likelihoodGradient(Eigen::VectorXd& gradient) {
  const Eigen::Index n = times_.size();
  inverse_factor_.setZero(n, n);
  invertLowerTriangle(factor_, inverse_factor_);
  precision_.resize(n, n);
  multiplyTransposedByLowerTriangle(inverse_factor_, precision_);
  weights_.resize(derivatives_.rows());
  double diagonal = 0.0;
  Eigen::Index row = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Ref<Eigen::VectorXd> weights = weights_.segment(row, n - j);
    weights = precision_.col(j).tail(n - j) - alpha_(j) * alpha_.tail(n - j);
    weights(0) *= 0.5;  // entries below the diagonal count twice
    diagonal += weights(0);
    row += n - j;
  }
  gradient.resize(parameterCount());
  gradient.head(latent_->parameterCount()).noalias() = derivatives_.transpose() * weights_;
  gradient(latent_->parameterCount()) = noise_variance_ * diagonal;
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
  // Far from the samples the posterior is the prior; and where all components but a single-state one have faded, a
  // column is a multiple of the previous one. Only the others are solved for, together.
  Eigen::MatrixXd cross(times_.size(), times.size());
  std::vector<std::pair<Eigen::Index, double>> sources;  // column solved for, and its factor
  sources.reserve(static_cast<std::size_t>(times.size()));
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    prediction.variance(i) = crossCovariance(times(i), cross.col(count));
    prediction.mean(i) = cross.col(count).dot(alpha_);
    double factor = count == 0 ? 0.0 : multipleOf(cross.col(count - 1), cross.col(count));
    if (factor == 0.0 && (cross.col(count).array() != 0.0).any()) {
      factor = 1.0;
      ++count;
    }
    sources.emplace_back(count - 1, factor);
  }
  factor_.triangularView<Eigen::Lower>().solveInPlace(cross.leftCols(count));
  const Eigen::VectorXd known = cross.leftCols(count).colwise().squaredNorm();
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const auto [column, factor] = sources[static_cast<std::size_t>(i)];
    if (factor != 0.0) {
      prediction.variance(i) = std::max(0.0, prediction.variance(i) - factor * factor * known(column));
    }
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
