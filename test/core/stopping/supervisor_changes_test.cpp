/// Parameters that change while the supervisor works.

#include <gtest/gtest.h>

#include <vector>

#include "supervisor_rig.h"

namespace slipnav::test {
namespace {

TEST(StopSupervisor, OtherTimesHoldFromTheNextEstimateOn) {
  Rig rig("active");
  driveTenSeconds(rig);
  rig.forecast(6.0);
  ASSERT_EQ(rig.state(), kC);
  StopParams params = Rig::paramsOf("active", 3.0);
  params.countdown_s = 1.0;
  rig.supervisor.retune(params);
  EXPECT_EQ(rig.state(), kC);
  rig.moving();
  EXPECT_EQ(rig.state(), kD);
}

TEST(StopSupervisor, AnotherDecelerationHoldsInTheStopThatIsUnderWay) {
  Rig rig("active");
  situations()[3].reach(rig);
  StopParams params = Rig::paramsOf("active", 3.0);
  params.deceleration_mps2 = 1.0;
  rig.supervisor.retune(params);
  rig.drive();
  rig.moving();
  EXPECT_NEAR(rig.drive().linear_mps.x(), kSpeed_mps - 1.0 * toSeconds(kInterval), 1e-9);
}

TEST(StopSupervisor, AnotherModeEndsAStopAndHoldsAtOnce) {
  for (const Situation& situation : situations()) {
    Rig rig("active");
    situation.reach(rig);
    rig.supervisor.retune(Rig::paramsOf("advise", 3.0));
    EXPECT_EQ(rig.supervisor.mode(), StopMode::kAdvise);
    EXPECT_LT(rig.state(), kS) << situation.name;
    EXPECT_TRUE(equal(rig.drive(), driveOn())) << situation.name;
    rig.supervisor.retune(Rig::paramsOf("off", 3.0));
    EXPECT_EQ(rig.supervisor.status().reason, "the supervisor is off") << situation.name;
    EXPECT_TRUE(equal(rig.drive(), driveOn())) << situation.name;
  }
}

TEST(StopSupervisor, OneThatBecomesActiveStopsTheRover) {
  Rig rig("off");
  driveTenSeconds(rig);
  rig.forecast(0.0);
  ASSERT_EQ(rig.state(), kD);
  rig.supervisor.retune(Rig::paramsOf("active", 3.0));
  rig.forecast(0.0);
  EXPECT_EQ(rig.state(), kS);
  rig.during(1.0, [&rig] { rig.moving(); });
  EXPECT_LT(rig.drive().linear_mps.x(), kSpeed_mps);
}

/// In every state: what was observed and forecast before is of another time.
TEST(StopSupervisor, AfterTheClockHasGoneBackItIsLikeANewOne) {
  std::vector<Situation> all = situations();
  all.push_back({"having given a stop up", kD, [](Rig& rig) {
                   situations()[3].reach(rig);
                   rig.during(5.0, [&rig] { rig.wheelsStandOnly(); });
                 }});
  for (const Situation& situation : all) {
    Rig rig("advise");
    situation.reach(rig);
    ASSERT_EQ(rig.state(), situation.state) << situation.name;
    rig.stamp -= fromSeconds(500.0);
    Rig fresh("advise");
    fresh.stamp = rig.stamp;
    for (int i = 0; i < 300; ++i) {
      for (Rig* each : {&rig, &fresh}) {
        i < 200 ? each->moving() : each->wheelsStandOnly();
        if (i % 10 == 0 && i > 80) {
          each->forecast(25.0 - 0.1 * i);
        }
      }
      const SupervisorStatus& status = rig.supervisor.status();
      const SupervisorStatus& expected = fresh.supervisor.status();
      ASSERT_EQ(status.state, expected.state) << situation.name << " " << i;
      ASSERT_EQ(status.time_left_s, expected.time_left_s) << situation.name << " " << i;
      ASSERT_EQ(status.reason, expected.reason) << situation.name << " " << i;
      ASSERT_EQ(status.stops, expected.stops) << situation.name << " " << i;
      ASSERT_EQ(status.refusals, expected.refusals) << situation.name << " " << i;
      ASSERT_EQ(status.forecasts_stale, expected.forecasts_stale) << situation.name << " " << i;
    }
  }
}

}  // namespace
}  // namespace slipnav::test
