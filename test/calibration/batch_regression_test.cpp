#include "calibration/batch_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/base/statistics.h"
#include "simulation/random.h"

namespace slipnav {
namespace {

constexpr std::size_t kRowsPerBatch = 20;
const Eigen::Vector2d kTruth(2.0, -0.5);

struct Noise {
  double of_batch = 0.0;  ///< 1σ of the error that all rows of a batch share
  double of_row = 0.0;
};

RegressionProblem makeProblem(std::uint64_t seed, std::size_t batches, const Noise& noise) {
  sim::RandomStream stream(seed, "regression");
  RegressionProblem problem(2);
  for (std::size_t b = 0; b < batches; ++b) {
    const double shared = noise.of_batch * stream.normal();
    for (std::size_t i = 0; i < kRowsPerBatch; ++i) {
      const Eigen::Vector2d row(1.0, std::sin(0.7 * static_cast<double>(b * kRowsPerBatch + i)));
      problem.add(row, row.dot(kTruth) + shared + noise.of_row * stream.normal(), b);
    }
  }
  return problem;
}

TEST(BatchRegressionTest, exactDataGiveExactParameters) {
  const RegressionResult result = regress(makeProblem(1, 5, {}));
  EXPECT_NEAR((result.estimate - kTruth).norm(), 0.0, 1e-12);
  EXPECT_NEAR(result.covariance.norm(), 0.0, 1e-20);
}

TEST(BatchRegressionTest, equalBatchesAllCount) {
  EXPECT_NEAR(regress(makeProblem(1, 12, {0.1, 0.1})).effective_batches(0), 12.0, 1.0);
}

/// Were the rows taken for independent, the deviation would be four times too small.
TEST(BatchRegressionTest, correlatedErrorsInflateTheUncertainty) {
  std::vector<double> z;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const RegressionResult result = regress(makeProblem(seed, 15, {0.2, 0.05}));
    z.push_back((result.estimate(0) - kTruth(0)) / std::sqrt(result.covariance(0, 0)));
  }
  EXPECT_GT(rootMeanSquare(z), 0.7);
  EXPECT_LT(rootMeanSquare(z), 1.05);
}

TEST(BatchRegressionTest, threeSigmaHoldAlsoWithFewBatches) {
  int outside = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const RegressionResult result = regress(makeProblem(seed, 5, {0.2, 0.05}));
    outside += std::abs(result.estimate(0) - kTruth(0)) > 3.0 * std::sqrt(result.covariance(0, 0)) ? 1 : 0;
  }
  EXPECT_LE(outside, 12);  // 2.7 expected; with the plain deviation of five batches there are about 60
}

TEST(BatchRegressionTest, outliersHardlyMatter) {
  RegressionProblem problem = makeProblem(3, 20, {0.0, 0.05});
  for (std::size_t b = 0; b < 20; ++b) {
    problem.add(Eigen::Vector2d(1.0, 0.0), 12.0, b);  // one row of twenty is off by ten
  }
  EXPECT_NEAR(regress(problem).estimate(0), kTruth(0), 0.02);
}

TEST(BatchRegressionTest, parametersThatCannotBeToldApartAreRefused) {
  RegressionProblem problem(2);
  for (std::size_t i = 0; i < 10; ++i) {
    problem.add(Eigen::Vector2d(1.0, 2.0), 1.0, i);
  }
  EXPECT_THROW(regress(problem), std::invalid_argument);
  EXPECT_THROW(regress(RegressionProblem(1)), std::invalid_argument);
}

TEST(BatchRegressionTest, rowsOfTheWrongLengthAreRefused) {
  RegressionProblem problem(2);
  EXPECT_THROW(problem.add(Eigen::Vector3d::Ones(), 1.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
