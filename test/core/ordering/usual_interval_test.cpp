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

TEST(UsualInterval, SeesThroughBursts) {
  UsualInterval usual;
  for (int i = 0; i < 200; ++i) {
    usual.add(i % 4 == 0 ? 0.0194 : 0.0002);
  }
  EXPECT_NEAR(usual.value(), 0.005, 1e-12);
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
