#include "ros/messages/legacy_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "slipnav/core/base/types.h"

namespace slipnav {
namespace {

const double kHalf = std::sqrt(0.5);

class LegacyMessagesTest : public ::testing::Test {
 protected:
  LegacyMessagesTest() {
    state_.header.stamp = ros::Time(12, 34);
    state_.header.frame_id = "map";
    state_.position.x = 1.0;
    state_.position.y = 2.0;
    state_.position.z = 3.0;
    state_.velocity.x = 0.1;
    state_.velocity.y = 0.2;
    state_.velocity.z = 0.3;
    state_.latitude_deg = 0.0;
    state_.longitude_deg = 90.0;
    state_.height_m = 10.0;
    state_.orientation.w = 1.0;
    slip_.ratio = {0.1, -0.4, std::numeric_limits<double>::quiet_NaN(), 0.2};
    slip_.wheel_speed_mps = {0.5, 0.6, 0.7, 0.9};
    slip_.forward_speed_mps = 0.65;
  }

  static void expectPoint(const geometry_msgs::PointStamped& message, const Vector3& expected) {
    EXPECT_NEAR(message.point.x, expected.x(), 1e-9);
    EXPECT_NEAR(message.point.y, expected.y(), 1e-9);
    EXPECT_NEAR(message.point.z, expected.z(), 1e-9);
    EXPECT_EQ(message.header.frame_id, "odom");
  }

  LegacyMessages messages_{FrameNames{}, Planet::byName("earth"), pathfinderWheels()};
  NavState state_;
  Slip slip_;
};

TEST_F(LegacyMessagesTest, Positions) {
  expectPoint(messages_.position(state_), {0.0, 0.5 * kPi, 10.0});
  expectPoint(messages_.llh(state_), {0.0, 90.0, 10.0});
  expectPoint(messages_.ecef(state_), {0.0, 6378147.0, 0.0});
  expectPoint(messages_.enu(state_), {1.0, 2.0, 3.0});
  EXPECT_EQ(messages_.enu(state_).header.stamp, state_.header.stamp);
}

TEST_F(LegacyMessagesTest, PlanetFixedCoordinatesAreRoundedOnlyOnce) {
  state_.latitude_deg = 39.482;
  state_.longitude_deg = -79.963;
  state_.height_m = 300.0;
  expectPoint(messages_.ecef(state_),
              {859169.79842317791, -4854261.2046229439, 4033952.0193236638});  // computed with 34 digits
}

TEST_F(LegacyMessagesTest, VelocityIsNorthEastDown) { expectPoint(messages_.velocity(state_), {0.2, 0.1, -0.3}); }

TEST_F(LegacyMessagesTest, AttitudeIsThatOfForwardRightDown) {
  expectPoint(messages_.attitude(state_), {0.0, 0.0, 0.5 * kPi});  // pointing east
  state_.orientation.w = state_.orientation.z = kHalf;             // a quarter turn to the left: north
  expectPoint(messages_.attitude(state_), {0.0, 0.0, 0.0});
  state_.orientation.w = std::cos(0.05);
  state_.orientation.z = 0.0;
  state_.orientation.y = std::sin(0.05);  // about the left axis: nose down
  expectPoint(messages_.attitude(state_), {0.0, -0.1, 0.5 * kPi});
  state_.orientation.y = 0.0;
  state_.orientation.x = std::sin(0.05);  // about the forward axis: right side down
  expectPoint(messages_.attitude(state_), {0.1, 0.0, 0.5 * kPi});
}

TEST_F(LegacyMessagesTest, OdometryHasTheAxesOfItsOwn) {
  const nav_msgs::Odometry message = messages_.odometry(state_);
  EXPECT_EQ(message.pose.pose.position.x, 2.0);
  EXPECT_EQ(message.pose.pose.position.y, -1.0);
  EXPECT_EQ(message.pose.pose.position.z, -3.0);
  EXPECT_NEAR(message.twist.twist.linear.x, 0.2, 1e-15);
  EXPECT_NEAR(message.twist.twist.linear.y, -0.1, 1e-15);
  EXPECT_NEAR(message.twist.twist.linear.z, 0.3, 1e-15);
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "imu_link");
  for (const double value : message.pose.covariance) {
    EXPECT_EQ(value, 0.0);
  }
}

TEST_F(LegacyMessagesTest, SlipIsThatOfTheWorstWheel) {
  expectPoint(*messages_.slip(slip_), {-0.4, 0.8, 0.65});
  slip_.ratio.assign(4, std::numeric_limits<double>::quiet_NaN());
  expectPoint(*messages_.slip(slip_), {0.0, 0.8, 0.65});
  slip_.wheel_speed_mps.clear();
  EXPECT_FALSE(messages_.slip(slip_).has_value());
}

}  // namespace
}  // namespace slipnav
