#include "core/ordering/imu_sorter.h"

#include <gtest/gtest.h>

#include <vector>

namespace slipnav {
namespace {

constexpr Nanoseconds kPeriod = 20'000'000;
constexpr Nanoseconds kStart = 1'000'000'000'000;

class ImuSorterTest : public ::testing::Test {
 protected:
  /// Samples 0 to 9, by which the sorter learns their interval.
  ImuSorterTest() {
    for (int i = 0; i < 10; ++i) {
      push(i);
    }
    passed_.clear();
  }

  void push(int number) { pushAt(kStart + number * kPeriod); }
  void pushAt(Nanoseconds stamp) {
    ImuSample sample;
    sample.stamp = stamp;
    sorter_.push(sample, [this](const ImuSample& passed) {
      passed_.push_back(static_cast<int>((passed.stamp - kStart) / kPeriod));
    });
  }

  ImuSorter sorter_;
  std::vector<int> passed_;
};

using Numbers = std::vector<int>;

TEST_F(ImuSorterTest, SamplesInOrderPassAtOnce) {
  push(10);
  EXPECT_EQ(passed_, Numbers({10}));
  push(11);
  EXPECT_EQ(passed_, Numbers({10, 11}));
}

TEST_F(ImuSorterTest, OneThatWasOvertakenTakesItsPlace) {
  push(11);
  EXPECT_TRUE(passed_.empty());
  push(10);
  EXPECT_EQ(passed_, Numbers({10, 11}));
  EXPECT_EQ(sorter_.overtaken(), 1U);
  push(14);
  push(13);
  push(12);
  EXPECT_EQ(passed_, Numbers({10, 11, 12, 13, 14}));
}

TEST_F(ImuSorterTest, OneThatIsLostIsNotWaitedForLong) {
  push(11);
  push(12);
  EXPECT_TRUE(passed_.empty());
  push(13);
  EXPECT_EQ(passed_, Numbers({11, 12, 13}));
  push(14);
  EXPECT_EQ(passed_, Numbers({11, 12, 13, 14}));
}

TEST_F(ImuSorterTest, RepeatedAndLateSamplesAreForOthersToJudge) {
  push(9);
  push(5);
  EXPECT_EQ(passed_, Numbers({9, 5}));
  push(10);
  EXPECT_EQ(passed_.back(), 10);
}

TEST_F(ImuSorterTest, ASourceThatStartsAnewIsFollowed) {
  push(11);
  pushAt(kStart - 100 * kPeriod);
  EXPECT_EQ(passed_, Numbers({11, -100}));
  for (int i = -99; i < -90; ++i) {
    push(i);
  }
  EXPECT_EQ(passed_.back(), -91);
}

}  // namespace
}  // namespace slipnav
