#include "core/sensors/wheel_decoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slipnav {
namespace {

using Names = std::vector<std::string>;
using Values = std::vector<double>;

std::vector<WheelParams> twoWheels() { return {{"left", 0.1, 0.0, 0.3, 1.0}, {"right", 0.1, 0.0, -0.3, -1.0}}; }

constexpr double kMaxSpeed_mps = 5.0;

class WheelDecoderTest : public ::testing::Test {
 protected:
  std::optional<WheelSample> decode(Nanoseconds stamp, const Names& names, const Values& position,
                                    const Values& velocity) {
    return decoder_.decode({stamp, names, position, velocity});
  }

  WheelDecoder decoder_{twoWheels(), kMaxSpeed_mps};
};

TEST_F(WheelDecoderTest, TakesVelocitiesByNameWithTheConfiguredSign) {
  const auto sample = decode(5, {"arm", "right", "left"}, {}, {9.0, -2.0, 3.0});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp, 5);
  EXPECT_EQ(sample->count, 2U);
  EXPECT_EQ(sample->rate_radps[0], 3.0);
  EXPECT_EQ(sample->rate_radps[1], 2.0);
  EXPECT_EQ(decoder_.problem(), "");
}

TEST_F(WheelDecoderTest, FollowsJointsThatChangePlaces) {
  decode(1, {"left", "right"}, {}, {1.0, -2.0});
  const auto sample = decode(2, {"right", "left"}, {}, {-2.0, 1.0});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->rate_radps[0], 1.0);
  EXPECT_EQ(sample->rate_radps[1], 2.0);
}

TEST_F(WheelDecoderTest, TakesNamelessArraysInTheOrderOfTheConfiguration) {
  const auto sample = decode(1, {}, {}, {1.0, -2.0, 7.0});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->rate_radps[0], 1.0);
  EXPECT_EQ(sample->rate_radps[1], 2.0);
}

TEST(WheelDecoder, TakesWheelsWithoutConfiguredNamesInOrder) {
  std::vector<WheelParams> wheels = twoWheels();
  wheels[0].name = wheels[1].name = "";
  WheelDecoder decoder(wheels, kMaxSpeed_mps);
  const Names names = {"a", "b", "c"};
  const Values rates = {1.0, -2.0, 7.0};
  const auto sample = decoder.decode({1, names, {}, rates});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->rate_radps[0], 1.0);
  EXPECT_EQ(sample->rate_radps[1], 2.0);
  const Names too_few = {"a"};
  const Values one = {1.0};
  EXPECT_FALSE(decoder.decode({2, too_few, {}, one}));
  EXPECT_EQ(decoder.problem(), "has 1 values of velocity for 2 joints");
}

TEST_F(WheelDecoderTest, DifferencesPositionsWhereThereAreNoVelocities) {
  EXPECT_FALSE(decode(kSecond, {"left", "right"}, {1.0, 1.0}, {}));
  EXPECT_EQ(decoder_.problem(), "");
  const auto sample = decode(kSecond + kSecond / 10, {"left", "right"}, {1.5, 0.9}, {});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 5.0, 1e-12);
  EXPECT_NEAR(sample->rate_radps[1], 1.0, 1e-12);
}

TEST_F(WheelDecoderTest, AnEncoderThatOverflowsCostsOneSample) {
  decode(kSecond, {"left", "right"}, {99.5, 1.0}, {});
  EXPECT_FALSE(decode(kSecond + kSecond / 10, {"left", "right"}, {-100.0, 1.0}, {}));
  EXPECT_EQ(decoder_.problem(), "says that 'left' has jumped");
  const auto sample = decode(kSecond + kSecond / 5, {"left", "right"}, {-99.5, 1.0}, {});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 5.0, 1e-9);
}

TEST_F(WheelDecoderTest, ImpossibleVelocitiesAreRefused) {
  EXPECT_TRUE(decode(1, {"left", "right"}, {}, {49.0, -49.0}));
  EXPECT_FALSE(decode(1, {"left", "right"}, {}, {1.0, -51.0}));
  EXPECT_EQ(decoder_.problem(), "says that 'right' turns too fast");
}

