#include "core/forecast/gp/hyperparameter_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/forecast/gp/dense_gaussian_process.h"
#include "core/forecast/gp/latent_model.h"
#include "core/forecast/gp/state_space_gaussian_process.h"
#include "core/forecast/hyperparameter_prior.h"
#include "core/forecast/slip_window.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

constexpr FitSettings kSettings{60, 1e-3};

/// The recorded window with the paper's model, priors and all.
struct PaperFit {
  explicit PaperFit(std::optional<double> origin_s) {
    SlipSamples samples = readGpSlip();
    samples.origin_s = origin_s;
    const SlipWindow window = makeSlipWindow(samples);
    last_s = window.times(window.size() - 1);
    process.setSamples(window.times, window.slips);
    priors = makePriors(model, measureScale(window, 1e-3), PriorParameters());
  }

  double stddevAhead(const Eigen::VectorXd& theta, double ahead_s) {
    process.condition(theta);
    return std::sqrt(process.predict(Eigen::VectorXd::Constant(1, last_s + ahead_s)).variance(0));
  }

  LatentModel model = latentModelByName("paper");
  DenseGaussianProcess process{makeKernel(model)};
  std::vector<LogPrior> priors;
  double last_s = 0.0;
};

Eigen::VectorXd logarithms(double variance, double length_scale_s, double noise_variance) {
  return Eigen::Vector3d(std::log(variance), std::log(length_scale_s), std::log(noise_variance));
}

/// Maximum likelihood as one would do it without thinking: L-BFGS from ones, no priors, bounds that only keep it
/// finite.
double plainFitFromOnes(GaussianProcess& process) {
  nlopt::opt optimizer(nlopt::LD_LBFGS, 3);
  const auto objective = [](unsigned count, const double* x, double* gradient, void* data) {
    Eigen::VectorXd slope;
    const Eigen::VectorXd theta = Eigen::Map<const Eigen::VectorXd>(x, count);
    const double value = static_cast<GaussianProcess*>(data)->negativeLogLikelihood(theta, &slope);
    if (gradient != nullptr) {
      Eigen::Map<Eigen::VectorXd>(gradient, count) = slope;
    }
    return value;
  };
  optimizer.set_min_objective(objective, &process);
  optimizer.set_lower_bounds(-18.0);
  optimizer.set_upper_bounds(18.0);
  optimizer.set_ftol_abs(1e-6);
  optimizer.set_maxeval(500);
  std::vector<double> x(3, 0.0);
  double value = 0.0;
  try {
    optimizer.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
    // where it stands is where it ends
  }
  return process.negativeLogLikelihood(Eigen::Map<const Eigen::VectorXd>(x.data(), 3), nullptr);
}

TEST(HyperparameterFit, FindsTheSmoothOptimumOfTheRecordedSlip) {
  PaperFit paper(0.0);  // the clock of the file
  const HyperparameterFit fit =
      fitHyperparameters(paper.process, paper.priors, startPoint(paper.model, paper.priors, 1.0), kSettings);
  EXPECT_EQ(fit.outcome, FitOutcome::kConverged);
  EXPECT_NEAR(fit.negative_log_likelihood, -212.93, 0.02);
  EXPECT_NEAR(std::exp(fit.log_parameters(1)), 0.93, 0.05);
  EXPECT_NEAR(std::exp(fit.log_parameters(2)), 0.0028, 0.0001);
  EXPECT_DOUBLE_EQ(fit.negative_log_likelihood, paper.process.negativeLogLikelihood(fit.log_parameters, nullptr));
}

