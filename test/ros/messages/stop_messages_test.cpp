/// The parts between the stop supervisor and its topics.

#include "ros/messages/stop_messages.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/silence_watch.h"
#include "core/slip/vehicle_slip.h"
#include "core/stopping/forecast_gate.h"
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

/// Writes down what comes out: estimates by their second, forecasts by their negative second.
class ForecastGateTest : public ::testing::Test {
 protected:
  void estimate(int second, double now_s = 0.0, bool has_wheels = true) {
    RoverObservation observation;
    observation.stamp = second * kSecond;
    observation.has_wheels = has_wheels;
    gate_.push(observation, now_s);
  }
  void forecast(int second) { gate_.push(StopForecast{second * kSecond, 1.0}); }

  std::vector<int> released(double now_s = 0.0) {
    std::vector<int> seconds;
    gate_.release(
        now_s,
        [&seconds](const RoverObservation& observation) {
          seconds.push_back(static_cast<int>(observation.stamp / kSecond));
        },
        [&seconds](const StopForecast& forecast) { seconds.push_back(-static_cast<int>(forecast.stamp / kSecond)); });
    return seconds;
  }

  ForecastGate gate_;
};

TEST_F(ForecastGateTest, DoesNotWaitForAForecasterThatHasNeverSpoken) {
  estimate(1);
  EXPECT_EQ(released(), std::vector<int>{1});
  EXPECT_TRUE(gate_.forecasterIsSilent());
}

TEST_F(ForecastGateTest, PutsForecastsBetweenTheirEstimateAndTheNext) {
  gate_.dealtWith(0);
  estimate(1);
  estimate(2);
  estimate(3);
  EXPECT_TRUE(released().empty());
  forecast(2);
  gate_.dealtWith(2 * kSecond);
  EXPECT_EQ(released(), (std::vector<int>{1, 2, -2}));
  gate_.dealtWith(3 * kSecond);
  EXPECT_EQ(released(), std::vector<int>{3});
}

TEST_F(ForecastGateTest, IsAsPatientAsItIsTold) {
  gate_ = ForecastGate(kSimulatedPatience_s);
  estimate(100);
  gate_.dealtWith(100 * kSecond);
  EXPECT_EQ(released(), std::vector<int>{100});
  estimate(1);  // the clock went back
  gate_.dealtWith(1 * kSecond);
  EXPECT_EQ(released(), std::vector<int>{1});
  estimate(2);
  EXPECT_TRUE(released(0.9 * kSimulatedPatience_s).empty());
  EXPECT_EQ(released(1.1 * kSimulatedPatience_s), std::vector<int>{2});
}

TEST_F(ForecastGateTest, HasNoForecastToWaitForBetweenWheelSamples) {
  gate_.dealtWith(1 * kSecond);
  estimate(2, 0.0, false);
  EXPECT_EQ(released(), std::vector<int>{2});
  estimate(3);
  estimate(4, 0.0, false);
  EXPECT_TRUE(released().empty()) << "but the order stays";
  forecast(3);
  gate_.dealtWith(3 * kSecond);
  EXPECT_EQ(released(), (std::vector<int>{3, -3, 4}));
}

TEST_F(ForecastGateTest, KeepsAForecastUntilItsEstimateHasCome) {
  forecast(2);
  estimate(1);
  EXPECT_EQ(released(), std::vector<int>{1});
  estimate(2);
  EXPECT_EQ(released(), (std::vector<int>{2, -2}));
}

TEST_F(ForecastGateTest, WaitsOnceForAForecasterThatFallsSilent) {
  gate_.dealtWith(1 * kSecond);
  estimate(2, 10.0);
  EXPECT_TRUE(released(10.1).empty());
  EXPECT_EQ(released(10.3), std::vector<int>{2});
  estimate(3, 10.4);
  EXPECT_EQ(released(10.4), std::vector<int>{3});
  gate_.dealtWith(3 * kSecond);
  estimate(4, 10.5);
  EXPECT_TRUE(released(10.5).empty());
}

TEST_F(ForecastGateTest, BeginsAnewWhenTheClockGoesBack) {
  gate_.dealtWith(100 * kSecond);
  estimate(101);
  estimate(5);
  EXPECT_EQ(released(), std::vector<int>{5});
}

TEST(SilenceWatch, WantsBothClocksToAgree) {
  SilenceWatch watch(2.0);
  EXPECT_FALSE(watch.isSilent({1000.0, 1000.0}));
  watch.heard({10.0, 500.0});
  EXPECT_FALSE(watch.isSilent({13.0, 501.0})) << "a simulation that runs fast";
  EXPECT_FALSE(watch.isSilent({11.0, 503.0})) << "one that runs slowly";
  EXPECT_TRUE(watch.isSilent({13.0, 503.0}));
  watch.heard({13.0, 503.0});
  EXPECT_FALSE(watch.isSilent({13.0, 503.0}));
}

}  // namespace
}  // namespace slipnav
