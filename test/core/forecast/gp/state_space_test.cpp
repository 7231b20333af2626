#include "core/forecast/gp/state_space_gaussian_process.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/forecast/gp/dense_gaussian_process.h"
#include "core/forecast/gp/markov_shape.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

constexpr double kExact = 1e-9;

// Uneven, with a gap of 3 s, so that no two transitions are the same.
Eigen::VectorXd gappyTimes(Eigen::Index count) {
  Eigen::VectorXd times(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    times(i) = 0.1 * k + 0.05 + 0.03 * std::sin(3.0 * k) + (i > count / 2 ? 3.0 : 0.0);
  }
  return times;
}

Eigen::VectorXd goldenSlips() {
  const std::vector<double> slips = readGpSlip().slips;
  return Eigen::Map<const Eigen::VectorXd>(slips.data(), static_cast<Eigen::Index>(slips.size()));
}

Eigen::VectorXd typicalParameters(const LatentModel& model) {
  std::vector<double> theta;
  for (const std::string& name : hyperparameterNames(model)) {
    const double value = name == "variance"              ? 6e-4
                         : name == "length_scale_s"      ? 0.9
                         : name == "slow_length_scale_s" ? 25.0
                         : name == "noise_variance"      ? 0.0028
                                                         : 0.0011;
    theta.push_back(std::log(value));
  }
  return Eigen::Map<const Eigen::VectorXd>(theta.data(), static_cast<Eigen::Index>(theta.size()));
}

bool hasRbf(const LatentModel& model) {
  for (const LatentComponent& component : model) {
    if (component.correlation == Correlation::kRbf) {
      return true;
    }
  }
  return false;
}

// All shapes, alone, as a product with the Brownian kernel, and in sums that need padding of the state.
std::vector<LatentModel> exactModels() {
  std::vector<LatentModel> models;
  for (const std::string& name : latentModelNames()) {
    if (!hasRbf(latentModelByName(name))) {
      models.push_back(latentModelByName(name));
    }
  }
  const LatentComponent bias{ComponentRole::kBias, Correlation::kConstant, false};
  for (const Correlation correlation :
       {Correlation::kMatern12, Correlation::kMatern32, Correlation::kMatern52, Correlation::kMatern72}) {
    models.push_back({{ComponentRole::kSlip, correlation, true}});
    models.push_back({{ComponentRole::kSlip, correlation, false}, bias});
  }
  return models;
}

