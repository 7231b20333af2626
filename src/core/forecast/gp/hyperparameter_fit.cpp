#include "core/forecast/gp/hyperparameter_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>

namespace slipnav {
namespace {

/// The objective in the optimizer's coordinates, (θ − start)/typical step, remembering the best point so far.
class Objective {
 public:
  Objective(GaussianProcess& process, const std::vector<LogPrior>& priors, const Eigen::VectorXd& start)
      : process_(process), priors_(priors), start_(start), best_(start), gradient_(start.size()), step_(start.size()) {
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      step_(i) = priors[static_cast<std::size_t>(i)].typical_step;
    }
  }

  /// Callback of NLopt.
  static double evaluate(unsigned count, const double* x, double* gradient, void* self) {
    return static_cast<Objective*>(self)->evaluate(count, x, gradient);
  }

  std::vector<double> toOptimizer(double LogPrior::*bound) const {
    std::vector<double> x(priors_.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      x[i] = (priors_[i].*bound - start_(k)) / step_(k);
    }
    return x;
  }

  /// Gain of a full Newton step from the start, if the steps were standard deviations and uncorrelated.
  double gainToExpect() {
    const std::vector<double> x(priors_.size(), 0.0);
    std::vector<double> gradient(priors_.size());
    evaluate(static_cast<unsigned>(x.size()), x.data(), gradient.data());
    return 0.5 * Eigen::Map<const Eigen::VectorXd>(gradient.data(), start_.size()).squaredNorm();
  }

  const Eigen::VectorXd& best() const { return best_; }
  double bestValue() const { return best_value_; }
  int evaluations() const { return evaluations_; }

 private:
  double evaluate(unsigned count, const double* x, double* gradient) {
    ++evaluations_;
    const Eigen::Map<const Eigen::VectorXd> scaled(x, count);
    const Eigen::VectorXd point = start_ + scaled.cwiseProduct(step_);
    const double value = negativeLogPosterior(process_, priors_, point, gradient == nullptr ? nullptr : &gradient_);
    if (!std::isfinite(value)) {
      throw std::runtime_error("hyperparameter fit: the likelihood is not finite");
    }
    if (gradient != nullptr) {
      Eigen::Map<Eigen::VectorXd>(gradient, count) = gradient_.cwiseProduct(step_);
    }
    if (value < best_value_) {
      best_value_ = value;
      best_ = point;
    }
    return value;
  }

  GaussianProcess& process_;
  const std::vector<LogPrior>& priors_;
  Eigen::VectorXd start_;
  Eigen::VectorXd best_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd step_;
  double best_value_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0;
};

FitOutcome minimize(Objective& objective, std::size_t dimension, const FitSettings& settings) {
  nlopt::opt optimizer(nlopt::LD_SLSQP, static_cast<unsigned>(dimension));
  optimizer.set_min_objective(&Objective::evaluate, &objective);
  optimizer.set_lower_bounds(objective.toOptimizer(&LogPrior::lower));
  optimizer.set_upper_bounds(objective.toOptimizer(&LogPrior::upper));
  optimizer.set_ftol_abs(settings.tolerance);
  std::vector<double> x(dimension, 0.0);
  double value = 0.0;
  try {
    if (objective.gainToExpect() < settings.tolerance) {
      return FitOutcome::kConverged;
    }
    const int budget = settings.max_evaluations - objective.evaluations();
    if (budget < 1) {
      return FitOutcome::kBudgetSpent;
    }
    optimizer.set_maxeval(budget);
    return optimizer.optimize(x, value) == nlopt::MAXEVAL_REACHED ? FitOutcome::kBudgetSpent : FitOutcome::kConverged;
  } catch (const nlopt::roundoff_limited&) {
    return FitOutcome::kConverged;  // no further step improves the objective
  } catch (const std::exception&) {
    return FitOutcome::kFailed;
  }
}

/// Newton steps within bounds with a curvature that they update.
class NewtonSearch {
 public:
  NewtonSearch(GaussianProcess& process, const std::vector<LogPrior>& priors, const Eigen::VectorXd& start,
               const Eigen::MatrixXd& curvature)
      : process_(process),
        priors_(priors),
        best_(start),
        gradient_(Eigen::VectorXd::Zero(start.size())),
        curvature_(curvature) {}

  FitOutcome run(const FitSettings& settings) {
    try {
      best_value_ = evaluate(best_, gradient_);
      for (;;) {
        const Eigen::VectorXd step = boundedStep();
        if (-(gradient_.dot(step) + 0.5 * step.dot(curvature_ * step)) < settings.tolerance) {
          return FitOutcome::kConverged;
        }
        if (evaluations_ >= settings.max_evaluations) {
          return FitOutcome::kBudgetSpent;
        }
        tryStep(step);
      }
    } catch (const std::exception&) {
      return FitOutcome::kFailed;
    }
  }

  const Eigen::VectorXd& best() const { return best_; }
  double bestValue() const { return best_value_; }
  int evaluations() const { return evaluations_; }

 private:
  double evaluate(const Eigen::VectorXd& point, Eigen::VectorXd& gradient) {
    ++evaluations_;
    const double value = negativeLogPosterior(process_, priors_, point, &gradient);
    if (!std::isfinite(value)) {
      throw std::runtime_error("hyperparameter fit: the likelihood is not finite");
    }
    return value;
  }

