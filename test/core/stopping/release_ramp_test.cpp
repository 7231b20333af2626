#include "core/stopping/release_ramp.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

constexpr Nanoseconds kBegin = 100 * kSecond;
constexpr double kAcceleration_mps2 = 0.5;
constexpr double kAngularAcceleration_radps2 = 0.25;

VelocityCommand command(double forward_mps, double turn_radps) {
  VelocityCommand c;
  c.linear_mps = Vector3(forward_mps, 0.0, 0.0);
  c.angular_radps = Vector3(0.0, 0.0, turn_radps);
  return c;
}

class ReleaseRampTest : public ::testing::Test {
 protected:
  VelocityCommand after(double time_s, const VelocityCommand& in) {
    return ramp_.shorten(in, kBegin + fromSeconds(time_s), kAcceleration_mps2, kAngularAcceleration_radps2);
  }

  ReleaseRamp ramp_;
};

TEST_F(ReleaseRampTest, PassesEverythingBeforeItBegins) {
  EXPECT_EQ(after(0.1, command(2.0, 1.0)).linear_mps.x(), 2.0);
}

TEST_F(ReleaseRampTest, RisesNoFasterThanTheVehicleMayAccelerate) {
  ramp_.begin(kBegin);
  EXPECT_NEAR(after(0.2, command(-1.0, 0.1)).linear_mps.x(), -0.1, 1e-12);
  EXPECT_NEAR(after(1.0, command(-1.0, 0.1)).linear_mps.x(), -0.5, 1e-12);
  EXPECT_EQ(after(2.1, command(-1.0, 0.1)).linear_mps.x(), -1.0);
}

TEST_F(ReleaseRampTest, RisesNoFasterThanTheVehicleMayTurn) {
  ramp_.begin(kBegin);
  const VelocityCommand out = after(0.2, command(0.1, 1.0));
  EXPECT_NEAR(out.angular_radps.z(), 0.05, 1e-12);
  EXPECT_NEAR(out.linear_mps.x(), 0.005, 1e-12) << "the curvature stays";
}

TEST_F(ReleaseRampTest, EndsWhenTheOperatorCommandsZero) {
  ramp_.begin(kBegin);
  EXPECT_TRUE(after(0.2, command(0.0, 0.0)).isZero());
  EXPECT_EQ(after(0.3, command(1.0, 0.0)).linear_mps.x(), 1.0);
}

}  // namespace
}  // namespace slipnav::test
