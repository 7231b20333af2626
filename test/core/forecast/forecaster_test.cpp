#include "core/forecast/forecaster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "config/config.h"
#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
constexpr double kWheelSpeed_mps = 0.8;

/// A drive east on a road, with wheel samples at 10 Hz.
class ForecasterTest : public ::testing::Test {
 protected:
  /// As after a stop, 10 m from where it seems.
  ForecasterTest() {
    P_.diagonal().segment<3>(kAttitude).setConstant(1e-8);
    P_.diagonal().segment<3>(kVelocity).setConstant(1e-6);
    P_.diagonal().segment<3>(kPosition).setConstant(100.0);
    P_.diagonal().segment<3>(kAccelBias).setConstant(1e-8);
    P_.diagonal().segment<3>(kGyroBias).setConstant(1e-13);
    P_.diagonal().tail<kErrorStates - kNavStates>().setConstant(1e-6);
  }

  Forecaster make(const ForecastParams& params = {}) const {
    return {Planet::byName("earth"), Config().navigation().filter, params};
  }

  Estimate estimate(int sample, double slip, bool stationary = false) const {
    Estimate e;
    e.nav.stamp = kStart + fromSeconds(0.1 * sample);
    e.nav.q_b_to_n = Quaternion(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitZ()));
    const double speed_mps = stationary ? 0.0 : kWheelSpeed_mps * (1.0 - slip);
    e.nav.v_eb_n = Vector3(0.0, speed_mps, 0.0);
    e.has_wheels = true;
    e.stationary = stationary;
    e.wheel_speed_used = !stationary;
    e.wheels.stamp = e.nav.stamp;
    e.wheels.motion.forward_mps = stationary ? 0.0 : kWheelSpeed_mps;
    e.motion = {0.1, Vector3(speed_mps, 0.0, 0.0), Vector3::Zero()};
    e.noise_factors = factors_;
    return e;
  }

  double slipAt(int sample, double size) const {
    return base_slip_ + size * std::sin(0.9 * sample) * std::cos(0.31 * sample);
  }

  /// Stands, then drives; the last forecast.
  std::optional<Forecast> drive(Forecaster& forecaster, int samples, double slip_size) {
    std::optional<Forecast> last;
    forecaster.push(estimate(0, 0.0, true), P_);
    for (int i = 1; i <= samples; ++i) {
      if (std::optional<Forecast> forecast = forecaster.push(estimate(i, slipAt(i, slip_size)), P_)) {
        last = std::move(forecast);
        ++forecasts_;
      }
    }
    return last;
  }

  ErrorCovariance P_ = ErrorCovariance::Zero();
  NoiseFactors factors_;
  double base_slip_ = 0.05;
  int forecasts_ = 0;
};

TEST_F(ForecasterTest, ForecastsOnceASecondWhenTheWindowHoldsEnough) {
  Forecaster forecaster = make();
  ASSERT_FALSE(drive(forecaster, 14, 0.02));
  Forecaster again = make();
  ASSERT_TRUE(drive(again, 150, 0.02));
  EXPECT_NEAR(forecasts_, 14, 1);
}

