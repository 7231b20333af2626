#include "core/forecast/gaussian_process_slip_model.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/forecast/gp/dense_gaussian_process.h"

namespace slipnav {
namespace {

// Initial length scales of a cold fit, relative to the mean of the prior.
constexpr std::array<double, 3> kColdStarts = {1.0, 0.3, 3.0};

// Between logarithms of hyperparameters: a scout that moved farther is checked first.
constexpr double kFarMove = 1.0;

SlipFitStatus statusOf(FitOutcome outcome) {
  switch (outcome) {
    case FitOutcome::kConverged:
      return SlipFitStatus::kConverged;
    case FitOutcome::kBudgetSpent:
      return SlipFitStatus::kNotConverged;
    case FitOutcome::kFailed:
      break;
  }
  return SlipFitStatus::kDefaults;
}

// Where the posterior is highest; the last point if none suits the samples.
Eigen::VectorXd bestOf(GaussianProcess& process, const std::vector<LogPrior>& priors,
                       const std::vector<Eigen::VectorXd>& points) {
  Eigen::VectorXd best = points.back();
  double best_value = std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& point : points) {
    try {
      const double value = negativeLogPosterior(process, priors, point, nullptr);
      if (value < best_value) {
        best_value = value;
        best = point;
      }
    } catch (const std::runtime_error&) {  // not a likelihood at all
    }
  }
  return best;
}

}  // namespace

void SlipModelParameters::visit(ParameterVisitor& v) {
  v.choice("model", model,
           {"paper", "paper_bias", "paper_slow", "brownian_matern", "rbf", "rbf_bias", "rbf_slow", "matern_bias", "ou",
            "ou_bias", "ou_slow"},
           "slip model, see doc/slip_gaussian_process.md");
  v.choice("inference", inference, {"dense", "state_space"},
           "dense: exact, cost cubic in samples; state_space: linear cost, exact but for the RBF");
  v.integer("min_samples", min_samples, {3.0, 10000.0}, "usable slip samples that a window must have");
  v.number("slip_floor", slip_floor, {1e-9, 0.1}, "slip that varies by less than this is treated as constant");
  v.integer("max_evaluations", max_evaluations, {1.0, 10000.0}, "evaluations of the likelihood in one local fit");
  v.number("tolerance", tolerance, {1e-9, 1.0}, "change of the log posterior at which a fit ends");
  v.group("prior", prior, "priors of the hyperparameters, relative to the scale of the window");
}

std::unique_ptr<GaussianProcess> makeGaussianProcess(const std::string& model, const std::string& inference) {
  const LatentModel latent = latentModelByName(model);
  if (inference == "dense") {
    return std::make_unique<DenseGaussianProcess>(makeKernel(latent));
  }
  if (inference == "state_space") {
    return std::make_unique<StateSpaceGaussianProcess>(latent);
  }
  throw std::invalid_argument("forecast.inference: unknown kind '" + inference + "'");
}

GaussianProcessSlipModel::GaussianProcessSlipModel(const SlipModelParameters& parameters)
    : GaussianProcessSlipModel(parameters, makeGaussianProcess(parameters.model, parameters.inference)) {
  if (parameters.inference == "dense") {
    scout_ = std::make_unique<StateSpaceGaussianProcess>(latent_);
  }
  markov_ = scout_ ? scout_.get() : static_cast<StateSpaceGaussianProcess*>(process_.get());
}

GaussianProcessSlipModel::GaussianProcessSlipModel(const SlipModelParameters& parameters,
                                                   std::unique_ptr<GaussianProcess> process)
    : parameters_(parameters), latent_(latentModelByName(parameters.model)), process_(std::move(process)) {}

void GaussianProcessSlipModel::reset() {
  current_.reset();
  last_good_.reset();
}

