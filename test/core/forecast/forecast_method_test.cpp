/// What holds for every method of forecasting, through their common interface.

#include "core/forecast/forecast_method.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config/config.h"
#include "core/forecast/forecaster.h"
#include "core/forecast/paper_forecaster.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
constexpr int kWindow = 150;  ///< samples until a forecast of the paper's method is due

ForecastParams paramsOf(const std::string& schedule) {
  ForecastParams params;
  params.schedule = schedule;
  if (schedule == "paper") {
    params.bound = "absolute";
    params.slip.model = "paper";
    params.slip.inference = "dense";
    params.sigma_points.form = "paper";
  }
  return params;
}

class ForecastMethodTest : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<ForecastMethod> make() const {
    return makeForecastMethod(Planet::byName("earth"), Config().navigation().filter, paramsOf(GetParam()));
  }

  static Estimate estimate(int sample, double more_slip = 0.0) {
    Estimate e;
    const double slip = more_slip + 0.05 + 0.03 * std::sin(0.9 * sample) * std::cos(0.31 * sample);
    e.nav.stamp = kStart + fromSeconds(0.1 * sample);
    e.nav.v_eb_n = Vector3(0.8 * (1.0 - slip), 0.0, 0.0);
    e.f_ib_b = Vector3(0.0, 0.0, -9.8);
    e.has_wheels = e.wheel_speed_used = true;
    e.wheels.stamp = e.nav.stamp;
    e.wheels.motion.forward_mps = 0.8;
    e.motion = {0.1, e.nav.v_eb_n, Vector3::Zero()};
    return e;
  }

  /// @return whether a forecast was made
  bool drive(ForecastMethod& method, int first, int last, double more_slip = 0.0) const {
    bool made = false;
    for (int i = first; i <= last; ++i) {
      made = method.push(estimate(i, more_slip), P_).has_value() || made;
    }
    return made;
  }

  ErrorCovariance P_ = 1e-6 * ErrorCovariance::Identity();
};

TEST_P(ForecastMethodTest, ForecastsAfterAWindow) {
  const std::unique_ptr<ForecastMethod> method = make();
  EXPECT_TRUE(drive(*method, 1, kWindow));
  EXPECT_EQ(method->problem(), "");
}

TEST_P(ForecastMethodTest, EstimateThatIsNotNewerBeginsAnew) {
  const std::unique_ptr<ForecastMethod> method = make();
  const std::unique_ptr<ForecastMethod> fresh = make();
  drive(*method, 1, kWindow - 1, 0.3);
  std::optional<Forecast> forecast;
  std::optional<Forecast> expected;
  for (int i = kWindow - 1; i < 2 * kWindow; ++i) {
    expected = fresh->push(estimate(i), P_);
    forecast = method->push(estimate(i), P_);
    ASSERT_EQ(forecast.has_value(), expected.has_value()) << "sample " << i;
    if (expected) {
      EXPECT_EQ(forecast->error.horizontal_bound_m, expected->error.horizontal_bound_m) << "sample " << i;
    }
  }
}

TEST_P(ForecastMethodTest, ForgetsEverythingWhenReset) {
  const std::unique_ptr<ForecastMethod> method = make();
  Estimate broken = estimate(kWindow - 1);
  drive(*method, 1, kWindow - 2);
  broken.nav.v_eb_n.x() = std::numeric_limits<double>::quiet_NaN();
  method->push(broken, P_);
  method->reset();
  EXPECT_EQ(method->problem(), "");
  EXPECT_FALSE(drive(*method, kWindow, kWindow + 5));
}

TEST_P(ForecastMethodTest, EstimatesBetweenWheelSamplesAreLeftOut) {
  const std::unique_ptr<ForecastMethod> method = make();
  for (int i = 1; i <= 2 * kWindow; ++i) {
    Estimate without = estimate(i);
    without.has_wheels = false;
    without.motion.v_eb_b.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(method->push(without, P_));
  }
  EXPECT_EQ(method->problem(), "");
}

TEST_P(ForecastMethodTest, WhateverIsNotFiniteIsSaid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto problem = [this](const Estimate& e, const ErrorCovariance& P) {
    const std::unique_ptr<ForecastMethod> method = make();
    EXPECT_FALSE(method->push(e, P));
    return method->problem();
  };
  EXPECT_EQ(problem(estimate(1), P_), "");
  const std::string expected = "the estimate is not finite";
  Estimate e = estimate(1);
  e.nav.position.height_m = nan;
  EXPECT_EQ(problem(e, P_), expected);
  e = estimate(1);
  e.motion.v_eb_b.y() = nan;
  EXPECT_EQ(problem(e, P_), expected);
  e = estimate(1);
  e.f_ib_b.z() = nan;
  EXPECT_EQ(problem(e, P_), expected);
  e = estimate(1);
  e.wheels.motion.forward_mps = nan;
  EXPECT_EQ(problem(e, P_), expected);
  ErrorCovariance P = P_;
  P(kVelocity, kPosition) = nan;
  EXPECT_EQ(problem(estimate(1), P), expected);
}

INSTANTIATE_TEST_SUITE_P(Schedules, ForecastMethodTest, ::testing::Values("sliding", "paper"));

TEST(ForecastSchedule, ChoosesTheMethod) {
  const FilterSetup setup = Config().navigation().filter;
  const auto paper = makeForecastMethod(Planet::byName("earth"), setup, paramsOf("paper"));
  const auto sliding = makeForecastMethod(Planet::byName("earth"), setup, paramsOf("sliding"));
  EXPECT_NE(dynamic_cast<const PaperForecaster*>(paper.get()), nullptr);
  EXPECT_NE(dynamic_cast<const Forecaster*>(sliding.get()), nullptr);
}

}  // namespace
}  // namespace slipnav
