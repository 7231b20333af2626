#include "slipnav/core/ekf/adaptation/imu_doubt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/square.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

constexpr double kDefault = 1.6;
const Vector3 kAside = Vector3::UnitY();

TEST(ImuDoubt, BeginsWithTheFactorItIsGiven) {
  EXPECT_NEAR(ImuDoubt(2.0).excess(), 3.0, 1e-12);
  EXPECT_EQ(ImuDoubt(1.0).excess(), 0.0);
}

TEST(ImuDoubt, GoesWhereInnovationsAreWhite) {
  ImuDoubt doubt(5.0);
  sim::RandomStream random(1, "innovations");
  double sum = 0.0;
  constexpr int kSamples = 2000;
  for (int i = 0; i < kSamples; ++i) {
    doubt.compare(kSideways, random.normal(), kAside);
    sum += i > 200 ? doubt.excess() : 0.0;
  }
  EXPECT_LT(sum / kSamples, 2.0);
}

TEST(ImuDoubt, GrowsWhereTheyAgree) {
  ImuDoubt doubt(kDefault);
  sim::RandomStream random(1, "innovations");
  for (int i = 0; i < 30; ++i) {
    doubt.compare(kOffGround, 1.5 + random.normal(), Vector3::UnitZ());
  }
  EXPECT_GT(doubt.excess(), 100.0);
}

/// Ninety times the data sheet: beyond that a contradiction is about the state.
TEST(ImuDoubt, HasALimit) {
  ImuDoubt doubt(kDefault);
  for (int i = 0; i < 1000; ++i) {
    doubt.compare(kSideways, 5.0, kAside);
  }
  EXPECT_DOUBLE_EQ(doubt.excess(), std::expm1(9.0));
}

/// A velocity that is wrong in the navigation frame changes sign in a rover that has turned round.
TEST(ImuDoubt, ComparesInTheNavigationFrame) {
  ImuDoubt turning(kDefault);
  ImuDoubt swaying(kDefault);
  for (int i = 0; i < 30; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    turning.compare(kSideways, 1.5 * side, side * kAside);
    swaying.compare(kSideways, 1.5 * side, kAside);
  }
  EXPECT_GT(turning.excess(), 100.0);
  EXPECT_EQ(swaying.excess(), 0.0);
}

TEST(ImuDoubt, ADataSheetThatIsExactIsNotDoubted) {
  ImuDoubt doubt(1.0);
  for (int i = 0; i < 30; ++i) {
    doubt.compare(kSideways, 5.0, kAside);
  }
  EXPECT_EQ(doubt.excess(), 0.0);
}

TEST(SuccessiveDifference, HasTheVarianceOfNoiseWhateverTheStateHasWrong) {
  SuccessiveDifference difference;
  sim::RandomStream random(1, "innovations");
  EXPECT_LT(difference.squared(7.0, kAside), 0.0) << "there is none before";
  double sum = 0.0;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    sum += difference.squared(7.0 + 0.3 * random.normal(), kAside);
  }
  EXPECT_NEAR(sum / kSamples, square(0.3), 0.01);
}

TEST(SuccessiveDifference, NeedsTheSameDirection) {
  SuccessiveDifference difference;
  difference.squared(1.0, kAside);
  EXPECT_LT(difference.squared(1.0, Vector3::UnitX()), 0.0);
  EXPECT_NEAR(difference.squared(-1.0, -Vector3::UnitX()), 0.0, 1e-12) << "the same velocity, from the other side";
}

/// Each innovation moves the logarithm by 0.3 times its product with the one before, less 0.3, of at most 2 either way.
TEST(ImuDoubt, MovesByTheProductOfSuccessiveInnovations) {
  ImuDoubt doubt(2.0);
  double theta = 2.0 * std::log(2.0);
  double before = 0.0;
  for (const double innovation : {1.0, 1.5, -0.5, 1.0, 2.0, 5.0, 5.0, -4.0}) {
    doubt.compare(kSideways, innovation, kAside);
    theta += 0.3 * (std::max(-2.0, std::min(innovation * before, 2.0)) - 0.3);
    before = innovation;
    EXPECT_NEAR(doubt.excess(), std::expm1(theta), 1e-12) << innovation;
  }
  doubt.compare(kOffGround, 5.0, kAside);
  EXPECT_NEAR(doubt.excess(), std::expm1(theta - 0.09), 1e-12) << "the first off the ground has none before it";
}

TEST(SuccessiveDifference, ComparesWhatIsNearlyAlongTheSameDirection) {
  for (const double cosine : {0.79, 0.81, -0.81}) {
    SuccessiveDifference difference;
    difference.squared(2.0, Vector3::UnitX());
    const Vector3 turned(cosine, std::sqrt(1.0 - square(cosine)), 0.0);
    const double expected = std::abs(cosine) < 0.8 ? -1.0 : 0.5 * square(1.0 - 2.0 * cosine);
    EXPECT_NEAR(difference.squared(1.0, turned), expected, 1e-12) << cosine;
  }
}

}  // namespace
}  // namespace slipnav::test
