/// What the filter has learned of the ground, and doubts, is in its forecast.

#include <gtest/gtest.h>

#include <optional>
#include <utility>

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
}  // namespace slipnav::test