SlipFit GaussianProcessSlipModel::fit(const SlipSamples& samples) {
  const SlipWindow window = makeSlipWindow(samples);
  if (window.size() < parameters_.min_samples) {
    return report(window, SlipFitStatus::kTooFewSamples, 0);
  }
  if (window.times(0) < 0.0) {
    return report(window, SlipFitStatus::kOriginAfterSample, 0);
  }
  process_->setSamples(window.times, window.slips);
  const std::vector<LogPrior> priors =
      makePriors(latent_, measureScale(window, parameters_.slip_floor), parameters_.prior);
  const Choice choice = chooseHyperparameters(window, priors);
  if (adopt(window, choice.log_parameters)) {
    return report(window, choice.status, choice.evaluations);
  }
  if (current_) {
    const Conditioned before = *current_;
    adopt(before.window, before.log_parameters);
  }
  return report(window, SlipFitStatus::kNotPositiveDefinite, choice.evaluations);
}

GaussianProcessSlipModel::Choice GaussianProcessSlipModel::chooseHyperparameters(const SlipWindow& window,
                                                                                 const std::vector<LogPrior>& priors) {
  if (isConstant(window, parameters_.slip_floor)) {
    return {SlipFitStatus::kConstantSlip, startPoint(latent_, priors, 1.0), 0};
  }
  Choice choice = search(window, priors);
  if (choice.status != SlipFitStatus::kDefaults) {
    last_good_ = choice.log_parameters;
  } else if (last_good_) {
    choice.status = SlipFitStatus::kKeptPrevious;
    choice.log_parameters = *last_good_;
  }
  return choice;
}

GaussianProcessSlipModel::Choice GaussianProcessSlipModel::search(const SlipWindow& window,
                                                                  const std::vector<LogPrior>& priors) {
  GaussianProcess& searched = markov_ != nullptr ? *markov_ : *process_;
  searched.setSamples(window.times, window.slips);
  int evaluations = 0;
  const std::vector<Eigen::VectorXd> starts = startPoints(searched, priors, evaluations);
  Choice choice =
      starts.size() == 1 ? fitFromNearby(searched, priors, starts.front()) : fitFrom(searched, priors, starts);
  evaluations += choice.evaluations;
  if (scout_) {
    choice = fitFromNearby(*process_, priors, afterScout(priors, choice.log_parameters));
    evaluations += choice.evaluations;
  }
  choice.evaluations = evaluations;
  return choice;
}

// Where the dense fit continues. Far from noise and at long length scales the scout's RBF differs from the dense one,
// and can lead away from where the last dense fit ended.
Eigen::VectorXd GaussianProcessSlipModel::afterScout(const std::vector<LogPrior>& priors,
                                                     const Eigen::VectorXd& scouted) {
  if (!last_good_) {
    return scouted;
  }
  const Eigen::VectorXd last = clampToBounds(*last_good_, priors);
  if ((last - scouted).norm() < kFarMove) {
    return scouted;
  }
  return bestOf(*process_, priors, {scouted, last});
}

// The best of the local fits; status kDefaults and the prior's means if none of them ended well.
GaussianProcessSlipModel::Choice GaussianProcessSlipModel::fitFrom(GaussianProcess& process,
                                                                   const std::vector<LogPrior>& priors,
                                                                   const std::vector<Eigen::VectorXd>& starts) const {
  Choice choice{SlipFitStatus::kDefaults, startPoint(latent_, priors, 1.0), 0};
  double best = std::numeric_limits<double>::infinity();
  const FitSettings settings{parameters_.max_evaluations, parameters_.tolerance};
  for (const Eigen::VectorXd& start : starts) {
    const HyperparameterFit fit = fitHyperparameters(process, priors, start, settings);
    choice.evaluations += fit.evaluations;
    if (fit.outcome != FitOutcome::kFailed && fit.objective < best) {
      best = fit.objective;
      choice.log_parameters = fit.log_parameters;
      choice.status = statusOf(fit.outcome);
    }
  }
  return choice;
}

