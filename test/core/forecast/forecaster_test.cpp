/// When a forecast is made, and how its bound grows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/square.h"
#include "forecaster_fixture.h"

namespace slipnav::test {
namespace {

TEST_F(ForecasterTest, ForecastsEverySecondOnceTheSpeedIsKnown) {
  Forecaster forecaster = make();
  ASSERT_FALSE(drive(forecaster, 14, 0.02));
  Forecaster again = make();
  const std::optional<Forecast> last = drive(again, 150, 0.02);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->slip.times_s.size(), 60);
  EXPECT_NEAR(forecasts_, 14, 1);
}

/// A rover that turns on the spot has no slip ratio: that which the filter has learned to expect is forecast.
TEST_F(ForecasterTest, TurningOnTheSpotTheFilterIsBelieved) {
  const VehicleModelParams vehicle;
  factors_.slow_slip = 4.0;
  Forecaster forecaster = make();
  std::optional<Forecast> last;
  for (int i = 0; i <= 100; ++i) {
    Estimate e = estimate(i, 0.0, i == 0);
    e.nav.v_eb_n = e.motion.v_eb_b = Vector3::Zero();
    e.wheels.motion.forward_mps = 0.0;
    e.omega_ib_b.z() = 0.4;
    if (std::optional<Forecast> forecast = forecaster.push(e, P_)) {
      last = std::move(forecast);
      ++forecasts_;
    }
  }
  EXPECT_NEAR(forecasts_, 9, 1);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->fit.status, SlipFitStatus::kTooFewSamples);
  EXPECT_DOUBLE_EQ(last->outlook.drift_std, 2.0 * vehicle.slow_slip_std);
  EXPECT_DOUBLE_EQ(last->outlook.change_std, vehicle.fast_slip_std);
  EXPECT_NEAR(last->slip.stddev(0), std::hypot(last->outlook.drift_std, last->outlook.change_std), 1e-12);
  EXPECT_TRUE(forecaster.problem().empty());
}

TEST_F(ForecasterTest, RestThatIsNotRecognizedIsNotForecast) {
  Forecaster forecaster = make();
  for (int i = 0; i <= 100; ++i) {
    Estimate e = estimate(i, 0.0, i == 0);
    e.wheels.motion.forward_mps = 0.0;
    EXPECT_FALSE(forecaster.push(e, P_));
  }
}

/// A gyro with a bias of a degree in two or three seconds does not turn a rover that stands.
TEST_F(ForecasterTest, TurningIsWhatNoGyroShowsAtRest) {
  const auto forecastsAt = [this](double rate_deg_per_s) {
    Forecaster forecaster = make();
    int forecasts = 0;
    for (int i = 0; i <= 100; ++i) {
      Estimate e = estimate(i, 0.0, i == 0);
      e.wheels.motion.forward_mps = 0.0;
      e.omega_ib_b.z() = degToRad(rate_deg_per_s);
      forecasts += forecaster.push(e, P_) ? 1 : 0;
    }
    return forecasts;
  };
  EXPECT_EQ(forecastsAt(0.4), 0);
  EXPECT_GT(forecastsAt(-1.0), 0);
}

TEST_F(ForecasterTest, SlipIsForecastToChangeAsFastAsItIsSeenTo) {
  Forecaster forecaster = make();
  std::optional<Forecast> last;
  for (int i = 0; i <= 300; ++i) {
    const double slip = 0.05 * std::sin(0.1 * i) * std::cos(0.005 * i);
    if (std::optional<Forecast> forecast = forecaster.push(estimate(i, slip, i == 0), P_)) {
      last = std::move(forecast);
    }
  }
  EXPECT_GT(last.value().outlook.change_time_s.value(), 3.0 * ForecastParams().wheel_interval_s);
  EXPECT_EQ(last->outlook.change_time_s, last->correlation.time_constant_s);
}

/// Stamps that go back: nothing of the first drive is left.
TEST_F(ForecasterTest, ARecordingThatStartsAgainIsLikeANewOne) {
  Forecaster fresh = make();
  const Forecast expected = drive(fresh, 150, 0.02).value();
  Forecaster experienced = make();
  base_slip_ = 0.4;
  factors_.slow_slip = 9.0;
  drive(experienced, 230, 0.1);
  base_slip_ = 0.05;
  factors_ = NoiseFactors{};
  const Forecast again = drive(experienced, 150, 0.02).value();
  EXPECT_EQ(again.slip.mean, expected.slip.mean);
  EXPECT_EQ(again.slip.stddev, expected.slip.stddev);
  EXPECT_EQ(again.outlook.drift_std, expected.outlook.drift_std);
  EXPECT_EQ(again.error.horizontal_bound_m, expected.error.horizontal_bound_m);
}

/// Slip that came and went may have stayed, as an error of the velocity that only a stop can show.
TEST_F(ForecasterTest, SlipThatShowedIsRememberedUntilTheNextStop) {
  Forecaster shown = make();
  std::optional<Forecast> last;
  const auto push = [&](int i, double slip, bool stationary) {
    if (std::optional<Forecast> forecast = shown.push(estimate(i, slip, stationary), P_)) {
      last = std::move(forecast);
    }
  };
  for (int i = 0; i <= 300; ++i) {
    push(i, i > 60 && i <= 110 ? 0.2 : 0.0, i == 0);
  }
  EXPECT_NEAR(last.value().outlook.drift_std, 0.2, 0.01);
  for (int i = 301; i <= 600; ++i) {
    push(i, 0.0, i == 301);
  }
  EXPECT_LT(last.value().outlook.drift_std, 0.01);
}

