/// What the filter has learned of the ground, and doubts, is in its forecast.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/square.h"
#include "forecaster_fixture.h"

namespace slipnav::test {
namespace {

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

/// A body that sways from one interval to the next moves the vehicle nowhere; what lasts, the filter learns.
TEST_F(ForecasterTest, SideSlipIsWhatTheFilterHasLearned) {
  const double usual_rad = degToRad(VehicleModelParams().side_slip_std_deg);
  Forecaster forecaster = make();
  EXPECT_DOUBLE_EQ(drive(forecaster, 150, 0.02).value().outlook.side_slip_std_rad, usual_rad);
  factors_.side_slip = 9.0;
  Forecaster on_a_slope = make();
  EXPECT_DOUBLE_EQ(drive(on_a_slope, 150, 0.02).value().outlook.side_slip_std_rad, 3.0 * usual_rad);
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
  const ErrorCovariance sure = P_;
  const auto boundWith = [&](double slip_doubt, double speed_doubt) {
    P_ = sure;
    Forecaster forecaster = make();
    drive(forecaster, 149, 0.02);
    P_(kSlowSlip, kSlowSlip) += square(slip_doubt);
    P_(kVelocity + 1, kVelocity + 1) += square(speed_doubt * kWheelSpeed_mps);
    std::optional<Forecast> last;
    for (int i = 150; i <= 160; ++i) {
      if (std::optional<Forecast> forecast = forecaster.push(estimate(i, slipAt(i, 0.02)), P_)) {
        last = std::move(forecast);
      }
    }
    return last.value().error.horizontal_bound_m.front();
  };
  const double calm_m = boundWith(0.0, 0.0);
  EXPECT_GT(boundWith(kDoubt, kDoubt), 1.5 * calm_m);
}

/// Of more steps each is as much shorter.
TEST_F(ForecasterTest, ErrorGrowsWithTheWayNotWithTheNumberOfSteps) {
  const auto growthWith = [this](double step_s) {
    constexpr double kHorizon_s = 30.0;
    const FilterSetup setup = Config().navigation().filter;
    CovarianceForecast covariance(Planet::byName("earth"), setup, step_s, ForecastParams().wheel_interval_s);
    covariance.restart(P_, true);
    DriveStep step;
    step.state = estimate(1, 0.05).nav;
    step.speed_mps = 0.95 * kWheelSpeed_mps;
    step.wheel_speed_mps = kWheelSpeed_mps;
    step.wheel_share = 1.0;
    GroundOutlook outlook = covariance.assumption();
    outlook.change_time_s = 1.0;
    const auto count = static_cast<std::size_t>(std::lround(kHorizon_s / step_s));
    return covariance.ahead(std::vector<DriveStep>(count, step), outlook).back();
  };
  EXPECT_NEAR(growthWith(0.25) / growthWith(0.5), 1.0, 0.005);
}

}  // namespace
}  // namespace slipnav::test