TEST(HyperparameterFit, LandsInTheCorrespondingOptimumForEveryOriginOfTime) {
  for (const GpOptimum& optimum : readGpOptima()) {
    SCOPED_TRACE(optimum.origin_s);
    PaperFit paper(optimum.origin_s);
    for (const double factor : {0.3, 1.0, 3.0}) {
      const HyperparameterFit fit =
          fitHyperparameters(paper.process, paper.priors, startPoint(paper.model, paper.priors, factor), kSettings);
      EXPECT_EQ(fit.outcome, FitOutcome::kConverged);
      EXPECT_NEAR(-fit.negative_log_likelihood, optimum.log_marginal_likelihood, 0.02);
      EXPECT_NEAR(-fit.negative_log_likelihood, 212.93, 0.3);
      EXPECT_NEAR(std::exp(fit.log_parameters(1)) / optimum.length_scale_s, 1.0, 0.05);
      EXPECT_NEAR(paper.stddevAhead(fit.log_parameters, 10.0) / optimum.stddev_10s, 1.0, 0.1);
    }
  }
}

TEST(HyperparameterFit, APlainOptimizerFromOnesMissesIt) {
  for (const GpOptimum& optimum : readGpOptima()) {
    PaperFit paper(optimum.origin_s);
    EXPECT_GT(std::abs(-plainFitFromOnes(paper.process) - optimum.log_marginal_likelihood), 0.3) << optimum.origin_s;
  }
}

TEST(HyperparameterFit, UnitOfTimeAndSizeOfSlipDoNotMatter) {
  const SlipSamples seconds = readGpSlip();
  SlipSamples scaled = seconds;
  for (double& time : scaled.times_s) {
    time *= 1000.0;
  }
  for (double& slip : scaled.slips) {
    slip *= 0.5;
  }
  const LatentModel model = latentModelByName("paper");
  std::vector<Eigen::VectorXd> fitted;
  for (const SlipSamples& samples : {seconds, scaled}) {
    const SlipWindow window = makeSlipWindow(samples);
    DenseGaussianProcess process(makeKernel(model));
    process.setSamples(window.times, window.slips);
    const std::vector<LogPrior> priors = makePriors(model, measureScale(window, 1e-6), PriorParameters());
    fitted.push_back(fitHyperparameters(process, priors, startPoint(model, priors, 1.0), kSettings).log_parameters);
  }
  const Eigen::VectorXd change = (fitted[1] - fitted[0]).array().exp();
  EXPECT_NEAR(change(0), 0.25 / 1000.0, 1e-8);
  EXPECT_NEAR(change(1), 1000.0, 1e-2);
  EXPECT_NEAR(change(2), 0.25, 1e-6);
}

TEST(HyperparameterFit, LeavesThePlantedOptimaThatForecastNothing) {
  // The interpolating one, ℓ → ∞, pure noise, and a model of nothing but its own noise floor.
  const std::vector<Eigen::VectorXd> planted = {logarithms(6e-4, 0.107, 8.7e-4), logarithms(6e-4, 0.09, 1e-9),
                                                logarithms(2.8e-3, 1e3, 0.0026), logarithms(1e-12, 1.0, 0.0046)};
  PaperFit paper(std::nullopt);
  for (const Eigen::VectorXd& start : planted) {
    const HyperparameterFit fit = fitHyperparameters(paper.process, paper.priors, start, kSettings);
    EXPECT_EQ(fit.outcome, FitOutcome::kConverged);
    EXPECT_NEAR(fit.negative_log_likelihood, -212.90, 0.02) << start.transpose();
    EXPECT_NEAR(std::exp(fit.log_parameters(1)), 1.0, 0.1) << start.transpose();
  }
}

TEST(HyperparameterFit, PosteriorGradientEqualsCentralDifferences) {
  PaperFit paper(std::nullopt);
  const Eigen::VectorXd theta = logarithms(1e-3, 0.5, 0.004);
  Eigen::VectorXd gradient;
  negativeLogPosterior(paper.process, paper.priors, theta, &gradient);
  for (Eigen::Index p = 0; p < 3; ++p) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(3, p);
    const double numeric = (negativeLogPosterior(paper.process, paper.priors, theta + step, nullptr) -
                            negativeLogPosterior(paper.process, paper.priors, theta - step, nullptr)) /
                           2e-5;
    EXPECT_NEAR(gradient(p), numeric, 1e-6);
  }
}

