#include "core/forecast/slip_correlation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/forecast/gaussian_process_slip_model.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

constexpr double kInterval_s = 0.5;

Eigen::MatrixXd gaussMarkov(double bias_stddev, double stddev, double time_constant_s, Eigen::Index count) {
  Eigen::MatrixXd covariance(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double lag = kInterval_s * std::abs(static_cast<double>(i - j));
      covariance(i, j) = bias_stddev * bias_stddev + stddev * stddev * std::exp(-lag / time_constant_s);
    }
  }
  return covariance;
}

TEST(SlipCorrelation, RecoversAGaussMarkovProcess) {
  const GaussMarkovSlip summary = summarizeCorrelation(gaussMarkov(0.05, 0.08, 2.0, 121), kInterval_s);
  EXPECT_NEAR(summary.bias_stddev, 0.05, 1e-4);
  EXPECT_NEAR(summary.stddev, 0.08, 1e-4);
  EXPECT_NEAR(summary.time_constant_s, 2.0, 0.03);
}

TEST(SlipCorrelation, PureCases) {
  const GaussMarkovSlip bias = summarizeCorrelation(gaussMarkov(0.05, 0.0, 1.0, 61), kInterval_s);
  EXPECT_NEAR(bias.bias_stddev, 0.05, 1e-12);
  EXPECT_NEAR(bias.stddev, 0.0, 1e-6);
  const GaussMarkovSlip process = summarizeCorrelation(gaussMarkov(0.0, 0.08, 1.0, 121), kInterval_s);
  EXPECT_LT(process.bias_stddev, 1e-4);
  EXPECT_NEAR(process.time_constant_s, 1.0, 0.03);
  const GaussMarkovSlip nothing = summarizeCorrelation(Eigen::MatrixXd::Zero(11, 11), kInterval_s);
  EXPECT_EQ(nothing.bias_stddev, 0.0);
  EXPECT_EQ(nothing.stddev, 0.0);
  EXPECT_EQ(nothing.time_constant_s, 0.0);
}

TEST(SlipCorrelation, KeepsTheVarianceOfAccumulatedSlip) {
  // What the position error follows: the variance of the sum over the horizon.
  for (const char* name : {"ou_bias", "matern_bias", "rbf_slow"}) {
    SlipModelParameters parameters;
    parameters.model = name;
    GaussianProcessSlipModel model(parameters);
    model.fit(readGpSlip());
    const double start_s = readGpSlip().times_s.back();
    const Eigen::MatrixXd covariance =
        model.predictCovariance(Eigen::VectorXd::LinSpaced(121, start_s, start_s + 60.0));
    const GaussMarkovSlip summary = summarizeCorrelation(model, start_s, 60.0);
    const Eigen::MatrixXd reduced =
        gaussMarkov(summary.bias_stddev, summary.stddev, summary.time_constant_s, covariance.rows());
    EXPECT_NEAR(std::sqrt(reduced.sum() / covariance.sum()), 1.0, 0.05) << name;
  }
}

TEST(SlipCorrelation, TimeConstantOfTheRbfIsItsIntegral) {
  SlipModelParameters parameters;
  parameters.model = "rbf";
  GaussianProcessSlipModel model(parameters);
  const SlipFit fit = model.fit(readGpSlip());
  const GaussMarkovSlip summary = summarizeCorrelation(model, readGpSlip().times_s.back() + 10.0, 60.0);
  EXPECT_NEAR(summary.time_constant_s / fit.hyperparameters[1].second, std::sqrt(0.5 * 3.14159265), 0.02);
  EXPECT_NEAR(summary.stddev, std::sqrt(fit.hyperparameters[0].second), 1e-6);
}

TEST(SlipCorrelation, RefusesWhatHasNoLags) {
  EXPECT_THROW(summarizeCorrelation(Eigen::MatrixXd::Identity(2, 2), 0.5), std::invalid_argument);
  EXPECT_THROW(summarizeCorrelation(Eigen::MatrixXd::Ones(5, 4), 0.5), std::invalid_argument);
  EXPECT_THROW(summarizeCorrelation(Eigen::MatrixXd::Identity(5, 5), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
