#include "evaluation/forecast_judgement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav {
namespace {

constexpr double kDrift_mps = 0.01;
constexpr double kStop_s = 100.0;

/// 200 s at 10 Hz. The estimate drifts east by 1 cm every second, and stands at 100 s for a second.
EstimateTrack drifting() {
  EstimateTrack track;
  track.reserve(2001);
  for (int i = 0; i <= 2000; ++i) {
    EstimateSample sample;
    sample.stamp = fromSeconds(0.1 * i);
    sample.position_enu_m = Vector3(0.1 * i * kDrift_mps, 0.0, 0.0);
    sample.stationary = i >= 1000 && i < 1010;
    track.push_back(sample);
  }
  return track;
}

TruthTrack resting(double until_s = 200.0) {
  return TruthTrack({{0, Vector3::Zero()}, {fromSeconds(until_s), Vector3::Zero()}}, 1000.0);
}

std::vector<ForecastRow> forecastAt(double at_s, double bound_m) {
  return {{fromSeconds(at_s), 1.0, 0.01, {}}, {fromSeconds(at_s), 60.0, bound_m, {}}};
}

TEST(ForecastJudgement, ComparesTheEndOfTheHorizonWithTheGrowthSinceTheStop) {
  std::vector<ForecastRow> forecasts = forecastAt(20.0, 0.9);  // grows to 0.8 m since the begin
  for (const ForecastRow& row : forecastAt(120.0, 0.5)) {      // grows to 0.79 m since the end of the stop
    forecasts.push_back(row);
  }
  Metrics metrics;
  judgeForecasts(forecasts, drifting(), resting(), metrics);
  EXPECT_EQ(metrics.forecasts_judged, 2);
  EXPECT_DOUBLE_EQ(*metrics.forecast_horizon_s, 60.0);
  EXPECT_NEAR(*metrics.forecast_bound_m, 0.7, 1e-12);
  EXPECT_NEAR(*metrics.forecast_growth_rms_m, std::sqrt((0.8 * 0.8 + 0.791 * 0.791) / 2.0), 1e-9);
  EXPECT_DOUBLE_EQ(*metrics.forecast_below_pct, 50.0);
}

TEST(ForecastJudgement, AStopAGapOrTheEndCutsItShort) {
  for (const double at_s : {60.0, 180.0}) {  // the stop, the end
    Metrics metrics;
    judgeForecasts(forecastAt(at_s, 1.0), drifting(), resting(), metrics);
    EXPECT_EQ(metrics.forecasts_judged, 0) << at_s;
    EXPECT_FALSE(metrics.forecast_below_pct) << at_s;
  }
  Metrics metrics;
  judgeForecasts(forecastAt(20.0, 1.0), drifting(), resting(50.0), metrics);
  EXPECT_EQ(metrics.forecasts_judged, 0) << "no truth";
}

}  // namespace
}  // namespace slipnav