/// An IMU that is mounted askew takes the estimate aside by a share of the way: of that since the stop, and of that
/// ahead.
TEST_F(ForecasterTest, AnErrorOfTheMountingCountsForTheWholeWay) {
  constexpr double kYawStd = 0.05;
  constexpr double kSpeed_mps = 0.76;
  const auto boundWith = [this](double yaw_std) {
    P_(kMountYaw, kMountYaw) = square(yaw_std);
    Forecaster forecaster = make();
    return drive(forecaster, 300, 0.02).value().error.horizontal_bound_m;
  };
  const std::vector<double> askew = boundWith(kYawStd);
  const std::vector<double> straight = boundWith(0.0);
  const auto aside_m = [&](std::size_t i) { return std::sqrt(square(askew.at(i)) - square(straight.at(i))); };
  const double at_most_m = 3.0 * kYawStd * kSpeed_mps * 30.0;
  EXPECT_GT(aside_m(0), 0.2 * at_most_m) << "a filter that is sure of its velocity heeds the constraint little";
  EXPECT_LT(aside_m(0), at_most_m);
  EXPECT_NEAR(aside_m(askew.size() - 1), 3.0 * at_most_m, 0.3 * 3.0 * at_most_m);
}

TEST_F(ForecasterTest, BoundGrowsFromTheStopAndSaysWhenToStop) {
  ForecastParams params;
  params.threshold_m = 1.0;
  Forecaster forecaster = make(params);
  const ErrorOutlook error = drive(forecaster, 150, 0.02).value().error;
  EXPECT_GT(error.stamp, kStart + 13 * kSecond);
  EXPECT_LE(error.stamp, kStart + 15 * kSecond);
  ASSERT_EQ(error.times_s.size(), 120U);
  EXPECT_DOUBLE_EQ(error.times_s.back(), 60.0);
  for (std::size_t i = 1; i < error.times_s.size(); ++i) {
    EXPECT_GE(error.horizontal_bound_m[i], error.horizontal_bound_m[i - 1]);
  }
  EXPECT_LT(error.horizontal_bound_m.front(), 1.0) << "the 10 m that the position is uncertain by are not growth";
  ASSERT_TRUE(std::isfinite(error.time_to_stop_s));
  const auto passed = static_cast<std::size_t>(std::lround(error.time_to_stop_s / params.step_s));
  EXPECT_LT(error.horizontal_bound_m[passed - 1], 1.0);
  EXPECT_GE(error.horizontal_bound_m[passed], 1.0);
  EXPECT_NEAR(error.stop_distance_m, 0.76 * error.time_to_stop_s, 0.03 * error.time_to_stop_s);
}

/// After hours the heading is uncertain, and the position with it. That the rover gains speed must not be taken for a
/// sight of the heading, which would move the position by meters.
TEST_F(ForecasterTest, GainingSpeedTellsNothingAboutTheHeading) {
  constexpr double kHeadingStd = 0.05;
  P_(kAttitude + 2, kAttitude + 2) = kHeadingStd * kHeadingStd;
  P_(kAttitude + 2, kPosition) = P_(kPosition, kAttitude + 2) = 0.99 * kHeadingStd * 10.0;
  const auto covarianceAt =
      [this](const Vector3& v_n) {  // a velocity in body axes that is known turns with the heading
        ErrorCovariance turn = ErrorCovariance::Identity();
        turn.block<3, 3>(kVelocity, kAttitude) = -skew(v_n);
        return ErrorCovariance(turn * P_ * turn.transpose());
      };
  Forecaster forecaster = make();
  const auto push = [&](int sample, double share) {
    Estimate e = estimate(sample, slipAt(sample, 0.02), share == 0.0);
    e.nav.v_eb_n *= share;
    e.motion.v_eb_b *= share;
    e.wheels.motion.forward_mps *= share;
    return forecaster.push(e, covarianceAt(e.nav.v_eb_n));
  };
  for (int i = 0; i <= 150; ++i) {
    push(i, i == 0 ? 0.0 : 1.0);
  }
  int forecasts = 0;
  for (int i = 151; i <= 180; ++i) {
    const double share = i < 155 ? 0.0 : std::min(1.0, 0.12 * (i - 154));
    if (const std::optional<Forecast> forecast = push(i, share)) {
      EXPECT_LT(forecast->error.horizontal_bound_m.front(), 0.5) << "sample " << i;
      ++forecasts;
    }
  }
  EXPECT_GE(forecasts, 2);
}

TEST_F(ForecasterTest, AbsoluteBoundCountsAllOfTheError) {
  ForecastParams params;
  params.bound = "absolute";
  Forecaster forecaster = make(params);
  const ErrorOutlook error = drive(forecaster, 150, 0.02).value().error;
  EXPECT_NEAR(error.horizontal_bound_m.front(), 3.0 * std::sqrt(200.0), 1.0);
  EXPECT_EQ(error.time_to_stop_s, 0.0);
}

TEST_F(ForecasterTest, MoreSlipMeansAnEarlierStop) {
  ForecastParams params;
  params.threshold_m = 2.0;
  Forecaster calm = make(params);
  Forecaster slippery = make(params);
  const double late_m = drive(calm, 150, 0.002).value().error.horizontal_bound_m.back();
  const double early_m = drive(slippery, 150, 0.3).value().error.horizontal_bound_m.back();
  EXPECT_GT(early_m, 1.05 * late_m);
}

}  // namespace
}  // namespace slipnav::test
