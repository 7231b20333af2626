/// What the forecaster does with other input than it hopes for: numbers, clocks, parameters.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "forecaster_fixture.h"

namespace slipnav::test {
namespace {

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

}  // namespace
}  // namespace slipnav::test
