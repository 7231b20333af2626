#include "core/forecast/gp/state_space_gaussian_process.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/forecast/gp/state_space_filter.h"

namespace slipnav {
namespace {

constexpr Eigen::Index kMaxStates = 8;

std::vector<MarkovComponent> makeComponents(const LatentModel& model) {
  std::vector<MarkovComponent> components;
  Eigen::Index state = 0;
  Eigen::Index parameter = 0;
  for (const LatentComponent& component : model) {
    components.push_back(
        {MarkovShape(component.correlation), component.brownian, component.hasLengthScale(), state, parameter});
    state += components.back().shape.dimension();
    parameter += component.hasLengthScale() ? 2 : 1;
  }
  return components;
}

Eigen::Index stateCount(const std::vector<MarkovComponent>& components) {
  return components.empty() ? 0 : components.back().first_state + components.back().shape.dimension();
}

// Filters of two, four, six and eight states; the smallest sufficient one is used.
template <int D = 2>
std::unique_ptr<StateSpaceFilter> makeFilter(std::vector<MarkovComponent> components) {
  if constexpr (D > kMaxStates) {
    throw std::invalid_argument("gaussian process: the state-space form takes one to eight states");
  } else {
    const Eigen::Index states = stateCount(components);
    if (states > 0 && states <= D) {
      return std::make_unique<FixedStateSpaceFilter<D>>(std::move(components));
    }
    return makeFilter<D + 2>(std::move(components));
  }
}

}  // namespace

StateSpaceFilter::StateSpaceFilter(std::vector<MarkovComponent> components) : components_(std::move(components)) {
  for (const MarkovComponent& component : components_) {
    parameter_count_ += component.has_length_scale ? 2 : 1;
  }
}

void StateSpaceFilter::setLogParameters(const Eigen::VectorXd& log_parameters) {
  for (MarkovComponent& component : components_) {
    component.variance = std::exp(log_parameters(component.first_parameter));
    if (component.has_length_scale) {
      component.length_scale_s = std::exp(log_parameters(component.first_parameter + 1));
    }
  }
  noise_variance_ = std::exp(log_parameters(parameter_count_ - 1));
}

// Scaling all variances together scales the covariance, whose derivative is known: only S changes, not the
// innovations. The noise derivative is what the components leave of that.
void StateSpaceFilter::addNoise(double count_less_chi_square, Eigen::VectorXd& gradient) {
  const Eigen::Index noise = parameter_count_ - 1;
  const Eigen::Index samples = whitened_.rows() / 2;
  gradient(noise) = 0.5 * count_less_chi_square;
  for (Eigen::Index k = 0; k < samples; ++k) {
    whitened_(2 * k, noise) = std::sqrt(0.5);
    whitened_(2 * k + 1, noise) = 0.0;
  }
  for (const MarkovComponent& component : components_) {
    gradient(noise) -= gradient(component.first_parameter);
    whitened_.col(noise) -= whitened_.col(component.first_parameter);
  }
}

double StateSpaceFilter::priorVariance(double time) const {
  double variance = 0.0;
  for (const MarkovComponent& component : components_) {
    variance += component.priorVariance(time);
  }
  return variance;
}

double StateSpaceFilter::priorCovariance(double earlier, double later) const {
  double covariance = 0.0;
  for (const MarkovComponent& component : components_) {
    covariance += component.priorVariance(earlier) * component.shape.correlation(component.tau(later - earlier));
  }
  return covariance;
}

StateSpaceGaussianProcess::StateSpaceGaussianProcess(const LatentModel& model)
    : filter_(makeFilter(makeComponents(model))) {}

StateSpaceGaussianProcess::~StateSpaceGaussianProcess() = default;

Eigen::Index StateSpaceGaussianProcess::parameterCount() const { return filter_->parameterCount(); }

void StateSpaceGaussianProcess::setSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) {
  checkSamples(times, values);
  times_ = times;
  values_ = values;
  conditioned_ = false;
}

double StateSpaceGaussianProcess::negativeLogLikelihood(const Eigen::VectorXd& log_parameters,
                                                        Eigen::VectorXd* gradient) {
  conditioned_ = false;
  filter_->setLogParameters(log_parameters);
  return filter_->run(times_, values_, gradient);
}

Eigen::MatrixXd StateSpaceGaussianProcess::information(const Eigen::VectorXd& log_parameters) {
  Eigen::VectorXd gradient;
  negativeLogLikelihood(log_parameters, &gradient);
  return filter_->information();
}

double StateSpaceGaussianProcess::condition(const Eigen::VectorXd& log_parameters) {
  const double value = negativeLogLikelihood(log_parameters, nullptr);
  conditioned_ = true;
  return value;
}

void StateSpaceGaussianProcess::requirePredictable(const Eigen::VectorXd& times) const {
  if (!conditioned_) {
    throw std::logic_error("gaussian process: prediction before conditioning");
  }
  if (times.size() > 0 && !(times.minCoeff() >= times_(times_.size() - 1))) {
    throw std::invalid_argument("gaussian process: the state-space form predicts from the last sample on");
  }
}

LatentPrediction StateSpaceGaussianProcess::predict(const Eigen::VectorXd& times) const {
  requirePredictable(times);
  return filter_->predict(times_(times_.size() - 1), times);
}

Eigen::MatrixXd StateSpaceGaussianProcess::predictCovariance(const Eigen::VectorXd& times) const {
  requirePredictable(times);
  return filter_->predictCovariance(times_(times_.size() - 1), times);
}

}  // namespace slipnav