TEST_F(ForecasterTest, BoundGrowsFromTheStopAndSaysWhenToStop) {
  ForecastParams params;
  params.threshold_m = 1.0;
  Forecaster forecaster = make(params);
  const ErrorOutlook error = drive(forecaster, 150, 0.02).value().error;
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

TEST_F(ForecasterTest, ConstantSlipAndSlipThatIsNotANumberAreForecast) {
  Forecaster forecaster = make();
  const std::optional<Forecast> constant = drive(forecaster, 100, 0.0);
  ASSERT_TRUE(constant);
  EXPECT_EQ(constant->fit.status, SlipFitStatus::kConstantSlip);
  Estimate broken = estimate(101, 0.05);
  broken.motion.v_eb_b.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(forecaster.push(broken, P_));
  for (int i = 102; i < 130; ++i) {
    if (const std::optional<Forecast> forecast = forecaster.push(estimate(i, slipAt(i, 0.02)), P_)) {
      for (const double bound_m : forecast->error.horizontal_bound_m) {
        ASSERT_TRUE(std::isfinite(bound_m));
      }
    }
  }
}

TEST_F(ForecasterTest, EstimatesThatAreNotFiniteAreRefusedAndForgotten) {
  Forecaster forecaster = make();
  drive(forecaster, 40, 0.02);
  ErrorCovariance broken = P_;
  broken(kPosition, kVelocity) = std::numeric_limits<double>::quiet_NaN();
  for (int i = 41; i <= 60; ++i) {
    EXPECT_FALSE(forecaster.push(estimate(i, slipAt(i, 0.02)), broken));
    EXPECT_EQ(forecaster.problem(), "the estimate is not finite");
  }
  std::optional<Forecast> forecast;
  for (int i = 61; i <= 80; ++i) {
    if (std::optional<Forecast> next = forecaster.push(estimate(i, slipAt(i, 0.02)), P_)) {
      forecast = std::move(next);
    }
  }
  ASSERT_TRUE(forecast);
  EXPECT_TRUE(std::isfinite(forecast->error.horizontal_bound_m.back()));
}

TEST_F(ForecasterTest, ForecastThatOverflowsIsNotMade) {
  P_ *= 1e306;
  ForecastParams params;
  params.bound = "absolute";
  Forecaster forecaster = make(params);
  EXPECT_FALSE(drive(forecaster, 60, 0.02));
  EXPECT_EQ(forecaster.problem(), "the forecast is not finite");
}

TEST_F(ForecasterTest, ClockThatGoesBackBeginsAnew) {
  Forecaster forecaster = make();
  ASSERT_TRUE(drive(forecaster, 150, 0.02));
  forecasts_ = 0;
  EXPECT_FALSE(drive(forecaster, 14, 0.02));
}

TEST_F(ForecasterTest, AnotherThresholdHoldsFromTheNextForecastOn) {
  ForecastParams params;
  params.threshold_m = 1.0;
  const FilterSetup setup = Config().navigation().filter;
  Forecaster forecaster = make();
  ASSERT_TRUE(drive(forecaster, 150, 0.02));
  forecaster.retune(setup, params);
  std::optional<Forecast> next;
  for (int i = 151; !next; ++i) {
    next = forecaster.push(estimate(i, slipAt(i, 0.02)), P_);
  }
  EXPECT_EQ(next->error.threshold_m, 1.0);
  EXPECT_TRUE(std::isfinite(next->error.time_to_stop_s));
}

TEST_F(ForecasterTest, RetunedToTheSameItChangesNoBit) {
  Forecaster kept = make();
  Forecaster retuned = make();
  ASSERT_TRUE(drive(kept, 100, 0.02));
  ASSERT_TRUE(drive(retuned, 100, 0.02));
  retuned.retune(Config().navigation().filter, {});
  for (int i = 101; i < 130; ++i) {
    const std::optional<Forecast> a = kept.push(estimate(i, slipAt(i, 0.02)), P_);
    const std::optional<Forecast> b = retuned.push(estimate(i, slipAt(i, 0.02)), P_);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      ASSERT_EQ(a->error.horizontal_bound_m, b->error.horizontal_bound_m);
    }
  }
}

TEST_F(ForecasterTest, NoiseThatTheFilterTakesOtherwiseCountsInTheBound) {
  FilterSetup setup = Config().navigation().filter;
  setup.nonholonomic.lateral_std_mps = 1.0;
  Forecaster kept = make();
  Forecaster retuned = make();
  retuned.retune(setup, {});
  const double kept_m = drive(kept, 150, 0.02).value().error.horizontal_bound_m.back();
  EXPECT_GT(drive(retuned, 150, 0.02).value().error.horizontal_bound_m.back(), 1.01 * kept_m);
}