// With the curvature at the start, of the samples and the priors; without it if the start does not suit the samples.
GaussianProcessSlipModel::Choice GaussianProcessSlipModel::fitFromNearby(GaussianProcess& process,
                                                                         const std::vector<LogPrior>& priors,
                                                                         const Eigen::VectorXd& start) {
  const std::optional<Eigen::MatrixXd> curvature = curvatureAt(priors, start);
  if (!curvature) {
    return fitFrom(process, priors, {start});
  }
  const HyperparameterFit fit =
      refineHyperparameters(process, priors, start, *curvature, {parameters_.max_evaluations, parameters_.tolerance});
  return {statusOf(fit.outcome), fit.log_parameters, fit.evaluations + 1};
}

std::optional<Eigen::MatrixXd> GaussianProcessSlipModel::curvatureAt(const std::vector<LogPrior>& priors,
                                                                     const Eigen::VectorXd& start) {
  if (markov_ == nullptr) {
    return std::nullopt;
  }
  try {
    Eigen::MatrixXd curvature = markov_->information(start);
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      const double stddev = priors[static_cast<std::size_t>(i)].stddev;
      curvature(i, i) += 1.0 / (stddev * stddev);
    }
    return curvature;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

// All cold starts; after a good fit the best of its hyperparameters and of the cold starts.
std::vector<Eigen::VectorXd> GaussianProcessSlipModel::startPoints(GaussianProcess& process,
                                                                   const std::vector<LogPrior>& priors,
                                                                   int& evaluations) const {
  std::vector<Eigen::VectorXd> starts;
  starts.reserve(kColdStarts.size() + 1);
  for (const double factor : kColdStarts) {
    starts.push_back(startPoint(latent_, priors, factor));
  }
  if (!last_good_) {
    return starts;
  }
  starts.push_back(clampToBounds(*last_good_, priors));
  evaluations += static_cast<int>(starts.size());
  return {bestOf(process, priors, starts)};
}

bool GaussianProcessSlipModel::adopt(const SlipWindow& window, const Eigen::VectorXd& log_parameters) {
  try {
    process_->setSamples(window.times, window.slips);
    const double value = process_->condition(log_parameters);
    if (!std::isfinite(value)) {
      return false;
    }
    current_ = Conditioned{window, log_parameters, -value};
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

SlipFit GaussianProcessSlipModel::report(const SlipWindow& window, SlipFitStatus status, int evaluations) const {
  SlipFit fit;
  fit.status = status;
  fit.samples = static_cast<int>(window.size());
  fit.left_out = window.left_out;
  fit.evaluations = evaluations;
  if (current_) {
    fit.origin_s = current_->window.origin_s;
    fit.log_marginal_likelihood = current_->log_marginal_likelihood;
    const std::vector<std::string> names = hyperparameterNames(latent_);
    for (std::size_t i = 0; i < names.size(); ++i) {
      fit.hyperparameters.emplace_back(names[i], std::exp(current_->log_parameters(static_cast<Eigen::Index>(i))));
    }
  }
  return fit;
}

Eigen::VectorXd GaussianProcessSlipModel::sinceOrigin(const Eigen::VectorXd& times_s) const {
  if (!current_) {
    throw std::logic_error("slip model: prediction before the first window");
  }
  const Eigen::VectorXd times = times_s.array() - current_->window.origin_s;
  if (!times.allFinite() || (times.array() < 0.0).any()) {
    throw std::invalid_argument("slip model: prediction for a time before the origin, or not finite");
  }
  return times;
}

SlipPrediction GaussianProcessSlipModel::predict(const Eigen::VectorXd& times_s) const {
  const LatentPrediction latent = process_->predict(sinceOrigin(times_s));
  return {times_s, latent.mean, latent.variance.cwiseSqrt()};
}

Eigen::MatrixXd GaussianProcessSlipModel::predictCovariance(const Eigen::VectorXd& times_s) const {
  return process_->predictCovariance(sinceOrigin(times_s));
}

}  // namespace slipnav
