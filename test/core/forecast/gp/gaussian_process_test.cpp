#include "core/forecast/gp/dense_gaussian_process.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "core/forecast/gp/latent_model.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

// Agreement asked of two independent implementations.
constexpr double kTolerance = 1e-8;

Eigen::VectorXd goldenSlips() {
  const std::vector<double> slips = readGpSlip().slips;
  return Eigen::Map<const Eigen::VectorXd>(slips.data(), static_cast<Eigen::Index>(slips.size()));
}

double largestDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

DenseGaussianProcess paperProcess() { return DenseGaussianProcess(makeKernel(latentModelByName("paper"))); }

TEST(DenseGaussianProcess, EqualsTheOracle) {
  const Eigen::VectorXd slips = goldenSlips();
  const std::vector<GpOracleCase> cases = readGpOracle();
  ASSERT_GE(cases.size(), 9U);
  for (const GpOracleCase& oracle : cases) {
    DenseGaussianProcess process(makeKernel(latentModelByName(oracle.model)));
    process.setSamples(evenTimes(slips.size(), oracle.scalar("unit")), slips);
    const Eigen::VectorXd theta = oracle.vector("log_parameter");
    Eigen::VectorXd gradient;
    const double likelihood = -process.negativeLogLikelihood(theta, &gradient);
    EXPECT_NEAR(likelihood, oracle.scalar("log_marginal_likelihood"), kTolerance) << oracle.name;
    EXPECT_LT(largestDifference(-gradient, oracle.vector("gradient")), kTolerance) << oracle.name;

    EXPECT_EQ(process.condition(theta), -likelihood) << oracle.name;
    const LatentPrediction prediction = process.predict(oracle.vector("time"));
    EXPECT_LT(largestDifference(prediction.mean, oracle.vector("mean")), kTolerance) << oracle.name;
    EXPECT_LT(largestDifference(prediction.variance, oracle.vector("variance")), kTolerance) << oracle.name;
    const Eigen::MatrixXd covariance = process.predictCovariance(oracle.vector("time"));
    EXPECT_LT(largestDifference(covariance.col(0), oracle.vector("covariance")), kTolerance) << oracle.name;
    EXPECT_LT(largestDifference(covariance.diagonal(), prediction.variance), 1e-14) << oracle.name;
    EXPECT_EQ(process.relativeJitter(), 0.0) << oracle.name;
  }
}

TEST(DenseGaussianProcess, GradientEqualsCentralDifferencesOnUnevenTimes) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.02, 0.3);
  Eigen::VectorXd times(70);
  Eigen::VectorXd values(70);
  double time = 0.0;
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    time += uniform(generator);
    times(i) = time;
    values(i) = uniform(generator) - 0.16;
  }
  for (const std::string& name : latentModelNames()) {
    DenseGaussianProcess process(makeKernel(latentModelByName(name)));
    process.setSamples(times, values);
    const Eigen::VectorXd theta = Eigen::VectorXd::LinSpaced(process.parameterCount(), -2.0, -4.0);
    Eigen::VectorXd gradient;
    process.negativeLogLikelihood(theta, &gradient);
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(theta.size(), p);
      const double numeric = (process.negativeLogLikelihood(theta + step, nullptr) -
                              process.negativeLogLikelihood(theta - step, nullptr)) /
                             2e-5;
      EXPECT_NEAR(gradient(p), numeric, 1e-6) << name << " " << p;
    }
  }
}

TEST(DenseGaussianProcess, PosteriorCovarianceIsPositiveSemidefiniteAndBelowThePrior) {
  const Eigen::VectorXd slips = goldenSlips();
  DenseGaussianProcess process = paperProcess();
  process.setSamples(evenTimes(slips.size(), 0.1), slips);
  process.condition(Eigen::Vector3d(std::log(3.6e-4), 0.0, std::log(0.0028)));
  const Eigen::VectorXd ahead = Eigen::VectorXd::LinSpaced(50, 14.0, 18.0);
  const Eigen::MatrixXd covariance = process.predictCovariance(ahead);
  EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-14);
  EXPECT_TRUE((covariance.diagonal().array() < 3.6e-4 * ahead.array()).all());
  EXPECT_LT(covariance(0, 0), 0.3 * 3.6e-4 * ahead(0));
}

TEST(DenseGaussianProcess, FarAheadIsThePrior) {
  const Eigen::VectorXd slips = goldenSlips();
  DenseGaussianProcess process = paperProcess();
  process.setSamples(evenTimes(slips.size(), 0.1), slips);
  process.condition(Eigen::Vector3d(std::log(3.6e-4), 0.0, std::log(0.0028)));
  const LatentPrediction prediction = process.predict(Eigen::VectorXd::Constant(1, 75.0));
  EXPECT_EQ(prediction.mean(0), 0.0);
  EXPECT_NEAR(prediction.variance(0), 3.6e-4 * 75.0, 1e-15);
}