TEST(HyperparameterFit, StaysInBounds) {
  PaperFit paper(std::nullopt);
  paper.priors[1].lower = std::log(2.0);  // the optimum of 1.0 is outside now
  const HyperparameterFit fit =
      fitHyperparameters(paper.process, paper.priors, startPoint(paper.model, paper.priors, 1.0), kSettings);
  EXPECT_NEAR(std::exp(fit.log_parameters(1)), 2.0, 1e-9);
}

TEST(HyperparameterFit, BudgetIsKeptAndSaid) {
  PaperFit paper(std::nullopt);
  const Eigen::VectorXd start = startPoint(paper.model, paper.priors, 3.0);
  const HyperparameterFit fit = fitHyperparameters(paper.process, paper.priors, start, {3, 1e-3});
  EXPECT_EQ(fit.outcome, FitOutcome::kBudgetSpent);
  EXPECT_LE(fit.evaluations, 3);
  EXPECT_LE(fit.objective, negativeLogPosterior(paper.process, paper.priors, start, nullptr));
}

/// Curvature of the recorded window's posterior, from the state-space form.
Eigen::MatrixXd curvatureAt(const PaperFit& paper, const Eigen::VectorXd& theta) {
  const SlipWindow window = makeSlipWindow(readGpSlip());
  StateSpaceGaussianProcess markov(paper.model);
  markov.setSamples(window.times, window.slips);
  Eigen::MatrixXd curvature = markov.information(theta);
  for (Eigen::Index i = 0; i < theta.size(); ++i) {
    const double stddev = paper.priors[static_cast<std::size_t>(i)].stddev;
    curvature(i, i) += 1.0 / (stddev * stddev);
  }
  return curvature;
}

TEST(HyperparameterFit, RefinementFindsTheOptimumOfALongFitInFewEvaluations) {
  PaperFit paper(std::nullopt);
  const HyperparameterFit best =
      fitHyperparameters(paper.process, paper.priors, startPoint(paper.model, paper.priors, 1.0), {500, 1e-9});
  for (const double off : {-0.4, 0.1, 0.4}) {
    const Eigen::VectorXd start = best.log_parameters.array() + off;
    const HyperparameterFit fit =
        refineHyperparameters(paper.process, paper.priors, start, curvatureAt(paper, start), {60, 1e-3});
    EXPECT_EQ(fit.outcome, FitOutcome::kConverged) << off;
    EXPECT_NEAR(fit.objective, best.objective, 3e-3) << off;
    EXPECT_LE(fit.evaluations, 6) << off;
    EXPECT_DOUBLE_EQ(fit.negative_log_likelihood, paper.process.negativeLogLikelihood(fit.log_parameters, nullptr));
  }
}

TEST(HyperparameterFit, RefinementRecoversFromAWrongCurvature) {
  PaperFit paper(std::nullopt);
  const Eigen::VectorXd start = startPoint(paper.model, paper.priors, 1.0);
  for (const double factor : {0.1, 10.0}) {
    const HyperparameterFit fit =
        refineHyperparameters(paper.process, paper.priors, start, factor * curvatureAt(paper, start), {60, 1e-4});
    EXPECT_EQ(fit.outcome, FitOutcome::kConverged) << factor;
    EXPECT_NEAR(fit.negative_log_likelihood, -212.90, 0.02) << factor;
  }
}

TEST(HyperparameterFit, RefinementStaysInBoundsAndBudget) {
  PaperFit paper(std::nullopt);
  paper.priors[1].lower = std::log(2.0);  // the optimum of 1.0 is outside now
  const Eigen::VectorXd start = startPoint(paper.model, paper.priors, 3.0);
  const Eigen::MatrixXd curvature = curvatureAt(paper, start);
  const HyperparameterFit fit = refineHyperparameters(paper.process, paper.priors, start, curvature, {60, 1e-4});
  const HyperparameterFit best = fitHyperparameters(paper.process, paper.priors, start, {500, 1e-9});
  EXPECT_NEAR(std::exp(fit.log_parameters(1)), 2.0, 1e-9);
  EXPECT_NEAR(fit.objective, best.objective, 1e-3);
  const HyperparameterFit short_one = refineHyperparameters(paper.process, paper.priors, start, curvature, {1, 1e-4});
  EXPECT_EQ(short_one.outcome, FitOutcome::kBudgetSpent);
  EXPECT_EQ(short_one.evaluations, 1);
}

