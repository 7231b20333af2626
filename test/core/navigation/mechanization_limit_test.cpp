#include "core/navigation/mechanization_limit.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr double kMaxWait_s = 0.5;
/// How far to mechanize while nothing is known of the next wheel sample.
constexpr Nanoseconds kWindow = 1'500'000'000;

class MechanizationLimitTest : public ::testing::Test {
 protected:
  MechanizationLimitTest() { ahead_.restart(100 * kSecond); }

  MechanizationLimit ahead_{kMaxWait_s};
};

TEST_F(MechanizationLimitTest, RunsForAWhileWithoutWheels) {
  EXPECT_EQ(ahead_.runUntil(), 100 * kSecond + kWindow);
  ahead_.processed(105 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 105 * kSecond + kWindow);
}

TEST_F(MechanizationLimitTest, EndsAtTheNextWheelSample) {
  ahead_.addWheels(102 * kSecond);
  ahead_.addWheels(101 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 101 * kSecond);
  ahead_.processed(101 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 102 * kSecond) << "that sample is behind";
  ahead_.processed(103 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 103 * kSecond + kWindow);
}

TEST_F(MechanizationLimitTest, StepsThatTheFilterHasNotReachedCountFromTheFirst) {
  ahead_.addStep(101 * kSecond);
  ahead_.addStep(102 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 101 * kSecond + kWindow);
  ahead_.processed(101 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 102 * kSecond + kWindow);
  ahead_.forgetSteps();
  EXPECT_EQ(ahead_.runUntil(), 101 * kSecond + kWindow);
}

TEST_F(MechanizationLimitTest, AStepThatWasThereIsNotAddedAgain) {
  ahead_.addStep(102 * kSecond);
  ahead_.addStep(102 * kSecond);
  ahead_.addStep(101 * kSecond);
  ahead_.processed(101 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 102 * kSecond + kWindow);
  ahead_.processed(102 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 102 * kSecond + kWindow);
  ahead_.addStep(102 * kSecond);
  ahead_.processed(103 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 103 * kSecond + kWindow);
}

TEST_F(MechanizationLimitTest, IsStalledOnceTheLimitIsReachedAndThereIsALaterOne) {
  EXPECT_TRUE(ahead_.isStalled()) << "none was told";
  ahead_.told(ahead_.runUntil());
  EXPECT_FALSE(ahead_.isStalled());
  ahead_.addStep(101 * kSecond);
  EXPECT_FALSE(ahead_.isStalled()) << "the limit is farther than the steps";
  ahead_.addStep(100 * kSecond + kWindow);
  EXPECT_TRUE(ahead_.isStalled());
  ahead_.told(ahead_.runUntil());
  EXPECT_FALSE(ahead_.isStalled());
}

TEST_F(MechanizationLimitTest, ARestartForgetsEverything) {
  ahead_.addWheels(101 * kSecond);
  ahead_.addStep(102 * kSecond);
  ahead_.told(102 * kSecond);
  ahead_.restart(50 * kSecond);
  EXPECT_EQ(ahead_.runUntil(), 50 * kSecond + kWindow);
  EXPECT_TRUE(ahead_.isStalled());
}

}  // namespace
}  // namespace slipnav
