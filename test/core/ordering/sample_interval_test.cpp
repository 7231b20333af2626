#include "slipnav/core/ordering/sample_interval.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

SampleInterval regular(int intervals, Nanoseconds interval_ms) {
  SampleInterval interval(0.5);
  interval.restart(1000 * kMillisecond);
  for (int i = 1; i <= intervals; ++i) {
    interval.add((1000 + i * interval_ms) * kMillisecond);
  }
  return interval;
}

bool isHole(const SampleInterval& interval, Nanoseconds length_ms) {
  return interval.isHole(interval.newest(), interval.newest() + length_ms * kMillisecond);
}

TEST(SampleInterval, TrustsNothingUntilItKnowsTheUsualInterval) {
  EXPECT_TRUE(isHole(regular(3, 100), 100));
  EXPECT_FALSE(isHole(regular(4, 100), 100));
}

TEST(SampleInterval, HalfAnIntervalMoreIsAHole) {
  const SampleInterval interval = regular(20, 100);
  EXPECT_FALSE(isHole(interval, 149));
  EXPECT_TRUE(isHole(interval, 151));
}

TEST(SampleInterval, FollowsASensorThatChangesItsRate) {
  SampleInterval interval = regular(20, 100);
  EXPECT_TRUE(isHole(interval, 200));
  for (int i = 0; i < 20; ++i) {
    interval.add(interval.newest() + 200 * kMillisecond);
  }
  EXPECT_FALSE(isHole(interval, 200));
}

TEST(SampleInterval, LearnsNothingFromAnOutage) {
  SampleInterval interval = regular(4, 100);
  interval.add(interval.newest() + 30'000 * kMillisecond);
  EXPECT_TRUE(isHole(interval, 151));
}

TEST(SampleInterval, ARestartForgets) {
  SampleInterval interval = regular(20, 100);
  interval.restart(5000 * kMillisecond);
  EXPECT_EQ(interval.newest(), 5000 * kMillisecond);
  EXPECT_TRUE(isHole(interval, 100));
}

}  // namespace
TEST(SampleInterval, NoneIsDueSoonAfterTheLast) {
  EXPECT_EQ(regular(3, 100).quietUntil(), regular(3, 100).newest());
  const SampleInterval interval = regular(20, 100);
  EXPECT_EQ(interval.quietUntil(), interval.newest() + 90 * kMillisecond);
  EXPECT_EQ(interval.due(interval.newest() + 50 * kMillisecond), interval.quietUntil());
  EXPECT_EQ(interval.due(interval.newest() + 97 * kMillisecond), interval.newest() + 97 * kMillisecond);
}

TEST(SampleInterval, OneThatComesEarlyIsBelievedAtOnceAndForgottenSlowly) {
  SampleInterval interval = regular(20, 100);
  interval.add(interval.newest() + 50 * kMillisecond);
  EXPECT_EQ(interval.quietUntil(), interval.newest() + 45 * kMillisecond);
  interval.add(interval.newest() + 100 * kMillisecond);
  EXPECT_LT(interval.quietUntil(), interval.newest() + 50 * kMillisecond);
  for (int i = 0; i < 100; ++i) {
    interval.add(interval.newest() + 100 * kMillisecond);
  }
  EXPECT_GT(interval.quietUntil(), interval.newest() + 89 * kMillisecond);
}

}  // namespace slipnav
