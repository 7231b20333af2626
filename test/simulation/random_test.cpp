#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/correlated_process.h"
#include "simulation/random.h"

namespace slipnav::sim {
namespace {

TEST(SimRandomStream, RepeatsForTheSameSeedAndPurpose) {
  RandomStream a(7, "terrain");
  RandomStream b(7, "terrain");
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(a.normal(), b.normal());
  }
}

TEST(SimRandomStream, DiffersByPurposeAndBySeed) {
  RandomStream terrain(7, "terrain");
  RandomStream slip(7, "slip");
  RandomStream other_seed(8, "terrain");
  const double first = terrain.uniform();
  EXPECT_NE(first, slip.uniform());
  EXPECT_NE(first, other_seed.uniform());
}

TEST(SimRandomStream, NormalHasTheMomentsOfAStandardNormal) {
  RandomStream stream(1, "moments");
  const int count = 200000;
  double sum = 0.0;
  double sum2 = 0.0;
  double sum4 = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = stream.normal();
    sum += x;
    sum2 += x * x;
    sum4 += x * x * x * x;
  }
  // five standard errors each: 1/√n, √2/√n, √96/√n
  EXPECT_NEAR(sum / count, 0.0, 0.012);
  EXPECT_NEAR(sum2 / count, 1.0, 0.016);
  EXPECT_NEAR(sum4 / count, 3.0, 0.11);
}

TEST(SimRandomStream, NeighboringSeedsAreUncorrelated) {
  double product = 0.0;
  const int count = 20000;
  for (int seed = 0; seed < count; ++seed) {
    RandomStream a(static_cast<std::uint64_t>(seed), "x");
    RandomStream b(static_cast<std::uint64_t>(seed) + 1, "x");
    product += a.normal() * b.normal();
  }
  EXPECT_NEAR(product / count, 0.0, 0.035);  // five standard errors
}

TEST(SimCorrelatedProcess, DoesNotDependOnHowOftenItIsAsked) {
  CorrelatedProcess fine(3, "p", 1.0);
  CorrelatedProcess coarse(3, "p", 1.0);
  double last = 0.0;
  for (int i = 0; i <= 50000; ++i) {
    last = fine.at(i * 1e-3);
  }
  EXPECT_EQ(last, coarse.at(50000 * 1e-3));
}

TEST(SimCorrelatedProcess, HasUnitVarianceAndExponentialCorrelation) {
  const double correlation_m = 2.0;
  CorrelatedProcess process(5, "p", correlation_m);
  const double step_m = 0.5;
  std::vector<double> x;
  for (int i = 0; i < 200000; ++i) {
    x.push_back(process.at(i * step_m));
  }
  const auto covariance = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < x.size(); ++i) {
      sum += x[i] * x[i + lag];
    }
    return sum / static_cast<double>(x.size() - lag);
  };
  EXPECT_NEAR(covariance(0), 1.0, 0.04);
  EXPECT_NEAR(covariance(4), std::exp(-1.0), 0.04);
  EXPECT_NEAR(covariance(12), std::exp(-3.0), 0.04);
}

TEST(SimCorrelatedProcess, HasAContinuousSlope) {
  CorrelatedProcess process(9, "p", 1.0);
  const double h = 1e-4;
  double last_slope = (process.at(h) - process.at(0.0)) / h;
  for (int i = 1; i < 100000; ++i) {
    const double slope = (process.at((i + 1) * h) - process.at(i * h)) / h;
    // second derivative of a spline through normal values 1/6 m apart stays below a few hundred per m²
    ASSERT_LT(std::abs(slope - last_slope), 500.0 * h) << "at " << i * h << " m";
    last_slope = slope;
  }
}

}  // namespace
}  // namespace slipnav::sim