/// Slip that varies by more than the filter has learned is the noise of its own estimate.
TEST_F(ForecasterTest, SlipThatComesAndGoesIsWhatTheFilterHasLearned) {
  const VehicleModelParams vehicle;
  Forecaster forecaster = make();
  EXPECT_DOUBLE_EQ(drive(forecaster, 150, 0.3).value().outlook.change_std, vehicle.fast_slip_std);
  factors_.fast_slip = 4.0;
  Forecaster on_rough_ground = make();
  EXPECT_GT(drive(on_rough_ground, 150, 0.3).value().outlook.change_std, 1.2 * vehicle.fast_slip_std);
}

/// A body that sways from one interval to the next moves the vehicle nowhere; a drift to one side over meters does.
TEST_F(ForecasterTest, SideSlipCountsAsItLasts) {
  constexpr double kSideways_mps = 0.1;
  const auto spread = [&](int samples_to_one_side) {
    Forecaster forecaster = make();
    forecaster.push(estimate(0, 0.0, true), P_);
    double side_slip_std_rad = 0.0;
    for (int i = 1; i <= 150; ++i) {
      Estimate e = estimate(i, slipAt(i, 0.02));
      e.motion.v_eb_b.y() = (i / samples_to_one_side) % 2 == 0 ? kSideways_mps : -kSideways_mps;
      if (const std::optional<Forecast> forecast = forecaster.push(e, P_)) {
        side_slip_std_rad = forecast->outlook.side_slip_std_rad;
      }
    }
    return side_slip_std_rad;
  };
  const double angle_rad = std::atan(kSideways_mps / kWheelSpeed_mps);
  EXPECT_LT(spread(1), 0.05 * angle_rad);
  EXPECT_GT(spread(52), 0.8 * angle_rad);
}

/// A slip of 5 % that stays is more than the filter expects, and is not explained away by its velocity error.
TEST_F(ForecasterTest, SlipThatStaysCountsInFull) {
  const VehicleModelParams vehicle;
  for (const double hidden : {0.0, 0.05}) {
    P_.diagonal().segment<3>(kVelocity).setConstant(1e-6 + square(hidden * kWheelSpeed_mps));
    Forecaster forecaster = make();
    EXPECT_GT(drive(forecaster, 150, 0.002).value().outlook.drift_std, 1.1 * vehicle.slow_slip_std) << hidden;
  }
}

/// On a road less than the usual slip is forecast, but never less than the velocity error could hide.
TEST_F(ForecasterTest, RoadIsForecastAsGoodAsItIsKnownToBe) {
  const VehicleModelParams vehicle;
  base_slip_ = 0.0;
  Forecaster sure = make();
  EXPECT_LT(drive(sure, 150, 0.002).value().outlook.drift_std, 0.2 * vehicle.slow_slip_std);
  const double hidden = 0.02;
  P_.diagonal().segment<3>(kVelocity).setConstant(square(hidden * kWheelSpeed_mps));
  Forecaster unsure = make();
  const double drift_std = drive(unsure, 150, 0.002).value().outlook.drift_std;
  EXPECT_GE(drift_std, 0.99 * hidden);
  EXPECT_LT(drift_std, vehicle.slow_slip_std);
}

/// Where the filter has inflated slip and speed, which the wheels cannot distinguish, the error grows accordingly.
TEST_F(ForecasterTest, DoubtOfTheFilterIsDoubtOfTheForecast) {
  constexpr double kDoubt = 0.3;
  Forecaster calm = make();
  const double calm_m = drive(calm, 160, 0.02).value().error.horizontal_bound_m.front();
  Forecaster doubting = make();
  drive(doubting, 149, 0.02);
  P_(kSlowSlip, kSlowSlip) += square(kDoubt);
  P_(kVelocity + 1, kVelocity + 1) += square(kDoubt * kWheelSpeed_mps);
  std::optional<Forecast> last;
  for (int i = 150; i <= 160; ++i) {
    if (std::optional<Forecast> forecast = doubting.push(estimate(i, slipAt(i, 0.02)), P_)) {
      last = std::move(forecast);
    }
  }
  EXPECT_GT(last.value().error.horizontal_bound_m.front(), 1.2 * calm_m);
}

}  // namespace
}  // namespace slipnav
