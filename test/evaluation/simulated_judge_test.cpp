#include "evaluation/simulated_judge.h"

#include <gtest/gtest.h>

#include "evaluation/simulated_drive.h"

namespace slipnav {
namespace {

constexpr double kRouteEnd_m = 10.0;

/// Ten meters at 1 m/s with a stop of two seconds after the fifth, then a rest; the estimate is off by `error`.
SimulationFigures judged(const ErrorVector& error, bool stop_is_used) {
  const Planet planet = Planet::byName("earth");
  SimulatedJudge judge(planet, Vector3::Zero(), kRouteEnd_m);
  sim::TruthState truth;
  truth.wheel_radius_m.fill(0.1);
  for (int i = 0; i < 160; ++i) {
    const bool rests = (i >= 60 && i < 80) || i >= 130;
    truth.stamp = fromSeconds(0.1) * i;
    truth.standstill = rests;
    truth.distance_m += rests ? 0.0 : 0.1;
    truth.wheel_rate_radps.fill(rests ? 0.0 : 12.0);
    const Nanoseconds imu_stamp = truth.stamp + fromSeconds(0.003);
    judge.addTruth(imu_stamp, truth);
    Estimate estimate;
    estimate.nav = toNavState(truth, planet, Vector3::Zero());
    estimate.nav.stamp = imu_stamp;
    subtractError(planet, -error, estimate.nav);
    estimate.stationary = rests && (stop_is_used || i >= 130);
    judge.compare(estimate, ErrorCovariance::Identity());
  }
  return judge.figures();
}

TEST(SimulatedJudge, AnExactEstimateHasNoErrorAndItsStopIsCounted) {
  const SimulationFigures figures = judged(ErrorVector::Zero(), true);
  EXPECT_NEAR(figures.nees_end_position.value(), 0.0, 1e-12);
  EXPECT_EQ(figures.stops_seen, 1);
  EXPECT_EQ(figures.stops_used, 1);
  EXPECT_EQ(figures.longest_beyond_3sigma_s, 0.0);
  EXPECT_NEAR(figures.largest_wheel_speed_mps, 1.2, 1e-12);
}

TEST(SimulatedJudge, ErrorsAreNormalizedAndTimedBeyondThreeSigma) {
  ErrorVector error = ErrorVector::Zero();
  error[kPosition + 1] = 4.0;
  error[kVelocity] = 3.0;
  error[kAttitude + 2] = 1e-3;
  const SimulationFigures figures = judged(error, false);
  EXPECT_NEAR(figures.nees_end_position.value(), 16.0 / 3.0, 1e-3);
  EXPECT_NEAR(figures.nees_end_velocity.value(), 3.0, 1e-3);
  EXPECT_NEAR(figures.nees_end_attitude.value(), 1e-6 / 3.0, 1e-8);
  EXPECT_NEAR(figures.longest_beyond_3sigma_s, 15.9, 1e-6);
  EXPECT_NEAR(figures.largest_error_m, 4.0, 1e-3);
  EXPECT_NEAR(figures.largest_speed_mps, 3.0, 1e-6);
  EXPECT_EQ(figures.stops_seen, 1);
  EXPECT_EQ(figures.stops_used, 0);
}

TEST(SimulatedJudge, FiguresAreJson) {
  SimulationFigures figures;
  figures.nees_end_attitude = 0.5;
  figures.alarms["imu gap"] = {fromSeconds(1.0), fromSeconds(2.0), 3};
  const std::string text = figuresJson(figures);
  EXPECT_NE(text.find("\"nees_end_attitude\": 0.5,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"nees_end_velocity\": null,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"alarms\": [{\"what\": \"imu gap\", \"count\": 3, \"first_s\": 1, \"last_s\": 2}]"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace slipnav
