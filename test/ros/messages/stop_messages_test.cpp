/// The parts between the stop supervisor and its topics.

#include "ros/messages/stop_messages.h"

#include <gtest/gtest.h>

#include "core/slip/vehicle_slip.h"
#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

constexpr double kWheelSpeedAtRest_mps = 0.001;

TEST(StopMessages, CommandsGoThroughUnchanged) {
  const VelocityCommand command{{0.1, -0.2, 0.3}, {-0.4, 0.5, -0.6}};
  const VelocityCommand back = toVelocityCommand(toTwist(command));
  EXPECT_EQ(back.linear_mps, command.linear_mps);
  EXPECT_EQ(back.angular_radps, command.angular_radps);
}

TEST(StopMessages, StatusInFull) {
  SupervisorStatus status;
  status.stamp = 5 * kSecond;
  status.state = StopState::kHolding;
  status.time_left_s = 2.5;
  status.stops = 3;
  status.refusals = 2;
  status.forecasts_stale = true;
  status.emergency_stop = true;
  status.reason = "zero updates";
  StopStatus message;
  fill(status, StopMode::kActive, FrameNames{}, message);
  EXPECT_EQ(message.header.stamp, ros::Time(5, 0));
  EXPECT_EQ(message.state, StopStatus::HOLDING);
  EXPECT_EQ(message.mode, StopStatus::MODE_ACTIVE);
  EXPECT_EQ(message.time_left_s, 2.5);
  EXPECT_EQ(message.stops, 3U);
  EXPECT_EQ(message.refusals, 2U);
  EXPECT_TRUE(message.forecasts_stale);
  EXPECT_TRUE(message.emergency_stop);
  EXPECT_FALSE(message.overridden);
  EXPECT_EQ(message.reason, "zero updates");
}

/// What the supervisor observes through messages is what it observes offline.
class Observer : public ::testing::Test {
 protected:
  Observer() {
    estimate_.nav.stamp = 10 * kSecond;
    estimate_.nav.position = {0.7, -1.4, 250.0};
    estimate_.wheels.stamp = estimate_.nav.stamp;
    estimate_.wheels.count = 4;
    estimate_.motion.v_eb_b = {0.5, 0.1, 0.0};
    for (int i = 0; i < kErrorStates; ++i) {
      for (int j = 0; j < kErrorStates; ++j) {
        P_(i, j) = i == j ? 1.0 + i : 0.01 * (i + j);
      }
    }
  }

  void turnWheels(double speed_mps) {
    estimate_.wheels.circumferential_mps[2] = -speed_mps;
    estimate_.wheels.largest_speed_mps = speed_mps;
  }

  void expectSame() {
    const RoverObservation offline = observationOf(estimate_, P_, kWheelSpeedAtRest_mps);
    if (estimate_.has_wheels) {
      Slip slip;
      fill(vehicleSlip(estimate_, geometry_), estimate_.stationary, geometry_, FrameNames{}, slip);
      observer_.add(slip);
    }
    NavState state;
    fill(estimate_, P_, frame_, FrameNames{}, 0.5, state);
    const RoverObservation online = observer_.observe(state);
    EXPECT_EQ(online.stamp, offline.stamp);
    EXPECT_EQ(online.forward_mps, offline.forward_mps);
    EXPECT_NEAR(online.speed_std_mps, offline.speed_std_mps, 1e-12);
    EXPECT_EQ(online.stationary, offline.stationary);
    EXPECT_EQ(online.has_wheels, offline.has_wheels);
    EXPECT_EQ(online.wheels_at_rest, offline.wheels_at_rest);
  }

  WheelGeometry geometry_{pathfinderWheels(), 1.0};
  LocalFrame frame_{Planet::byName("earth"), Geodetic{0.6999, -1.3999, 240.0}};
  Estimate estimate_;
  ErrorCovariance P_;
  RoverObserver observer_{kWheelSpeedAtRest_mps};
};

TEST_F(Observer, WhileDriving) {
  estimate_.has_wheels = true;
  turnWheels(0.6);
  expectSame();
}

TEST_F(Observer, AtStandstillAndBetweenWheelSamples) {
  estimate_.has_wheels = true;
  estimate_.stationary = true;
  expectSame();
  estimate_.has_wheels = false;
  expectSame();
}

TEST_F(Observer, WhileWheelsStandAndTheFilterDoesNotBelieveIt) {
  estimate_.has_wheels = true;
  turnWheels(kWheelSpeedAtRest_mps);
  expectSame();
  turnWheels(1.001 * kWheelSpeedAtRest_mps);
  expectSame();
}

TEST_F(Observer, WithoutWheelsOfItsOwn) {
  estimate_.has_wheels = true;
  estimate_.wheels.count = 0;
  expectSame();
}

}  // namespace
}  // namespace slipnav
