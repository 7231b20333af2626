#include "core/forecast/hyperparameter_prior.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

// A variance may differ by this factor from the power of slip in the window.
constexpr double kVarianceRange = 1e4;
// A slow component persists for this many spans of the window, up to the second number.
constexpr double kMinSlowSpans = 0.5;
constexpr double kMaxSlowSpans = 20.0;
constexpr double kMeanSlowSpans = 2.0;
// Time over length scale that counts as one independent value of the process: the integral of an RBF, √(2π).
constexpr double kIndependentLengths = 2.5;

bool hasPersistentPart(const LatentModel& model) {
  return std::any_of(model.begin(), model.end(),
                     [](const LatentComponent& component) { return component.role != ComponentRole::kSlip; });
}

LogPrior makePrior(double mean, double stddev, double lower, double upper, double typical_step) {
  return {std::log(mean), stddev, std::log(lower), std::log(upper), typical_step};
}

double slipLengthScale(const WindowScale& scale) { return std::sqrt(scale.interval_s * scale.span_s); }

// Relative standard deviation of a variance estimated from `independent` values.
double varianceStep(double independent) { return std::sqrt(2.0 / std::max(2.0, independent)); }

LogPrior variancePrior(const LatentComponent& component, double power, const WindowScale& scale,
                       const PriorParameters& parameters) {
  const double independent =
      component.role == ComponentRole::kSlip ? scale.span_s / (kIndependentLengths * slipLengthScale(scale)) : 1.0;
  const double unit = component.brownian ? power / scale.mean_time_s : power;
  return makePrior(unit, parameters.variance_log_stddev, unit / kVarianceRange, unit * kVarianceRange,
                   varianceStep(independent));
}

LogPrior lengthScalePrior(const LatentComponent& component, const WindowScale& scale,
                          const PriorParameters& parameters) {
  if (component.role == ComponentRole::kSlow) {
    return makePrior(kMeanSlowSpans * scale.span_s, parameters.length_scale_log_stddev, kMinSlowSpans * scale.span_s,
                     kMaxSlowSpans * scale.span_s, parameters.length_scale_log_stddev);
  }
  const double mean = slipLengthScale(scale);
  const double lower = parameters.min_length_scale_samples * scale.interval_s;
  const double upper = std::max(lower, parameters.max_length_scale_spans * scale.span_s);
  const double step = varianceStep(scale.span_s / (kIndependentLengths * mean));
  return makePrior(mean, parameters.length_scale_log_stddev, lower, upper, step);
}

}  // namespace

void PriorParameters::visit(ParameterVisitor& v) {
  v.number("min_length_scale_samples", min_length_scale_samples, {1.0, 100.0},
           "smallest length scale of slip, in sample intervals");
  v.number("max_length_scale_spans", max_length_scale_spans, {0.05, 10.0},
           "largest length scale of slip, in lengths of the window");
  v.number("length_scale_log_stddev", length_scale_log_stddev, {0.01, 100.0},
           "standard deviation of the logarithm of the length scale in its prior");
  v.number("variance_log_stddev", variance_log_stddev, {0.01, 100.0},
           "standard deviation of the logarithm of a slip variance in its prior");
  v.number("noise_log_stddev", noise_log_stddev, {0.01, 100.0},
           "standard deviation of the logarithm of the noise variance in its prior");
  v.number("min_noise_ratio", min_noise_ratio, {1e-6, 1.0},
           "smallest noise variance, over half the mean square of successive differences");
  v.number("max_noise_ratio", max_noise_ratio, {1.0, 100.0},
           "largest noise variance, over half the mean square of successive differences");
}

std::vector<LogPrior> makePriors(const LatentModel& model, const WindowScale& scale,
                                 const PriorParameters& parameters) {
  // The varying part explains the variation; without a persistent part it has to explain the mean as well.
  const double slip_power = hasPersistentPart(model) ? scale.variance : scale.power;
  std::vector<LogPrior> priors;
  for (const LatentComponent& component : model) {
    const double power = component.role == ComponentRole::kSlip ? slip_power : scale.power;
    priors.push_back(variancePrior(component, power, scale, parameters));
    if (component.hasLengthScale()) {
      priors.push_back(lengthScalePrior(component, scale, parameters));
    }
  }
  priors.push_back(makePrior(
      scale.difference_power, parameters.noise_log_stddev, parameters.min_noise_ratio * scale.difference_power,
      parameters.max_noise_ratio * scale.difference_power, varianceStep(static_cast<double>(scale.count))));
  return priors;
}

Eigen::VectorXd startPoint(const LatentModel& model, const std::vector<LogPrior>& priors, double factor) {
  Eigen::VectorXd start(static_cast<Eigen::Index>(priors.size()));
  for (std::size_t i = 0; i < priors.size(); ++i) {
    start(static_cast<Eigen::Index>(i)) = priors[i].mean;
  }
  Eigen::Index parameter = 0;
  for (const LatentComponent& component : model) {
    if (component.hasLengthScale() && component.role == ComponentRole::kSlip) {
      start(parameter + 1) += std::log(factor);
    }
    parameter += component.hasLengthScale() ? 2 : 1;
  }
  return clampToBounds(start, priors);
}

}  // namespace slipnav
