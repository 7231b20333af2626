#include "slipnav/core/ordering/usual_interval.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

TEST(UsualInterval, FirstIntervalDoesNotMatter) {
  UsualInterval usual;
  EXPECT_EQ(usual.value(), 0.0);
  usual.add(0.012);
  for (int i = 0; i < 3; ++i) {
    usual.add(0.02);
  }
  EXPECT_DOUBLE_EQ(usual.value(), 0.02);
  EXPECT_FALSE(usual.isKnown());
}

TEST(UsualInterval, SeesThroughBurstsOfAnySize) {
  constexpr double kAtOnce_s = 0.0002;
  for (const int burst : {2, 3, 4, 5, 7, 10, 16, 20, 33, 50}) {
    UsualInterval usual;
    for (int i = 0; i < 40 * burst + 200; ++i) {
      usual.add(i % burst == 0 ? burst * 0.005 - (burst - 1) * kAtOnce_s : kAtOnce_s);
    }
    EXPECT_NEAR(usual.value(), 0.005, 1e-12) << burst;
  }
}

TEST(UsualInterval, ManySamplesAtOnceChangeNothing) {
  UsualInterval usual;
  for (int i = 0; i < 200; ++i) {
    usual.add(0.01);
  }
  usual.add(0.6);
  for (std::size_t i = 0; i < UsualInterval::kLongestBunch; ++i) {
    usual.add(0.0001);
  }
  EXPECT_NEAR(usual.value(), 0.01, 1e-12);
}

TEST(UsualInterval, SeesThroughLosses) {
  UsualInterval usual;
  for (int i = 0; i < 200; ++i) {
    usual.add(i % 50 == 0 ? 0.4 : 0.02);
  }
  EXPECT_NEAR(usual.value(), 0.02, 1e-12);
}

TEST(UsualInterval, RisesAndFallsWithAllOfThem) {
  UsualInterval usual;
  for (const double interval_s : {0.01, 0.02, 0.005}) {
    for (std::size_t i = 0; i < UsualInterval::kSpan + UsualInterval::kMeans; ++i) {
      usual.add(interval_s);
    }
    EXPECT_NEAR(usual.value(), interval_s, 1e-12);
  }
}

}  // namespace
}  // namespace slipnav
