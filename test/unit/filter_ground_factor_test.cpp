#include "slipnav/filter/ground_factor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slipnav/sim/random.h"

namespace slipnav {
namespace {

/// Innovations of a ground whose standard deviations are `std` of those of the parameters, with a share of the expected
/// variance that has nothing to do with the ground.
double drive(GroundFactor& factor, double std, int samples, double other_variance = 0.0) {
  sim::RandomStream random(3, "ground");
  double nis_sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double innovation = std::sqrt(std * std + other_variance) * random.normal();
    const double nis = innovation * innovation / (factor.variance() + other_variance);
    nis_sum += nis;
    factor.learn(nis);
  }
  return nis_sum / samples;
}

TEST(GroundFactor, FindsTheSpreadOfBetterGround) {
  GroundFactor factor({});
  drive(factor, 0.3, 2000);
  EXPECT_NEAR(std::sqrt(factor.variance()), 0.3, 0.06);
  EXPECT_NEAR(drive(factor, 0.3, 4000), 0.95, 0.1);
}

TEST(GroundFactor, NeverLeavesItsBounds) {
  GroundFactorParams params;
  GroundFactor factor(params);
  drive(factor, 0.001, 5000);
  EXPECT_DOUBLE_EQ(factor.variance(), params.least_std * params.least_std);
  drive(factor, 20.0, 500);
  EXPECT_DOUBLE_EQ(factor.variance(), 1.0);
}

/// From a road onto sand, with samples at 10 Hz.
TEST(GroundFactor, GrowsAtOnceWhereTheGroundGetsWorse) {
  GroundFactor factor({});
  drive(factor, 0.1, 5000);
  ASSERT_LT(factor.variance(), 0.03);
  drive(factor, 1.0, 20);
  EXPECT_GT(std::sqrt(factor.variance()), 0.3) << "after two seconds";
  drive(factor, 1.0, 50);
  EXPECT_GT(std::sqrt(factor.variance()), 0.7) << "after seven seconds";
}

TEST(GroundFactor, CanBeSwitchedOff) {
  GroundFactorParams params;
  params.least_std = 1.0;
  GroundFactor factor(params);
  drive(factor, 0.1, 1000);
  EXPECT_DOUBLE_EQ(factor.variance(), 1.0);
}

}  // namespace
}  // namespace slipnav