/// A regression whose likelihood breaks after some evaluations.
class BreakingProcess : public GaussianProcess {
 public:
  enum class Way { kNaN, kThrow };
  BreakingProcess(Way way, int good_evaluations) : way_(way), left_(good_evaluations) {}

  Eigen::Index parameterCount() const override { return 1; }
  void setSamples(const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
  double negativeLogLikelihood(const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) override {
    if (left_-- <= 0) {
      if (way_ == Way::kThrow) {
        throw std::runtime_error("not positive definite");
      }
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (gradient != nullptr) {
      *gradient = 2.0 * theta;
    }
    return theta.squaredNorm();
  }
  double condition(const Eigen::VectorXd&) override { return 0.0; }
  LatentPrediction predict(const Eigen::VectorXd&) const override { return {}; }
  Eigen::MatrixXd predictCovariance(const Eigen::VectorXd&) const override { return {}; }

 private:
  Way way_;
  int left_;
};

TEST(HyperparameterFit, ABreakingLikelihoodFailsAndReturnsTheStart) {
  const std::vector<LogPrior> priors = {{0.0, 1.0, -10.0, 10.0, 0.1}};
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(1, 5.0);
  for (const BreakingProcess::Way way : {BreakingProcess::Way::kNaN, BreakingProcess::Way::kThrow}) {
    for (const int good : {0, 1}) {
      BreakingProcess process(way, good);
      const HyperparameterFit fit = fitHyperparameters(process, priors, start, kSettings);
      EXPECT_EQ(fit.outcome, FitOutcome::kFailed);
      EXPECT_EQ(fit.log_parameters, start);
      BreakingProcess other(way, good);
      const HyperparameterFit refined =
          refineHyperparameters(other, priors, start, Eigen::MatrixXd::Identity(1, 1), kSettings);
      EXPECT_EQ(refined.outcome, FitOutcome::kFailed);
      EXPECT_EQ(refined.log_parameters, start);
    }
  }
}

TEST(HyperparameterFit, AStartAtTheOptimumIsTheEnd) {
  const std::vector<LogPrior> priors = {{0.0, 1.0, -10.0, 10.0, 0.1}};
  BreakingProcess process(BreakingProcess::Way::kThrow, 1000);
  const HyperparameterFit fit = fitHyperparameters(process, priors, Eigen::VectorXd::Zero(1), kSettings);
  EXPECT_EQ(fit.outcome, FitOutcome::kConverged);
  EXPECT_EQ(fit.log_parameters(0), 0.0);
  EXPECT_EQ(fit.objective, 0.0);
  EXPECT_EQ(fit.evaluations, 1);
}

TEST(HyperparameterFit, LengthsMustAgree) {
  BreakingProcess process(BreakingProcess::Way::kNaN, 0);
  const Eigen::MatrixXd curvature = Eigen::MatrixXd::Identity(1, 1);
  const std::vector<LogPrior> two(2);
  for (const std::vector<LogPrior>& priors : {std::vector<LogPrior>(), two}) {
    EXPECT_THROW(fitHyperparameters(process, priors, Eigen::VectorXd::Zero(1), kSettings), std::invalid_argument);
    EXPECT_THROW(refineHyperparameters(process, priors, Eigen::VectorXd::Zero(1), curvature, kSettings),
                 std::invalid_argument);
  }
  EXPECT_THROW(fitHyperparameters(process, two, Eigen::VectorXd::Zero(2), kSettings), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