TEST_F(WheelDecoderTest, RepeatedPositionsGiveNoRate) {
  decode(kSecond, {"left", "right"}, {1.0, 1.0}, {});
  EXPECT_FALSE(decode(kSecond, {"left", "right"}, {1.0, 1.0}, {}));
}

TEST_F(WheelDecoderTest, NamesWhatIsWrong) {
  EXPECT_FALSE(decode(1, {"left", "rihgt"}, {}, {1.0, 1.0}));
  EXPECT_EQ(decoder_.problem(), "has no joint 'right', but 'left', 'rihgt'");
  EXPECT_FALSE(decode(1, {"left", "right"}, {}, {1.0}));
  EXPECT_EQ(decoder_.problem(), "has 1 values of velocity for 2 joints");
  EXPECT_FALSE(decode(1, {}, {}, {1.0}));
  EXPECT_EQ(decoder_.problem(), "has 1 values of velocity for 2 joints");
  EXPECT_FALSE(decode(1, {"left", "right"}, {}, {1.0, std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_EQ(decoder_.problem(), "has a velocity of joint 'right' that is not a finite number");
  EXPECT_FALSE(decode(1, {"left", "right"}, {}, {}));
  EXPECT_EQ(decoder_.problem(), "has 0 values of position for 2 joints");
}

TEST_F(WheelDecoderTest, AMessageThatCannotBeUsedLeavesItAsItWas) {
  decode(kSecond, {"left", "right"}, {1.0, 1.0}, {});
  decode(2 * kSecond, {"left", "right"}, {std::numeric_limits<double>::infinity(), 1.0}, {});
  decode(2 * kSecond, {"left"}, {1.0}, {});
  const auto sample = decode(3 * kSecond, {"left", "right"}, {4.0, 1.0}, {});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 1.5, 1e-12);  // since the last good one, two seconds before
}

/// An encoder whose position wraps at ±π, turning at 7 rad/s, read five times a second.
TEST_F(WheelDecoderTest, UnwrapsPositionsThatStayWithinOneTurn) {
  for (const double offset_rad : {0.0, kPi}) {  // -π to π, and 0 to 2π
    WheelDecoder decoder(twoWheels(), kMaxSpeed_mps);
    for (int i = 0; i < 40; ++i) {
      const double angle_rad = std::remainder(1.4 * i - offset_rad, 2.0 * kPi) + offset_rad;
      const Names names = {"left", "right"};
      const Values position = {angle_rad, 0.0};
      const auto sample = decoder.decode({fromSeconds(0.2 * i), names, position, {}});
      EXPECT_EQ(decoder.problem(), "");
      if (i > 0) {
        ASSERT_TRUE(sample);
        EXPECT_NEAR(sample->rate_radps[0], 7.0, 1e-9);
      }
    }
  }
}

/// Positions that go on and on may move by more than half a turn between messages.
TEST_F(WheelDecoderTest, LeavesPositionsAloneThatGoBeyondOneTurn) {
  const Names names = {"left", "right"};
  decode(fromSeconds(1.0), names, {10.0, 0.0}, {});
  const auto sample = decode(fromSeconds(1.2), names, {15.0, 0.0}, {});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 25.0, 1e-9);
}

TEST_F(WheelDecoderTest, UsesPositionsWhereVelocitiesAreAlwaysZero) {
  const Names names = {"left", "right"};
  int remarks = 0;
  std::optional<WheelSample> sample;
  for (int i = 0; i < 20; ++i) {
    sample = decode(fromSeconds(0.1 * i), names, {0.1 * i, -0.1 * i}, {0.0, 0.0});
    remarks += decoder_.remark().empty() ? 0 : 1;
  }
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 1.0, 1e-9);
  EXPECT_NEAR(sample->rate_radps[1], 1.0, 1e-9);
  EXPECT_EQ(remarks, 1);
}