TEST(DenseGaussianProcess, PredictionsTogetherAreThoseOneByOne) {
  // Where only the slow component is left, the many share one solution; alone each has its own.
  const Eigen::VectorXd slips = goldenSlips();
  const Eigen::VectorXd ahead = Eigen::VectorXd::LinSpaced(600, 20.0, 80.0);
  for (const char* name : {"rbf_slow", "ou_slow", "paper_bias", "matern_bias"}) {
    DenseGaussianProcess process(makeKernel(latentModelByName(name)));
    process.setSamples(evenTimes(slips.size(), 0.1), slips);
    Eigen::VectorXd theta = Eigen::VectorXd::Constant(process.parameterCount(), std::log(0.003));
    theta(1) = std::log(0.9);
    if (theta.size() == 5) {
      theta(3) = std::log(20.0);
    }
    process.condition(theta);
    const LatentPrediction together = process.predict(ahead);
    for (Eigen::Index i = 0; i < ahead.size(); ++i) {
      const LatentPrediction alone = process.predict(ahead.segment(i, 1));
      EXPECT_NEAR(together.mean(i), alone.mean(0), 1e-15) << name << " " << ahead(i);
      EXPECT_NEAR(together.variance(i), alone.variance(0), 1e-9 * alone.variance(0)) << name << " " << ahead(i);
    }
  }
}

TEST(DenseGaussianProcess, GradientAtTheTruthAveragesToZeroOverItsOwnSamples) {
  // The score has zero mean: what a fit to many windows of one process relies on.
  const Eigen::VectorXd theta = Eigen::Vector3d(std::log(4e-4), 0.0, std::log(0.003));
  const Eigen::VectorXd times = evenTimes(150, 0.1);
  const KernelPtr kernel = makeKernel(latentModelByName("paper"));
  kernel->setLogParameters(theta.head(2));
  Eigen::MatrixXd covariance(150, 150);
  for (Eigen::Index j = 0; j < 150; ++j) {
    kernel->column(times, times(j), covariance.col(j));
  }
  covariance.diagonal().array() += 0.003;
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  DenseGaussianProcess process(kernel);
  constexpr int kDraws = 200;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(3);
  Eigen::VectorXd sum_of_squares = Eigen::VectorXd::Zero(3);
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::VectorXd white = Eigen::VectorXd::NullaryExpr(150, [&] { return normal(generator); });
    process.setSamples(times, root * white);
    Eigen::VectorXd gradient;
    process.negativeLogLikelihood(theta, &gradient);
    sum += gradient;
    sum_of_squares += gradient.cwiseAbs2();
  }
  const Eigen::VectorXd standard_error = (sum_of_squares / kDraws).cwiseSqrt() / std::sqrt(double{kDraws});
  EXPECT_LT((sum / kDraws).cwiseQuotient(standard_error).cwiseAbs().maxCoeff(), 3.5);
}

TEST(DenseGaussianProcess, JitterSavesASingularCovarianceAndIsReported) {
  const Eigen::VectorXd times = evenTimes(100, 0.1);
  DenseGaussianProcess process(makeKernel(latentModelByName("rbf")));
  process.setSamples(times, times.array().sin());
  const double likelihood = process.condition(Eigen::Vector3d(0.0, std::log(5.0), -80.0));
  EXPECT_GT(process.relativeJitter(), 0.0);
  EXPECT_TRUE(std::isfinite(likelihood));
  EXPECT_TRUE(process.predict(evenTimes(3, 4.0)).mean.allFinite());
}

TEST(DenseGaussianProcess, HopelessCovarianceThrows) {
  DenseGaussianProcess process = paperProcess();
  process.setSamples(evenTimes(20, 0.1), Eigen::VectorXd::Zero(20));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(process.negativeLogLikelihood(Eigen::Vector3d(nan, 0.0, 0.0), nullptr), std::runtime_error);
}

TEST(DenseGaussianProcess, BadSamplesAreRefused) {
  DenseGaussianProcess process = paperProcess();
  const Eigen::VectorXd values = Eigen::VectorXd::Zero(3);
  EXPECT_THROW(process.setSamples(Eigen::Vector3d(0.1, 0.1, 0.2), values), std::invalid_argument);
  EXPECT_THROW(process.setSamples(Eigen::Vector3d(0.3, 0.1, 0.2), values), std::invalid_argument);
  EXPECT_THROW(process.setSamples(Eigen::Vector3d(-0.1, 0.1, 0.2), values), std::invalid_argument);
  EXPECT_THROW(process.setSamples(Eigen::Vector2d(0.1, 0.2), values), std::invalid_argument);
  EXPECT_THROW(process.setSamples(Eigen::VectorXd(), Eigen::VectorXd()), std::invalid_argument);
  EXPECT_THROW(process.predict(values), std::logic_error);
}

}  // namespace
}  // namespace slipnav