void expectAgreement(const LatentModel& model, double tolerance, double likelihood_tolerance) {
  const Eigen::VectorXd slips = goldenSlips();
  const Eigen::VectorXd times = gappyTimes(slips.size());
  const Eigen::VectorXd theta = typicalParameters(model);
  DenseGaussianProcess dense(makeKernel(model));
  StateSpaceGaussianProcess markov(model);
  dense.setSamples(times, slips);
  markov.setSamples(times, slips);
  Eigen::VectorXd dense_gradient;
  Eigen::VectorXd markov_gradient;
  EXPECT_NEAR(markov.negativeLogLikelihood(theta, &markov_gradient),
              dense.negativeLogLikelihood(theta, &dense_gradient), likelihood_tolerance);
  EXPECT_LT((markov_gradient - dense_gradient).cwiseAbs().maxCoeff(), likelihood_tolerance);

  const double last = times(times.size() - 1);
  const Eigen::VectorXd ahead = Eigen::VectorXd::LinSpaced(40, last, last + 60.0);
  dense.condition(theta);
  markov.condition(theta);
  const LatentPrediction expected = dense.predict(ahead);
  const LatentPrediction prediction = markov.predict(ahead);
  EXPECT_LT((prediction.mean - expected.mean).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((prediction.variance - expected.variance).cwiseAbs().maxCoeff(), tolerance);
  const Eigen::MatrixXd covariance = markov.predictCovariance(ahead);
  EXPECT_LT((covariance - dense.predictCovariance(ahead)).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
}

TEST(StateSpaceGaussianProcess, EqualsTheDenseOneForMarkovModels) {
  const std::vector<LatentModel> models = exactModels();
  for (std::size_t i = 0; i < models.size(); ++i) {
    SCOPED_TRACE("model " + std::to_string(i));
    expectAgreement(models[i], kExact, kExact);
  }
}

TEST(StateSpaceGaussianProcess, ApproximatesTheRbf) {
  for (const char* name : {"paper", "rbf", "paper_bias"}) {
    SCOPED_TRACE(name);
    expectAgreement(latentModelByName(name), 2e-3, 0.15);
  }
}

TEST(StateSpaceGaussianProcess, RbfGradientIsThatOfItsOwnLikelihood) {
  const Eigen::VectorXd slips = goldenSlips();
  for (const char* name : {"paper", "paper_slow"}) {
    const LatentModel model = latentModelByName(name);
    StateSpaceGaussianProcess markov(model);
    markov.setSamples(gappyTimes(slips.size()), slips);
    const Eigen::VectorXd theta = typicalParameters(model);
    Eigen::VectorXd gradient;
    markov.negativeLogLikelihood(theta, &gradient);
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(theta.size(), p);
      const double numeric =
          (markov.negativeLogLikelihood(theta + step, nullptr) - markov.negativeLogLikelihood(theta - step, nullptr)) /
          2e-5;
      EXPECT_NEAR(gradient(p), numeric, 1e-6) << name << " " << p;
    }
  }
}

TEST(StateSpaceGaussianProcess, StaysExactOverThousandsOfSamplesAndAFarOrigin) {
  const LatentModel model = latentModelByName("brownian_matern");
  const Eigen::VectorXd times = evenTimes(1500, 0.1).array() + 1000.0;
  const Eigen::VectorXd values = 0.07 * (1.3 * times).array().sin() + 0.03 * (17.0 * times).array().cos();
  DenseGaussianProcess dense(makeKernel(model));
  StateSpaceGaussianProcess markov(model);
  dense.setSamples(times, values);
  markov.setSamples(times, values);
  const Eigen::VectorXd theta = Eigen::Vector3d(std::log(3e-6), 0.0, std::log(0.0028));
  Eigen::VectorXd dense_gradient;
  Eigen::VectorXd markov_gradient;
  const double expected = dense.negativeLogLikelihood(theta, &dense_gradient);
  EXPECT_NEAR(markov.negativeLogLikelihood(theta, &markov_gradient), expected, 1e-9 * std::abs(expected));
  EXPECT_LT((markov_gradient - dense_gradient).cwiseAbs().maxCoeff(), 1e-9 * dense_gradient.cwiseAbs().maxCoeff());
}

TEST(StateSpaceGaussianProcess, InformationIsThatOfTheDenseFormOnAverage) {
  // Over samples of the process itself: ½ tr(K⁻¹ ∂K/∂θ_p K⁻¹ ∂K/∂θ_q).
  constexpr Eigen::Index kSamples = 100;
  constexpr int kDraws = 100;
  const LatentModel model = latentModelByName("matern_bias");
  const Eigen::VectorXd theta = typicalParameters(model);
  const Eigen::VectorXd times = gappyTimes(kSamples);
  const KernelPtr kernel = makeKernel(model);
  kernel->setLogParameters(theta.head(theta.size() - 1));
  std::vector<Eigen::MatrixXd> by_parameter(4, Eigen::MatrixXd(kSamples, kSamples));
  Eigen::MatrixXd covariance(kSamples, kSamples);
  for (Eigen::Index j = 0; j < kSamples; ++j) {
    Eigen::MatrixXd derivatives(kSamples, 3);
    kernel->columnWithDerivatives(times, times(j), covariance.col(j), derivatives);
    for (std::size_t p = 0; p < 3; ++p) {
      by_parameter[p].col(j) = derivatives.col(static_cast<Eigen::Index>(p));
    }
  }
  by_parameter[3] = std::exp(theta(3)) * Eigen::MatrixXd::Identity(kSamples, kSamples);
  covariance += by_parameter[3];
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  const Eigen::MatrixXd root = cholesky.matrixL();
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  StateSpaceGaussianProcess markov(model);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(4, 4);
  for (int draw = 0; draw < kDraws; ++draw) {
    markov.setSamples(times, root * Eigen::VectorXd::NullaryExpr(kSamples, [&] { return normal(generator); }));
    information += markov.information(theta) / kDraws;
  }
  for (Eigen::Index p = 0; p < 4; ++p) {
    for (Eigen::Index q = 0; q < 4; ++q) {
      const auto of = [&](Eigen::Index i) { return cholesky.solve(by_parameter[static_cast<std::size_t>(i)]).eval(); };
      const auto expected = [&](Eigen::Index i, Eigen::Index j) { return 0.5 * (of(i) * of(j)).trace(); };
      EXPECT_NEAR(information(p, q), expected(p, q), 0.1 * std::sqrt(expected(p, p) * expected(q, q))) << p << " " << q;
    }
  }
}

TEST(StateSpaceGaussianProcess, RefusesWhatItCannotDo) {
  EXPECT_THROW(StateSpaceGaussianProcess({}), std::invalid_argument);
  const LatentComponent rbf{ComponentRole::kSlip, Correlation::kRbf, false};
  EXPECT_THROW(StateSpaceGaussianProcess({rbf, rbf}), std::invalid_argument);
  StateSpaceGaussianProcess markov(latentModelByName("ou"));
  markov.setSamples(evenTimes(20, 0.1), evenTimes(20, 0.01));
  EXPECT_THROW(markov.predict(evenTimes(1, 3.0)), std::logic_error);
  markov.condition(Eigen::Vector3d(-5.0, 0.0, -6.0));
  EXPECT_THROW(markov.predict(evenTimes(1, 1.99)), std::invalid_argument);
  EXPECT_THROW(markov.predictCovariance(evenTimes(1, 1.99)), std::invalid_argument);
}

TEST(MarkovShape, MatricesAreThoseOfItsStates) {
  for (const Correlation correlation : {Correlation::kConstant, Correlation::kRbf, Correlation::kMatern12,
                                        Correlation::kMatern32, Correlation::kMatern52, Correlation::kMatern72}) {
    const MarkovShape shape(correlation);
    const Eigen::Index n = shape.dimension();
    for (const Eigen::MatrixXd& matrix : {shape.drift(), shape.stationaryCovariance()}) {
      EXPECT_EQ(matrix.rows(), n);
      EXPECT_EQ(matrix.cols(), n);
    }
    EXPECT_NEAR(shape.correlation(0.0), 1.0, 1e-12);
  }
}

TEST(MarkovShape, CorrelationIsThatOfTheKernel) {
  struct Shape {
    Correlation correlation;
    KernelPtr kernel;
    double tolerance;
  };
  const std::vector<Shape> shapes = {
      {Correlation::kRbf, std::make_shared<RbfKernel>(1.0), 0.0043},
      {Correlation::kMatern12, std::make_shared<MaternKernel>(MaternOrder::kHalf, 1.0), 1e-12},
      {Correlation::kMatern32, std::make_shared<MaternKernel>(MaternOrder::kThreeHalves, 1.0), 1e-12},
      {Correlation::kMatern52, std::make_shared<MaternKernel>(MaternOrder::kFiveHalves, 1.0), 1e-12},
      {Correlation::kMatern72, std::make_shared<MaternKernel>(MaternOrder::kSevenHalves, 1.0), 1e-12}};
  const Eigen::VectorXd lags = Eigen::VectorXd::LinSpaced(200, 0.0, 8.0);
  for (const Shape& entry : shapes) {
    const MarkovShape shape(entry.correlation);
    Eigen::VectorXd expected(lags.size());
    entry.kernel->column(lags, 0.0, expected);
    for (Eigen::Index i = 0; i < lags.size(); ++i) {
      EXPECT_NEAR(shape.correlation(lags(i)), expected(i), entry.tolerance) << lags(i);
    }
    const Eigen::MatrixXd& covariance = shape.stationaryCovariance();
    EXPECT_GT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0);
  }
}

}  // namespace
}  // namespace slipnav
