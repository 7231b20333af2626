#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slipnav {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Conversions, StampsSurviveToTheNanosecond) {
  const Nanoseconds stamp = 1'600'000'000'123'456'789;
  EXPECT_EQ(toNanoseconds(toRosTime(stamp)), stamp);
}

TEST(Conversions, ImuSamplesTurnIntoBodyAxes) {
  sensor_msgs::Imu message;
  message.header.stamp = ros::Time(5, 7);
  message.linear_acceleration.x = 1.0;
  message.linear_acceleration.y = 2.0;
  message.linear_acceleration.z = 9.8;
  message.angular_velocity.z = 0.5;
  const ImuSample sample = toImuSample(message, ImuMount(MountParams{}));
  EXPECT_EQ(sample.stamp, 5'000'000'007);
  EXPECT_EQ(sample.f_ib_b, Vector3(1.0, -2.0, -9.8));
  EXPECT_EQ(sample.omega_ib_b, Vector3(0.0, 0.0, -0.5));
}

TEST(Conversions, FixesExchangeTheAxesOfTheirCovariance) {
  sensor_msgs::NavSatFix message;
  message.header.stamp = ros::Time(5, 0);
  message.latitude = 39.7;
  message.longitude = -79.9;
  message.altitude = 250.0;
  message.position_covariance = {1.0, 0.1, 0.2, 0.1, 4.0, 0.3, 0.2, 0.3, 9.0};  // east, north, up
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_KNOWN;
  const std::optional<GnssFix> fix = toGnssFix(message);
  ASSERT_TRUE(fix);
  EXPECT_EQ(fix->latitude_deg, 39.7);
  EXPECT_EQ(fix->height_m, 250.0);
  Matrix3 expected;
  expected << 4.0, 0.1, -0.3, 0.1, 1.0, -0.2, -0.3, -0.2, 9.0;
  EXPECT_EQ(fix->covariance_ned_m2, expected);

  sensor_msgs::NavSatFix back;
  fill(*fix, "gps", back);
  EXPECT_EQ(back.position_covariance, message.position_covariance);
}

TEST(Conversions, FixesThatAreNoneAreLeftOut) {
  sensor_msgs::NavSatFix message;
  message.latitude = 39.7;
  EXPECT_TRUE(toGnssFix(message));
  message.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  EXPECT_FALSE(toGnssFix(message));
  message.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
  message.altitude = kNan;
  EXPECT_FALSE(toGnssFix(message));
}

TEST(Conversions, FixesThatCannotBeAreNamed) {
  sensor_msgs::NavSatFix message;
  message.header.stamp = ros::Time(5, 0);
  EXPECT_FALSE(toGnssFix(message));
  EXPECT_EQ(complaintOf(message, "gps/fix"),
            "gps/fix is at latitude 0, longitude 0 with a good status: the receiver has no fix yet");
  message.latitude = 39.7e7;
  EXPECT_FALSE(toGnssFix(message));
  EXPECT_NE(complaintOf(message, "gps/fix").find("out of range"), std::string::npos);
  message.latitude = 39.7;
  EXPECT_EQ(complaintOf(message, "gps/fix"), "");
  message.header.stamp = ros::Time();
  EXPECT_NE(complaintOf(message, "gps/fix").find("are zero"), std::string::npos);
  message.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  EXPECT_EQ(complaintOf(message, "gps/fix"), "");
}

TEST(Conversions, AFixWithoutCovarianceIsAMatterOfMetres) {
  sensor_msgs::NavSatFix message;
  message.latitude = 39.7;
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  EXPECT_EQ(toGnssFix(message)->covariance_ned_m2.diagonal(), Vector3(25.0, 25.0, 100.0));
}

TEST(Conversions, VelocitiesAreTurnedToNorthEastDown) {
  geometry_msgs::TwistWithCovarianceStamped message;
  message.header.stamp = ros::Time(5, 7);
  message.twist.twist.linear.x = 1.0;  // east
  message.twist.twist.linear.y = 2.0;
  message.twist.twist.linear.z = 3.0;
  message.twist.covariance[0] = 0.1;
  message.twist.covariance[7] = 0.2;
  message.twist.covariance[14] = 0.3;
  const std::optional<VelocityFix> fix = toVelocityFix(message);
  ASSERT_TRUE(fix);
  EXPECT_EQ(fix->stamp, 5'000'000'007);
  EXPECT_EQ(fix->v_ea_n, Vector3(2.0, 1.0, -3.0));
  EXPECT_EQ(fix->variance_ned_m2ps2, Vector3(0.2, 0.1, 0.3));
  message.twist.covariance[7] = 0.0;
  EXPECT_LT((toVelocityFix(message)->variance_ned_m2ps2 - Vector3(0.01, 0.01, 0.04)).norm(), 1e-15);
  message.twist.twist.linear.z = kNan;
  EXPECT_FALSE(toVelocityFix(message));
}

TEST(Conversions, TruthWithoutAttitudeHasNone) {
  nav_msgs::Odometry message;
  message.pose.pose.position.x = 3.0;
  EXPECT_FALSE(toTruthSample(message)->q_flu_to_enu);
  message.pose.pose.orientation.w = 1.0;
  EXPECT_TRUE(toTruthSample(message)->q_flu_to_enu);
  message.pose.pose.position.x = kNan;
  EXPECT_FALSE(toTruthSample(message));
}

class EstimateConversions : public ::testing::Test {
 protected:
  EstimateConversions() {
    estimate_.nav.stamp = 10'000'000'000;
    estimate_.nav.position = frame_.origin();
    estimate_.wheels.stamp = estimate_.nav.stamp;
  }

  NavState message() const {
    NavState result;
    fill(estimate_, P_, frame_, FrameNames{}, 0.5, result);
    return result;
  }

  Planet planet_ = Planet::byName("earth");
  LocalFrame frame_{planet_, Geodetic{0.7, -1.4, 250.0}};
  Estimate estimate_;
  ErrorCovariance P_ = ErrorCovariance::Zero();
};

TEST_F(EstimateConversions, ARoverThatFacesNorthPointsAlongTheMapsYAxis) {
  const NavState state = message();
  EXPECT_NEAR(state.orientation.w, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(state.orientation.z, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(state.position.x, 0.0, 1e-6);
}

TEST_F(EstimateConversions, VelocityAndBiasesTurnToTheUsersAxes) {
  estimate_.nav.v_eb_n = {1.0, 2.0, 3.0};
  estimate_.nav.gyro_bias_b = {0.1, 0.2, 0.3};
  const NavState state = message();
  EXPECT_NEAR(state.velocity.x, 2.0, 1e-9);
  EXPECT_NEAR(state.velocity.y, 1.0, 1e-9);
  EXPECT_NEAR(state.velocity.z, -3.0, 1e-9);
  EXPECT_EQ(state.gyro_bias.x, 0.1);
  EXPECT_EQ(state.gyro_bias.y, -0.2);
  EXPECT_EQ(state.gyro_bias.z, -0.3);
}

TEST_F(EstimateConversions, CovarianceTurnsWithItsBlocks) {
  P_(kPosition, kPosition) = 4.0;       // north
  P_(kPosition, kAccelBias + 1) = 0.5;  // north with lateral bias, right
  P_(kAccelBias + 1, kPosition) = 0.5;
  const NavState state = message();
  const auto at = [&state](std::size_t row, std::size_t column) { return state.covariance[15 * row + column]; };
  EXPECT_NEAR(at(7, 7), 4.0, 1e-9);
  EXPECT_NEAR(at(6, 6), 0.0, 1e-9);
  EXPECT_NEAR(at(7, 10), -0.5, 1e-9);
  EXPECT_NEAR(at(10, 7), -0.5, 1e-9);
}

TEST_F(EstimateConversions, StatusTellsRestAndMissingWheels) {
  EXPECT_EQ(message().status, NavState::STATUS_MOVING);
  estimate_.stationary = true;
  EXPECT_EQ(message().status, NavState::STATUS_STATIONARY);
  estimate_.wheels.stamp -= 600'000'000;
  EXPECT_EQ(message().status, NavState::STATUS_INERTIAL);
}

TEST_F(EstimateConversions, ATruePoseBecomesTheStateOfTheImuAndBack) {
  Output pose;
  pose.stamp = 5;
  pose.position_enu_m = {10.0, 20.0, 1.0};
  pose.q_flu_to_enu = Quaternion(0.8, 0.0, 0.1, 0.5).normalized();
  pose.velocity_flu_mps = {0.8, 0.1, 0.0};
  nav_msgs::Odometry message;
  fill(pose, FrameNames{}, message);
  const Vector3 imu_position_b(0.3, 0.2, -0.1);
  estimate_.nav = toNavigationState(message, frame_, imu_position_b);
  estimate_.omega_ib_b = estimate_.nav.q_b_to_n.conjugate() * planet_.omega_ie_n(estimate_.nav.position.latitude_rad);
  const Output back = OutputMaker(planet_, frame_.origin(), -imu_position_b, 0.0).make(estimate_, P_);
  EXPECT_LT((back.position_enu_m - pose.position_enu_m).norm(), 1e-6);
  EXPECT_LT(back.q_flu_to_enu.angularDistance(pose.q_flu_to_enu), 1e-9);
  EXPECT_LT((back.velocity_flu_mps - pose.velocity_flu_mps).norm(), 1e-9);
}

}  // namespace
}  // namespace slipnav