/// One that turns is enough, whichever.
TEST_F(WheelDecoderTest, UsesPositionsWhereOneWheelHasTurned) {
  const Names names = {"left", "right"};
  for (const double left : {0.0, 1.0}) {
    WheelDecoder decoder(twoWheels(), kMaxSpeed_mps);
    std::optional<WheelSample> sample;
    for (int i = 0; i < 40; ++i) {
      const Values position = {0.1 * i * left, -0.1 * i * (1.0 - left)};
      const Values velocity = {0.0, 0.0};
      sample = decoder.decode({fromSeconds(0.1 * i), names, position, velocity});
    }
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->rate_radps[0], left, 1e-9);
    EXPECT_NEAR(sample->rate_radps[1], 1.0 - left, 1e-9);
  }
}

TEST_F(WheelDecoderTest, KeepsVelocitiesThatAreZeroAtRestOnly) {
  const Names names = {"left", "right"};
  decode(fromSeconds(0.1), names, {0.0, 0.0}, {1.0, -1.0});
  std::optional<WheelSample> sample;
  for (int i = 2; i < 20; ++i) {
    sample = decode(fromSeconds(0.1 * i), names, {0.1 * i, -0.1 * i}, {0.0, 0.0});
  }
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->rate_radps[0], 0.0);
}

TEST_F(WheelDecoderTest, UsesPositionsWhereVelocitiesAreNoNumbers) {
  const Names names = {"left", "right"};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(decode(fromSeconds(1.0), names, {0.0, 0.0}, {nan, nan}));
  EXPECT_NE(decoder_.remark(), "");
  const auto sample = decode(fromSeconds(1.1), names, {0.1, -0.1}, {nan, nan});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 1.0, 1e-9);
  EXPECT_EQ(decoder_.remark(), "");
}

TEST_F(WheelDecoderTest, OneVelocityThatIsNoNumberCostsNoneOfTheOthers) {
  const Names names = {"left", "right"};
  decode(fromSeconds(1.0), names, {0.0, 0.0}, {2.0, -2.0});
  const auto sample = decode(fromSeconds(1.1), names, {0.1, -0.1}, {2.0, std::numeric_limits<double>::quiet_NaN()});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->rate_radps[0], 1.0, 1e-9) << "by the positions";
  EXPECT_EQ(decode(fromSeconds(1.2), names, {0.2, -0.2}, {2.0, -2.0})->rate_radps[0], 2.0);
}

TEST_F(WheelDecoderTest, AClockThatBeginsAgainBeginsAnew) {
  const Names names = {"left", "right"};
  for (int i = 0; i < 20; ++i) {
    decode(fromSeconds(10.0 + 0.1 * i), names, {0.1 * i, -0.1 * i}, {0.0, 0.0});
  }
  const auto velocities = decode(fromSeconds(1.0), names, {7.0, 7.0}, {0.0, 0.0});
  ASSERT_TRUE(velocities) << "they are believed again";
  EXPECT_EQ(velocities->rate_radps[0], 0.0);
  const auto positions = decode(fromSeconds(1.1), names, {7.1, 6.9}, {});
  ASSERT_TRUE(positions);
  EXPECT_NEAR(positions->rate_radps[0], 1.0, 1e-9);
}

TEST_F(WheelDecoderTest, IsQuietAboutTheJointsOfOthers) {
  EXPECT_FALSE(decode(1, {"shoulder", "elbow"}, {}, {1.0, 2.0}));
  EXPECT_EQ(decoder_.problem(), "");
  EXPECT_TRUE(decode(2, {"left", "right"}, {}, {1.0, 2.0}));
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(decode(3 + i, {"shoulder", "elbow"}, {}, {1.0, 2.0}));
    EXPECT_EQ(decoder_.problem(), "");
  }
  EXPECT_TRUE(decode(200, {"left", "right"}, {}, {1.0, 2.0}));
}

TEST_F(WheelDecoderTest, SaysThatNoMessageHasTheWheels) {
  std::string problem;
  for (int i = 0; i < 30; ++i) {
    decode(1 + i, {"shoulder", "elbow"}, {}, {1.0, 2.0});
    problem = decoder_.problem();
  }
  EXPECT_EQ(problem, "has no joint 'left', but 'shoulder', 'elbow'");
}

}  // namespace
}  // namespace slipnav
