#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/gp/dense_gaussian_process.h"
#include "core/parameters/parameter_checker.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

SlipModelParameters parametersOf(const std::string& model, const std::string& inference = "dense") {
  SlipModelParameters parameters;
  parameters.model = model;
  parameters.inference = inference;
  return parameters;
}

double lastTime() { return readGpSlip().times_s.back(); }

Eigen::VectorXd ahead(double start_s, double horizon_s, Eigen::Index count = 60) {
  return Eigen::VectorXd::LinSpaced(count, start_s, start_s + horizon_s);
}

void expectFinite(const SlipModel& model, double start_s) {
  const SlipPrediction prediction = model.predict(ahead(start_s, 60.0));
  EXPECT_TRUE(prediction.mean.allFinite());
  EXPECT_TRUE(prediction.stddev.allFinite());
  EXPECT_TRUE((prediction.stddev.array() >= 0.0).all());
  EXPECT_TRUE(model.predictCovariance(ahead(start_s, 60.0)).allFinite());
}

/// Whether two models predict the same.
void expectSamePredictions(const SlipModel& a, const SlipModel& b, double start_s, double tolerance) {
  const Eigen::VectorXd times_s = ahead(start_s, 60.0);
  const SlipPrediction one = a.predict(times_s);
  const SlipPrediction other = b.predict(times_s);
  EXPECT_LE((one.mean - other.mean).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((one.stddev - other.stddev).cwiseAbs().maxCoeff(), tolerance);
}

TEST(SlipModel, EveryModelAndInferenceFitsTheRecordedWindow) {
  for (const std::string& name : latentModelNames()) {
    for (const char* inference : {"dense", "state_space"}) {
      SCOPED_TRACE(name + " " + inference);
      GaussianProcessSlipModel model(parametersOf(name, inference));
      EXPECT_FALSE(model.isReady());
      const SlipFit fit = model.fit(readGpSlip());
      EXPECT_EQ(fit.status, SlipFitStatus::kConverged);
      EXPECT_TRUE(model.isReady());
      EXPECT_EQ(fit.samples, 150);
      EXPECT_EQ(fit.left_out, 0);
      EXPECT_GT(fit.log_marginal_likelihood, 195.0);
      EXPECT_LT(fit.log_marginal_likelihood, 214.0);
      EXPECT_EQ(fit.hyperparameters.size(), hyperparameterNames(latentModelByName(name)).size());
      EXPECT_EQ(fit.hyperparameter("variance"), fit.hyperparameters.front().second);
      EXPECT_EQ(fit.hyperparameter("noise_variance"), fit.hyperparameters.back().second);
      EXPECT_EQ(fit.hyperparameter("of another model"), 0.0);
      expectFinite(model, lastTime());
    }
  }
}

TEST(SlipModel, StateSpaceFitEqualsTheDenseOneForMarkovModels) {
  for (const char* name : {"brownian_matern", "matern_bias", "ou_bias", "ou_slow"}) {
    SCOPED_TRACE(name);
    GaussianProcessSlipModel dense(parametersOf(name));
    GaussianProcessSlipModel markov(parametersOf(name, "state_space"));
    const SlipFit expected = dense.fit(readGpSlip());
    EXPECT_NEAR(markov.fit(readGpSlip()).log_marginal_likelihood, expected.log_marginal_likelihood, 0.01);
    expectSamePredictions(dense, markov, lastTime(), 2e-3);
  }
}

TEST(SlipModel, MovingTheClockChangesNothing) {
  GaussianProcessSlipModel here(parametersOf("paper"));
  GaussianProcessSlipModel there(parametersOf("paper"));
  SlipSamples moved = readGpSlip();
  for (double& time_s : moved.times_s) {
    time_s += 1000.0;
  }
  const SlipFit fit = here.fit(readGpSlip());
  const SlipFit moved_fit = there.fit(moved);
  EXPECT_NEAR(moved_fit.origin_s, fit.origin_s + 1000.0, 1e-9);
  EXPECT_NEAR(moved_fit.log_marginal_likelihood, fit.log_marginal_likelihood, 1e-6);
  const Eigen::VectorXd times_s = ahead(lastTime(), 60.0);
  EXPECT_TRUE(here.predict(times_s).stddev.isApprox(there.predict(times_s.array() + 1000.0).stddev, 1e-6));
}

TEST(SlipModel, AWarmFitTakesFewEvaluationsAndEndsWhereAColdOneDoes) {
  const SlipSamples all = readGpSlip();
  GaussianProcessSlipModel warm(parametersOf("paper", "state_space"));
  int evaluations = 0;
  for (std::ptrdiff_t start = 0; start <= 50; start += 10) {
    const SlipSamples window{{all.times_s.begin() + start, all.times_s.begin() + start + 100},
                             {all.slips.begin() + start, all.slips.begin() + start + 100},
                             {}};
    const SlipFit fit = warm.fit(window);
    GaussianProcessSlipModel cold(parametersOf("paper", "state_space"));
    EXPECT_NEAR(fit.log_marginal_likelihood, cold.fit(window).log_marginal_likelihood, 0.05) << start;
    evaluations += start == 0 ? 0 : fit.evaluations;
  }
  EXPECT_LE(evaluations / 5, 14);
}

TEST(SlipModel, AMisledWarmStartIsLeft) {
  // First a window of pure trend, whose length scale is at the upper bound, then the recorded one, from where a local
  // fit alone would end in a maximum at several seconds (log likelihood 207).
  SlipSamples recorded = readGpSlip();
  recorded.origin_s = 0.0;
  SlipSamples trend = recorded;
  for (std::size_t i = 0; i < trend.slips.size(); ++i) {
    trend.slips[i] = 0.004 * static_cast<double>(i) - 0.2 + 0.9 * trend.slips[i];
  }
  for (const char* inference : {"dense", "state_space"}) {
    GaussianProcessSlipModel misled(parametersOf("paper", inference));
    const SlipFit trend_fit = misled.fit(trend);
    EXPECT_GT(trend_fit.hyperparameters[1].second, 5.0);
    EXPECT_NEAR(misled.fit(recorded).log_marginal_likelihood, 212.93, 0.1) << inference;
  }
}

TEST(SlipModel, PersistentSlipIsRememberedOnlyWithAMean) {
  SlipSamples samples = readGpSlip();
  for (double& slip : samples.slips) {
    slip = 0.2 + 0.3 * slip;
  }
  GaussianProcessSlipModel paper(parametersOf("paper"));
  GaussianProcessSlipModel with_mean(parametersOf("paper_bias"));
  paper.fit(samples);
  with_mean.fit(samples);
  const Eigen::VectorXd far = ahead(lastTime() + 55.0, 5.0);
  EXPECT_LT(paper.predict(far).mean.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_NEAR(with_mean.predict(far).mean.mean(), 0.2, 0.02);
}

TEST(SlipModel, TooFewSamplesAreRefused) {
  SlipSamples samples = readGpSlip();
  samples.times_s.resize(14);
  samples.slips.resize(14);
  GaussianProcessSlipModel model(parametersOf("paper"));
  const SlipFit fit = model.fit(samples);
  EXPECT_EQ(fit.status, SlipFitStatus::kTooFewSamples);
  EXPECT_EQ(fit.samples, 14);
  EXPECT_TRUE(fit.hyperparameters.empty());
  EXPECT_FALSE(isAccepted(fit.status));
  EXPECT_FALSE(model.isReady());
  EXPECT_THROW(model.predict(ahead(lastTime(), 1.0)), std::logic_error);
  samples = readGpSlip();
  samples.times_s.resize(15);
  samples.slips.resize(15);
  EXPECT_TRUE(isAccepted(model.fit(samples).status));
  expectFinite(model, samples.times_s.back());
}

TEST(SlipModel, ARefusedWindowLeavesTheModelAsItWas) {
  GaussianProcessSlipModel model(parametersOf("paper"));
  GaussianProcessSlipModel reference(parametersOf("paper"));
  const SlipFit before = model.fit(readGpSlip());
  reference.fit(readGpSlip());
  SlipSamples late_origin = readGpSlip();
  late_origin.origin_s = late_origin.times_s[3];
  for (const SlipSamples& refused : {SlipSamples{}, SlipSamples{{1.0, 2.0}, {0.1, 0.2}, {}}, late_origin}) {
    const SlipFit fit = model.fit(refused);
    EXPECT_FALSE(isAccepted(fit.status));
    EXPECT_EQ(fit.hyperparameters, before.hyperparameters);
    expectSamePredictions(model, reference, lastTime(), 0.0);
  }
  EXPECT_EQ(model.fit(late_origin).status, SlipFitStatus::kOriginAfterSample);
}

TEST(SlipModel, ConstantSlipIsTakenWithoutAFit) {
  for (const double value : {0.0, 0.2, -0.99}) {
    SlipSamples samples = readGpSlip();
    samples.slips.assign(samples.slips.size(), value);
    for (const char* inference : {"dense", "state_space"}) {
      GaussianProcessSlipModel model(parametersOf("paper_bias", inference));
      const SlipFit fit = model.fit(samples);
      EXPECT_EQ(fit.status, SlipFitStatus::kConstantSlip);
      EXPECT_EQ(fit.evaluations, 0);
      EXPECT_TRUE(std::isfinite(fit.log_marginal_likelihood));
      expectFinite(model, lastTime());
      const SlipPrediction prediction = model.predict(ahead(lastTime(), 60.0));
      EXPECT_LT((prediction.mean.array() - value).abs().maxCoeff(), 1e-3);
      EXPECT_LT(prediction.stddev.maxCoeff(), 0.01);
    }
  }
}

TEST(SlipModel, WhatIsNoSampleIsLeftOut) {
  SlipSamples dirty = readGpSlip();
  dirty.slips[10] = 1.0;
  dirty.slips[20] = -1.0;
  dirty.slips[30] = std::numeric_limits<double>::quiet_NaN();
  dirty.times_s[40] = dirty.times_s[39];
  SlipSamples clean = readGpSlip();
  for (const std::ptrdiff_t index : {40, 30, 20, 10}) {
    clean.times_s.erase(clean.times_s.begin() + index);
    clean.slips.erase(clean.slips.begin() + index);
  }
  GaussianProcessSlipModel model(parametersOf("paper"));
  GaussianProcessSlipModel reference(parametersOf("paper"));
  const SlipFit fit = model.fit(dirty);
  EXPECT_EQ(fit.status, SlipFitStatus::kConverged);
  EXPECT_EQ(fit.left_out, 4);
  EXPECT_EQ(fit.samples, 146);
  reference.fit(clean);
  expectSamePredictions(model, reference, lastTime(), 0.0);
}

TEST(SlipModel, AWindowWithGapsIsFitted) {
  SlipSamples samples = readGpSlip();
  for (std::size_t i = 60; i < samples.times_s.size(); ++i) {
    samples.times_s[i] += 7.0;  // a stop
  }
  for (const char* inference : {"dense", "state_space"}) {
    GaussianProcessSlipModel model(parametersOf("paper", inference));
    const SlipFit fit = model.fit(samples);
    EXPECT_EQ(fit.status, SlipFitStatus::kConverged);
    EXPECT_NEAR(fit.hyperparameters[1].second, 1.0, 0.5);
    expectFinite(model, lastTime() + 7.0);
  }
}

TEST(SlipModel, WhiteSlipIsNotMistakenForASmoothOne) {
  SlipSamples samples = readGpSlip();
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(0.0, 0.05);
  for (double& slip : samples.slips) {
    slip = normal(generator);
  }
  GaussianProcessSlipModel model(parametersOf("ou"));
  const SlipFit fit = model.fit(samples);
  EXPECT_TRUE(isAccepted(fit.status));
  EXPECT_NEAR(fit.hyperparameters.back().second, 0.0025, 0.0005);
  EXPECT_LT(model.predict(ahead(lastTime(), 60.0)).stddev.maxCoeff(), 0.03);
}

/// A dense regression that stops working when told to.
class FailingProcess : public DenseGaussianProcess {
 public:
  FailingProcess() : DenseGaussianProcess(makeKernel(latentModelByName("paper"))) {}

  double negativeLogLikelihood(const Eigen::VectorXd& theta, Eigen::VectorXd* gradient) override {
    if (likelihood_fails || failing_likelihoods > 0) {
      --failing_likelihoods;
      throw std::runtime_error("not positive definite");
    }
    return DenseGaussianProcess::negativeLogLikelihood(theta, gradient);
  }
  double condition(const Eigen::VectorXd& theta) override {
    if (failing_conditionings > 0) {
      --failing_conditionings;
      throw std::runtime_error("not positive definite");
    }
    const bool fails = std::exchange(likelihood_fails, false);
    const double value = DenseGaussianProcess::condition(theta);
    likelihood_fails = fails;
    return value;
  }

  bool likelihood_fails = false;
  int failing_likelihoods = 0;
  int failing_conditionings = 0;
};

SlipSamples secondWindow() {
  SlipSamples samples = readGpSlip();
  for (double& slip : samples.slips) {
    slip *= 1.3;
  }
  return samples;
}

TEST(SlipModel, AFailingOptimizerKeepsTheLastGoodHyperparameters) {
  auto process = std::make_unique<FailingProcess>();
  FailingProcess& control = *process;
  GaussianProcessSlipModel model(parametersOf("paper"), std::move(process));
  const SlipFit good = model.fit(readGpSlip());
  ASSERT_EQ(good.status, SlipFitStatus::kConverged);
  const Eigen::VectorXd soon = ahead(lastTime(), 0.5);
  const Eigen::VectorXd mean_before = model.predict(soon).mean;
  control.likelihood_fails = true;
  const SlipFit kept = model.fit(secondWindow());
  EXPECT_EQ(kept.status, SlipFitStatus::kKeptPrevious);
  EXPECT_EQ(kept.hyperparameters, good.hyperparameters);
  EXPECT_TRUE(model.predict(soon).mean.isApprox(1.3 * mean_before, 1e-9));  // of the new samples
}

TEST(SlipModel, UnsuitablePreviousHyperparametersGiveWayToAColdFit) {
  auto process = std::make_unique<FailingProcess>();
  FailingProcess& control = *process;
  GaussianProcessSlipModel model(parametersOf("paper"), std::move(process));
  model.fit(readGpSlip());
  control.failing_likelihoods = 2;  // at the previous hyperparameters, and once more from the first start
  EXPECT_EQ(model.fit(secondWindow()).status, SlipFitStatus::kConverged);
}

TEST(SlipModel, AFailingOptimizerWithoutAPastTakesThePriorsMeans) {
  auto process = std::make_unique<FailingProcess>();
  process->likelihood_fails = true;
  GaussianProcessSlipModel model(parametersOf("paper"), std::move(process));
  const SlipFit fit = model.fit(readGpSlip());
  EXPECT_EQ(fit.status, SlipFitStatus::kDefaults);
  expectFinite(model, lastTime());
}

TEST(SlipModel, ACovarianceThatIsNotPositiveDefiniteRefusesTheWindow) {
  auto process = std::make_unique<FailingProcess>();
  FailingProcess& control = *process;
  GaussianProcessSlipModel model(parametersOf("paper"), std::move(process));
  GaussianProcessSlipModel reference(parametersOf("paper"));
  control.failing_conditionings = 1;
  EXPECT_EQ(model.fit(readGpSlip()).status, SlipFitStatus::kNotPositiveDefinite);
  EXPECT_FALSE(model.isReady());
  model.fit(readGpSlip());
  const SlipFit before = model.fit(readGpSlip());
  control.failing_conditionings = 1;
  const SlipFit refused = model.fit(secondWindow());
  EXPECT_EQ(refused.status, SlipFitStatus::kNotPositiveDefinite);
  EXPECT_EQ(refused.hyperparameters, before.hyperparameters);
  reference.fit(readGpSlip());
  expectSamePredictions(model, reference, lastTime(), 1e-3);
}

TEST(SlipModel, AnEmptyBudgetIsSaid) {
  SlipModelParameters parameters = parametersOf("paper");
  parameters.max_evaluations = 1;
  GaussianProcessSlipModel model(parameters);
  const SlipFit fit = model.fit(readGpSlip());
  EXPECT_EQ(fit.status, SlipFitStatus::kNotConverged);
  EXPECT_EQ(fit.evaluations, 5) << "one from each of three starts, and two where the best of them is refined";
  expectFinite(model, lastTime());
}

TEST(SlipModel, PredictionBeforeTheOriginIsRefused) {
  GaussianProcessSlipModel model(parametersOf("paper"));
  const SlipFit fit = model.fit(readGpSlip());
  EXPECT_THROW(model.predict(Eigen::VectorXd::Constant(1, fit.origin_s - 0.1)), std::invalid_argument);
  EXPECT_THROW(model.predict(Eigen::VectorXd::Constant(1, std::nan(""))), std::invalid_argument);
}

TEST(SlipModel, ParametersCheckThemselves) {
  EXPECT_NO_THROW(checkParameters(SlipModelParameters()));
  for (const std::string& name : latentModelNames()) {
    EXPECT_NO_THROW(checkParameters(parametersOf(name))) << name;
  }
  EXPECT_THROW(checkParameters(parametersOf("papper")), std::invalid_argument);
  EXPECT_THROW(GaussianProcessSlipModel(parametersOf("papper")), std::invalid_argument);
  EXPECT_THROW(GaussianProcessSlipModel(parametersOf("paper", "exact")), std::invalid_argument);
}

TEST(SlipModel, EveryStatusHasItsOwnName) {
  std::vector<std::string> names;
  for (int status = 0; status <= static_cast<int>(SlipFitStatus::kNotPositiveDefinite); ++status) {
    names.push_back(toString(static_cast<SlipFitStatus>(status)));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace slipnav
