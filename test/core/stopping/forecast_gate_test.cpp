#include "core/stopping/forecast_gate.h"

#include <gtest/gtest.h>

#include <vector>

namespace slipnav {
namespace {

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

TEST_F(ForecastGateTest, PassesOnAForecastOfWhatIsReleasedAlready) {
  estimate(1);
  EXPECT_EQ(released(), std::vector<int>{1});
  forecast(1);
  EXPECT_EQ(released(), std::vector<int>{-1}) << "no other estimate is needed";
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

/// Those of another session, whose estimates will never come.
TEST_F(ForecastGateTest, DoesNotCollectForecastsForever) {
  constexpr int kForecasts = 1000;
  for (int second = 1; second <= kForecasts; ++second) {
    forecast(second);
  }
  estimate(kForecasts);
  const std::vector<int> kept = released();
  EXPECT_EQ(kept.size(), 101U) << "the estimate, and a hundred forecasts";
  EXPECT_EQ(kept.front(), kForecasts);
  EXPECT_EQ(kept.back(), -kForecasts) << "the newest is among them";
}

TEST_F(ForecastGateTest, AStepBackOfASecondIsOfTheClock) {
  gate_.dealtWith(0);
  estimate(10);
  estimate(9);
  EXPECT_EQ(released(), std::vector<int>{9});
}

}  // namespace
}  // namespace slipnav
