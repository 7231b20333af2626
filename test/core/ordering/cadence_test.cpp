#include "slipnav/core/ordering/cadence.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

Cadence regular(int intervals, Nanoseconds interval_ms) {
  Cadence cadence(0.5);
  cadence.restart(1000 * kMillisecond);
  for (int i = 1; i <= intervals; ++i) {
    cadence.add((1000 + i * interval_ms) * kMillisecond);
  }
  return cadence;
}

bool isHole(const Cadence& cadence, Nanoseconds length_ms) {
  return cadence.isHole(cadence.newest(), cadence.newest() + length_ms * kMillisecond);
}

TEST(Cadence, TrustsNothingUntilItKnowsTheUsualInterval) {
  EXPECT_TRUE(isHole(regular(3, 100), 100));
  EXPECT_FALSE(isHole(regular(4, 100), 100));
}

TEST(Cadence, HalfAnIntervalMoreIsAHole) {
  const Cadence cadence = regular(20, 100);
  EXPECT_FALSE(isHole(cadence, 149));
  EXPECT_TRUE(isHole(cadence, 151));
}

TEST(Cadence, FollowsASensorThatChangesItsRate) {
  Cadence cadence = regular(20, 100);
  EXPECT_TRUE(isHole(cadence, 200));
  for (int i = 0; i < 20; ++i) {
    cadence.add(cadence.newest() + 200 * kMillisecond);
  }
  EXPECT_FALSE(isHole(cadence, 200));
}

TEST(Cadence, LearnsNothingFromAnOutage) {
  Cadence cadence = regular(4, 100);
  cadence.add(cadence.newest() + 30'000 * kMillisecond);
  EXPECT_TRUE(isHole(cadence, 151));
}

TEST(Cadence, ARestartForgets) {
  Cadence cadence = regular(20, 100);
  cadence.restart(5000 * kMillisecond);
  EXPECT_EQ(cadence.newest(), 5000 * kMillisecond);
  EXPECT_TRUE(isHole(cadence, 100));
}

}  // namespace
TEST(Cadence, NoneIsDueSoonAfterTheLast) {
  EXPECT_EQ(regular(3, 100).quietUntil(), regular(3, 100).newest());
  const Cadence cadence = regular(20, 100);
  EXPECT_EQ(cadence.quietUntil(), cadence.newest() + 90 * kMillisecond);
  EXPECT_EQ(cadence.due(cadence.newest() + 50 * kMillisecond), cadence.quietUntil());
  EXPECT_EQ(cadence.due(cadence.newest() + 97 * kMillisecond), cadence.newest() + 97 * kMillisecond);
}

TEST(Cadence, OneThatComesEarlyIsBelievedAtOnceAndForgottenSlowly) {
  Cadence cadence = regular(20, 100);
  cadence.add(cadence.newest() + 50 * kMillisecond);
  EXPECT_EQ(cadence.quietUntil(), cadence.newest() + 45 * kMillisecond);
  cadence.add(cadence.newest() + 100 * kMillisecond);
  EXPECT_LT(cadence.quietUntil(), cadence.newest() + 50 * kMillisecond);
  for (int i = 0; i < 100; ++i) {
    cadence.add(cadence.newest() + 100 * kMillisecond);
  }
  EXPECT_GT(cadence.quietUntil(), cadence.newest() + 89 * kMillisecond);
}

}  // namespace slipnav