  // The minimum of the quadratic model within the bounds and not too far away, one coordinate after the other until
  // none moves.
  Eigen::VectorXd boundedStep() const {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(best_.size());
    double largest_move = kStandstill;
    for (int sweep = 0; sweep < kMaxSweeps && largest_move >= kStandstill; ++sweep) {
      largest_move = 0.0;
      for (Eigen::Index i = 0; i < step.size(); ++i) {
        const LogPrior& bounds = priors_[static_cast<std::size_t>(i)];
        const double free = step(i) - (gradient_(i) + curvature_.row(i).dot(step)) / curvature_(i, i);
        const double next = std::clamp(free, std::max(-kLongestStep, bounds.lower - best_(i)),
                                       std::min(kLongestStep, bounds.upper - best_(i)));
        largest_move = std::max(largest_move, std::abs(next - step(i)));
        step(i) = next;
      }
    }
    return step;
  }

  // Takes the step if it gains; in any case it reveals the curvature along it.
  void tryStep(const Eigen::VectorXd& step) {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(step.size());
    const double value = evaluate(best_ + step, gradient);
    const Eigen::VectorXd expected = curvature_ * step;
    Eigen::VectorXd change = gradient - gradient_;
    const double least = kLeastCurvature * step.dot(expected);
    if (step.dot(change) < least) {  // keeps it positive definite
      const double share = (step.dot(expected) - least) / (step.dot(expected) - step.dot(change));
      change = share * change + (1.0 - share) * expected;
    }
    curvature_ += change * change.transpose() / step.dot(change) - expected * expected.transpose() / step.dot(expected);
    if (value < best_value_) {
      best_value_ = value;
      best_ += step;
      gradient_ = gradient;
    } else {
      curvature_ *= kShorter;
    }
  }

  static constexpr int kMaxSweeps = 1000;
  static constexpr double kStandstill = 1e-9;
  static constexpr double kLongestStep = 0.5;     // of a logarithm: farther away the curvature differs
  static constexpr double kLeastCurvature = 0.2;  // of the expected one
  static constexpr double kShorter = 2.0;

  GaussianProcess& process_;
  const std::vector<LogPrior>& priors_;
  Eigen::VectorXd best_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd curvature_;
  double best_value_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0;
};

void requireOneEach(const GaussianProcess& process, const std::vector<LogPrior>& priors, const Eigen::VectorXd& start) {
  if (start.size() != process.parameterCount() || static_cast<std::size_t>(start.size()) != priors.size()) {
    throw std::invalid_argument("hyperparameter fit: start and priors must have one entry per hyperparameter");
  }
}

HyperparameterFit makeFit(FitOutcome outcome, const Eigen::VectorXd& start, const Eigen::VectorXd& best,
                          double best_value, int evaluations, const std::vector<LogPrior>& priors) {
  HyperparameterFit fit;
  fit.outcome = outcome;
  fit.evaluations = evaluations;
  fit.log_parameters = outcome == FitOutcome::kFailed ? start : best;
  fit.objective = best_value;
  fit.negative_log_likelihood = fit.objective;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const LogPrior& prior = priors[static_cast<std::size_t>(i)];
    const double whitened = (fit.log_parameters(i) - prior.mean) / prior.stddev;
    fit.negative_log_likelihood -= 0.5 * whitened * whitened;
  }
  return fit;
}

}  // namespace

Eigen::VectorXd clampToBounds(const Eigen::VectorXd& start, const std::vector<LogPrior>& priors) {
  Eigen::VectorXd clamped = start;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const LogPrior& prior = priors[static_cast<std::size_t>(i)];
    clamped(i) = std::clamp(start(i), prior.lower, prior.upper);
  }
  return clamped;
}

double negativeLogPosterior(GaussianProcess& process, const std::vector<LogPrior>& priors,
                            const Eigen::VectorXd& log_parameters, Eigen::VectorXd* gradient) {
  double value = process.negativeLogLikelihood(log_parameters, gradient);
  for (Eigen::Index i = 0; i < log_parameters.size(); ++i) {
    const LogPrior& prior = priors[static_cast<std::size_t>(i)];
    const double whitened = (log_parameters(i) - prior.mean) / prior.stddev;
    value += 0.5 * whitened * whitened;
    if (gradient != nullptr) {
      (*gradient)(i) += whitened / prior.stddev;
    }
  }
  return value;
}

HyperparameterFit fitHyperparameters(GaussianProcess& process, const std::vector<LogPrior>& priors,
                                     const Eigen::VectorXd& start, const FitSettings& settings) {
  requireOneEach(process, priors, start);
  const Eigen::VectorXd clamped = clampToBounds(start, priors);
  Objective objective(process, priors, clamped);
  const FitOutcome outcome = minimize(objective, priors.size(), settings);
  return makeFit(outcome, clamped, objective.best(), objective.bestValue(), objective.evaluations(), priors);
}

HyperparameterFit refineHyperparameters(GaussianProcess& process, const std::vector<LogPrior>& priors,
                                        const Eigen::VectorXd& start, const Eigen::MatrixXd& curvature,
                                        const FitSettings& settings) {
  requireOneEach(process, priors, start);
  const Eigen::VectorXd clamped = clampToBounds(start, priors);
  NewtonSearch search(process, priors, clamped, curvature);
  const FitOutcome outcome = search.run(settings);
  return makeFit(outcome, clamped, search.best(), search.bestValue(), search.evaluations(), priors);
}

}  // namespace slipnav
