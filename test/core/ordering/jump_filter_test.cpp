#include "core/ordering/jump_filter.h"

#include <gtest/gtest.h>

#include <vector>

#include "slipnav/core/base/sensors.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

class JumpFilterTest : public ::testing::Test {
 protected:
  /// What came through, in milliseconds.
  std::vector<Nanoseconds> push(const std::vector<Nanoseconds>& stamps_ms) {
    std::vector<Nanoseconds> passed;
    for (const Nanoseconds stamp_ms : stamps_ms) {
      ImuSample sample;
      sample.stamp = stamp_ms * kMillisecond;
      filter_.push(sample, [&passed](const ImuSample& s) { passed.push_back(s.stamp / kMillisecond); });
    }
    return passed;
  }

  using Stamps = std::vector<Nanoseconds>;
  JumpFilter<ImuSample> filter_;
};

TEST_F(JumpFilterTest, RegularAndReorderedSamplesPass) {
  const Stamps stamps = {5000, 5020, 5010, 5900, 5000, 6000};
  EXPECT_EQ(push(stamps), stamps);
  EXPECT_EQ(filter_.leftOut(), 0U);
}

TEST_F(JumpFilterTest, OneSampleFromThePastIsLeftOut) {
  EXPECT_EQ(push({5000, 5020, 1000, 5040}), (Stamps{5000, 5020, 5040}));
  EXPECT_EQ(filter_.leftOut(), 1U);
}

TEST_F(JumpFilterTest, OneSampleFromTheFutureIsLeftOut) {
  EXPECT_EQ(push({5000, 5020, 99000, 5040}), (Stamps{5000, 5020, 5040}));
  EXPECT_EQ(filter_.leftOut(), 1U);
}

TEST_F(JumpFilterTest, SamplesWithoutAStampAreLeftOut) {
  EXPECT_EQ(push({0, 5000, 0, 5020}), (Stamps{5000, 5020}));
  EXPECT_EQ(filter_.leftOut(), 2U);
}

TEST_F(JumpFilterTest, AClockThatGoesBackPassesWithItsSecondSample) {
  EXPECT_EQ(push({5000, 5020, 1000}), (Stamps{5000, 5020}));
  EXPECT_EQ(push({1020}), (Stamps{1000, 1020}));
  EXPECT_EQ(push({1040, 1060}), (Stamps{1040, 1060}));
  EXPECT_EQ(filter_.leftOut(), 0U);
}

TEST_F(JumpFilterTest, AGapPassesWithTheSecondSampleAfterIt) {
  EXPECT_EQ(push({5000, 5020, 9000}), (Stamps{5000, 5020}));
  EXPECT_EQ(push({9020, 9040}), (Stamps{9000, 9020, 9040}));
  EXPECT_EQ(filter_.leftOut(), 0U);
}

TEST_F(JumpFilterTest, ASlowSensorIsNotStarved) {
  EXPECT_EQ(push({5000, 7000, 9000, 11000, 13000}), (Stamps{5000, 7000, 9000, 11000, 13000}));
}

TEST_F(JumpFilterTest, TwoWrongStampsInARowAreNoJump) {
  EXPECT_EQ(push({50000, 50020, 90000, 10000, 50040}), (Stamps{50000, 50020, 50040}));
  EXPECT_EQ(filter_.leftOut(), 2U);
}

TEST_F(JumpFilterTest, AStrayPastSampleBeforeAGapDoesNotRestart) {
  EXPECT_EQ(push({50000, 50020, 10000, 55000, 55020}), (Stamps{50000, 50020, 55000, 55020}));
}

}  // namespace
}  // namespace slipnav
