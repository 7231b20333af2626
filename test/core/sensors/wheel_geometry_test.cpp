#include "slipnav/core/sensors/wheel_geometry.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav::test {
namespace {

WheelSample rolling(std::initializer_list<double> rates_radps) {
  WheelSample sample;
  sample.stamp = 42;
  sample.count = rates_radps.size();
  std::copy(rates_radps.begin(), rates_radps.end(), sample.rate_radps.begin());
  return sample;
}

TEST(WheelGeometry, PathfinderIsThatOfThePaper) {
  const std::vector<WheelParams> wheels = pathfinderWheels();
  ASSERT_EQ(wheels.size(), 4U);
  EXPECT_DOUBLE_EQ(wheels[0].radius_m, 0.11);
  EXPECT_DOUBLE_EQ(wheels[0].y_m - wheels[1].y_m, 0.685);
  EXPECT_DOUBLE_EQ(wheels[0].x_m - wheels[2].x_m, 0.555);
}

TEST(WheelGeometry, StraightDriveHasTheMeanSpeed) {
  const WheelGeometry geometry(pathfinderWheels(), 1.0);
  const PlanarMotion motion = geometry.motion(rolling({8.0, 8.0, 8.0, 8.0}));
  EXPECT_NEAR(motion.forward_mps, 0.88, 1e-12);
  EXPECT_TRUE(motion.has_yaw_rate);
  EXPECT_NEAR(motion.yaw_rate_radps, 0.0, 1e-12);
}

TEST(WheelGeometry, FasterLeftWheelsTurnRight) {
  const WheelGeometry geometry(pathfinderWheels(), 1.0);
  const PlanarMotion motion = geometry.motion(rolling({9.0, 7.0, 9.0, 7.0}));
  EXPECT_NEAR(motion.forward_mps, 0.88, 1e-12);
  EXPECT_NEAR(motion.yaw_rate_radps, 2.0 * 0.11 / 0.685, 1e-12);  // positive about down
  EXPECT_NEAR(WheelGeometry(pathfinderWheels(), 1.5).motion(rolling({9.0, 7.0, 9.0, 7.0})).yaw_rate_radps,
              2.0 * 0.11 / 0.685 / 1.5, 1e-12);
}

/// Wheels that do not stand symmetrically: a rigid turn is still found exactly.
TEST(WheelGeometry, FitsAnyPlacement) {
  std::vector<WheelParams> wheels = {{"a", 0.1, 0.3, 0.5, 1.0}, {"b", 0.2, 0.3, -0.2, 1.0}, {"c", 0.1, -0.4, 0.1, 1.0}};
  const WheelGeometry geometry(wheels, 1.0);
  const double u = 0.7;
  const double r = -0.3;  // about down
  const auto rate = [&](const WheelParams& w) { return (u + r * w.y_m) / w.radius_m; };
  const PlanarMotion motion = geometry.motion(rolling({rate(wheels[0]), rate(wheels[1]), rate(wheels[2])}));
  EXPECT_NEAR(motion.forward_mps, u, 1e-12);
  EXPECT_NEAR(motion.yaw_rate_radps, r, 1e-12);
}

TEST(WheelGeometry, ASingleTrackLineKnowsNoTurn) {
  const WheelGeometry geometry({{"front", 0.1, 0.3, 0.0, 1.0}, {"back", 0.1, -0.3, 0.0, 1.0}}, 1.0);
  const PlanarMotion motion = geometry.motion(rolling({5.0, 7.0}));
  EXPECT_FALSE(motion.has_yaw_rate);
  EXPECT_NEAR(motion.forward_mps, 0.6, 1e-12);
}

TEST(WheelGeometry, BadListsAreRefused) {
  EXPECT_THROW(WheelGeometry({}, 1.0), std::invalid_argument);
  EXPECT_THROW(WheelGeometry(std::vector<WheelParams>(kMaxWheels + 1), 1.0), std::invalid_argument);
  EXPECT_THROW(WheelGeometry(pathfinderWheels(), 0.0), std::invalid_argument);
  EXPECT_THROW(WheelGeometry(pathfinderWheels(), std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  std::vector<WheelParams> half = pathfinderWheels();
  half[1].sign = 0.5;
  EXPECT_THROW(WheelGeometry(half, 1.0), std::invalid_argument);
}

TEST(WheelMotion, KeepsEachWheelAndTheFastest) {
  const WheelMotion wheels = toWheelMotion(WheelGeometry(pathfinderWheels(), 1.0), rolling({1.0, -9.0, 2.0, 3.0}));
  EXPECT_EQ(wheels.stamp, 42);
  EXPECT_EQ(wheels.count, 4U);
  EXPECT_NEAR(wheels.circumferential_mps[1], -0.99, 1e-12);
  EXPECT_NEAR(wheels.largest_speed_mps, 0.99, 1e-12);
}

TEST(WheelMotion, ASpeedAloneHasNoWheels) {
  const WheelMotion wheels = toWheelMotion(SpeedSample{42, -0.5});
  EXPECT_EQ(wheels.stamp, 42);
  EXPECT_EQ(wheels.count, 0U);
  EXPECT_DOUBLE_EQ(wheels.motion.forward_mps, -0.5);
  EXPECT_DOUBLE_EQ(wheels.largest_speed_mps, 0.5);
  EXPECT_FALSE(wheels.motion.has_yaw_rate);
}

}  // namespace
}  // namespace slipnav::test
