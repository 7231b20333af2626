/// When a stop comes: by forecast, by the period where there is none.

#include <gtest/gtest.h>

#include "supervisor_rig.h"

namespace slipnav::test {
namespace {

TEST(StopSupervisor, ANewForecastMovesTheCountdown) {
  Rig rig("active");
  driveTenSeconds(rig);
  rig.forecast(5.0);
  rig.moving();
  rig.forecast(9.0);
  EXPECT_NEAR(rig.supervisor.status().time_left_s, 9.0 - kSpeed_mps / 0.5, 1e-6);
  rig.forecast(kInfinity);
  EXPECT_EQ(rig.supervisor.status().time_left_s, kInfinity);
}

TEST(StopSupervisor, TheCountdownIsAlwaysFinite) {
  Rig rig("advise");
  EXPECT_FALSE(rig.supervisor.countdown_s().has_value()) << "nothing is known";
  driveTenSeconds(rig);
  EXPECT_EQ(rig.supervisor.countdown_s(), 60.0) << "no stop is due";
  rig.forecast(6.0);
  EXPECT_NEAR(*rig.supervisor.countdown_s(), 6.0 - kSpeed_mps / 0.5, 1e-6);
  rig.forecast(0.0);
  EXPECT_EQ(rig.supervisor.countdown_s(), 0.0);
  rig.supervisor.setOverride(true);
  EXPECT_EQ(rig.supervisor.countdown_s(), 60.0) << "whoever counts must not stop the rover";
  rig.supervisor.setEmergencyStop(true);
  EXPECT_EQ(rig.supervisor.countdown_s(), 0.0);
  rig.supervisor.retune(Rig::paramsOf("off", 3.0));
  EXPECT_EQ(rig.supervisor.countdown_s(), 0.0) << "in every mode";
  rig.supervisor.setEmergencyStop(false);
  EXPECT_FALSE(rig.supervisor.countdown_s().has_value());
}

TEST(StopSupervisor, AfterAStopTheOldForecastIsVoidAndThereIsTimeToDrive) {
  Rig rig("active");
  situations()[4].reach(rig);
  rig.during(1.0, [&rig] { rig.standing(1e-5); });
  EXPECT_EQ(rig.supervisor.status().reason, "no forecast since the last stop");
  rig.forecast(0.0);  // the threshold is below what one meter costs
  EXPECT_EQ(rig.state(), kC);
  rig.during(4.6, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kC);
  rig.during(0.2, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS);
}

TEST(StopSupervisor, StaleForecastsMakeStopsPeriodic) {
  Rig rig("active");
  rig.during(5.0, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.supervisor.status().reason, "no forecast since the last stop");
  rig.during(0.2, [&rig] { rig.moving(); });
  EXPECT_TRUE(rig.supervisor.status().forecasts_stale);
  EXPECT_EQ(rig.supervisor.status().reason, "no new forecast: periodic stop");
  EXPECT_EQ(rig.state(), kC);
  rig.during(5.0, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kC);
  rig.during(0.4, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS) << "12 s less the time to slow down";
  rig.during(1.0, [&rig] { rig.standing(1e-5); });
  rig.forecast(kInfinity);
  EXPECT_FALSE(rig.supervisor.status().forecasts_stale);
  EXPECT_EQ(rig.state(), kD);
}

TEST(StopSupervisor, ForecastThatIsKeptIsNotStaleBeforeItsStop) {
  Rig rig("active");
  driveTenSeconds(rig);
  rig.forecast(30.0, 30.0);
  rig.during(28.3, [&rig] { rig.moving(); });
  EXPECT_FALSE(rig.supervisor.status().forecasts_stale);
  EXPECT_EQ(rig.state(), kC);
  rig.during(0.2, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS) << "30 s less the time to slow down";
  EXPECT_EQ(rig.supervisor.status().reason, "the position error reaches its threshold");
}

TEST(StopSupervisor, ForecastIsKeptNoLongerThanItSaysNorPastAStandstill) {
  Rig rig("advise");
  driveTenSeconds(rig);
  rig.forecast(kInfinity, 10.0);
  rig.during(15.0, [&rig] { rig.moving(); });
  EXPECT_FALSE(rig.supervisor.status().forecasts_stale);
  rig.during(0.2, [&rig] { rig.moving(); });
  EXPECT_TRUE(rig.supervisor.status().forecasts_stale);
  rig.forecast(kInfinity, 1000.0);
  rig.during(2.0, [&rig] { rig.standing(1e-5); });
  rig.during(5.2, [&rig] { rig.moving(); });
  EXPECT_TRUE(rig.supervisor.status().forecasts_stale);
  rig.forecast(kInfinity, std::nan(""));
  rig.during(5.2, [&rig] { rig.moving(); });
  EXPECT_TRUE(rig.supervisor.status().forecasts_stale);
}

TEST(StopSupervisor, AStandstillOfTheOperatorsOwnCountsForThePeriod) {
  Rig rig("active");
  rig.during(9.0, [&rig] { rig.moving(); });
  rig.during(30.0, [&rig] { rig.standing(1e-5); });
  EXPECT_EQ(rig.state(), kD);
  EXPECT_EQ(rig.supervisor.status().stops, 0U);
  rig.during(10.0, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kC);
}

}  // namespace
}  // namespace slipnav::test
