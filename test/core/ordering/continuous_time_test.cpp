#include "core/ordering/continuous_time.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr Nanoseconds kPeriod = 20'000'000;
constexpr Nanoseconds kStart = 1'600'000'000 * kSecond;

/// A clock that was read a thousand times.
class ContinuousTimeTest : public ::testing::Test {
 protected:
  ContinuousTimeTest() {
    for (int i = 0; i < 1000; ++i) {
      EXPECT_EQ(time_.add(kStart + i * kPeriod), kStart + i * kPeriod);
    }
  }
  static constexpr Nanoseconds kEnd = kStart + 999 * kPeriod;
  ContinuousTime time_;
};

TEST_F(ContinuousTimeTest, GoesOnWhenTheClockIsSetBack) {
  const Nanoseconds back = 5 * kSecond;
  EXPECT_NEAR(toSeconds(time_.add(kEnd + kPeriod - back) - (kEnd + kPeriod)), 0.0, 2e-9);
  EXPECT_NEAR(toSeconds(time_.add(kEnd + 2 * kPeriod - back) - (kEnd + 2 * kPeriod)), 0.0, 2e-9);
  ASSERT_EQ(time_.steps().size(), 1U);
  EXPECT_NEAR(*time_.newestStep_s(), 5.0, 1e-8);
}

TEST_F(ContinuousTimeTest, IsTurnedBackIntoWhatTheClockSaid) {
  const Nanoseconds after = kEnd + kPeriod - 5 * kSecond;
  const Nanoseconds continuous = time_.add(after);
  EXPECT_EQ(time_.toClock(continuous), after);
  EXPECT_EQ(time_.toClock(continuous + kSecond), after + kSecond);
  EXPECT_EQ(time_.toClock(kEnd), kEnd);
  EXPECT_EQ(time_.toContinuous(after, 1), continuous);
  EXPECT_EQ(time_.toContinuous(kEnd, 0), kEnd);
}

TEST_F(ContinuousTimeTest, StepsAddUp) {
  time_.add(kEnd + kPeriod - 5 * kSecond);
  time_.add(kEnd + 2 * kPeriod - 8 * kSecond);
  ASSERT_EQ(time_.steps().size(), 2U);
  EXPECT_NEAR(*time_.newestStep_s(), 3.0, 1e-8);
  EXPECT_NEAR(toSeconds(time_.add(kEnd + 3 * kPeriod - 8 * kSecond) - kEnd - 3 * kPeriod), 0.0, 4e-9);
}

TEST_F(ContinuousTimeTest, AClockThatBeginsAgainIsFollowed) {
  time_.add(kEnd + kPeriod - 5 * kSecond);
  EXPECT_EQ(time_.add(kStart - 1000 * kSecond), kStart - 1000 * kSecond);
  EXPECT_TRUE(time_.steps().empty());
}

/// A recording that is played in a loop.
TEST_F(ContinuousTimeTest, AClockThatGoesBackToItsBeginningHasBegunAgain) {
  EXPECT_EQ(time_.add(kStart + kSecond), kStart + kSecond);
  EXPECT_TRUE(time_.steps().empty());
}

TEST(StepCount, CountsAsContinuousTimeDoes) {
  StepCount count;
  for (const Nanoseconds stamp : {80 * kSecond, 101 * kSecond, 96 * kSecond, 97 * kSecond}) {
    count.add(stamp);
  }
  EXPECT_EQ(count.steps(), 1U);
  count.add(10 * kSecond);
  EXPECT_EQ(count.steps(), 0U);
  EXPECT_EQ(count.all(), 2U);
  count.add(30 * kSecond);
  count.add(11 * kSecond);
  EXPECT_EQ(count.steps(), 0U);
  EXPECT_EQ(count.all(), 3U);
}

}  // namespace
}  // namespace slipnav
