/// What holds in every state of the supervisor, whatever happens: nothing moves unasked, and the operator decides.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "supervisor_rig.h"

namespace slipnav::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Everything that can happen, and the state that follows from each situation in the order of situations().
struct Event {
  const char* name;
  std::function<void(Rig&)> happen;
  std::array<StopState, 5> active;
  std::array<StopState, 5> advise;
};

std::vector<Event> events() {
  return {
      {"a moving estimate", [](Rig& r) { r.moving(); }, {kD, kD, kC, kS, kS}, {kD, kD, kC, kS, kD}},
      {"a standing estimate", [](Rig& r) { r.standing(); }, {kD, kD, kC, kH, kH}, {kD, kD, kC, kH, kH}},
      {"a converged standstill",
       [](Rig& r) { r.during(1.0, [&r] { r.standing(1e-5); }); },
       {kD, kD, kD, kD, kD},
       {kD, kD, kD, kD, kD}},
      {"a sliding rover",
       [](Rig& r) { r.during(1.7, [&r] { r.wheelsStandOnly(); }); },
       {kD, kD, kC, kD, kD},
       {kD, kD, kC, kD, kD}},
      {"an old estimate",
       [](Rig& r) { r.supervisor.observe({r.stamp - 1}); },
       {kD, kD, kC, kS, kH},
       {kD, kD, kC, kS, kH}},
      {"a clock that goes back",
       [](Rig& r) {
         r.stamp -= fromSeconds(500.0);
         r.moving();
       },
       {kD, kD, kD, kD, kD},
       {kD, kD, kD, kD, kD}},
      {"a stop time that has come", [](Rig& r) { r.forecast(0.0); }, {kD, kS, kS, kS, kH}, {kD, kS, kS, kS, kH}},
      {"a stop time to come", [](Rig& r) { r.forecast(6.0); }, {kD, kC, kC, kS, kH}, {kD, kC, kC, kS, kH}},
      {"a stop time far away", [](Rig& r) { r.forecast(1e300); }, {kD, kD, kD, kS, kH}, {kD, kD, kD, kS, kH}},
      {"a stop time that has passed",
       [](Rig& r) { r.forecast(-kInfinity); },
       {kD, kS, kS, kS, kH},
       {kD, kS, kS, kS, kH}},
      {"a stop time that is no number", [](Rig& r) { r.forecast(kNan); }, {kD, kD, kC, kS, kH}, {kD, kD, kC, kS, kH}},
      {"a forecast ahead of the estimates",
       [](Rig& r) {
         r.supervisor.setForecast({r.stamp + 1, 0.0});
       },
       {kD, kD, kC, kS, kH},
       {kD, kD, kC, kS, kH}},
      {"an old forecast",
       [](Rig& r) {
         r.supervisor.setForecast({fromSeconds(1000.0), 0.0});
       },
       {kD, kD, kC, kS, kH},
       {kD, kD, kC, kS, kH}},
      {"silence of the forecasts",
       [](Rig& r) { r.during(5.1, [&r] { r.moving(); }); },
       {kD, kS, kS, kS, kD},  // after ten seconds of driving, a periodic stop is due; the stop in progress continues
       {kD, kS, kS, kS, kD}},
      {"silence of the estimates",
       [](Rig& r) { r.supervisor.loseEstimates(); },
       {kD, kD, kD, kS, kD},  // a stop in progress continues
       {kD, kD, kD, kD, kD}},
      {"the operator's wish for a stop",
       [](Rig& r) { r.supervisor.stopNow(); },
       {kD, kS, kS, kS, kH},
       {kD, kS, kS, kS, kH}},
      {"the operator's override",
       [](Rig& r) { r.supervisor.setOverride(true); },
       {kD, kD, kD, kD, kD},
       {kD, kD, kD, kD, kD}},
      {"an emergency stop",
       [](Rig& r) { r.supervisor.setEmergencyStop(true); },
       {kD, kD, kD, kD, kD},
       {kD, kD, kD, kD, kD}},
      {"the end of an override",
       [](Rig& r) { r.supervisor.setOverride(false); },
       {kD, kD, kC, kS, kH},
       {kD, kD, kC, kS, kH}},
      {"a command to drive", [](Rig& r) { r.drive(); }, {kD, kD, kC, kS, kH}, {kD, kD, kC, kS, kH}},
      {"the operator's stop", [](Rig& r) { r.supervisor.command({}); }, {kD, kD, kC, kS, kH}, {kD, kD, kC, kS, kH}},
      {"a command that is not finite",
       [](Rig& r) {
         r.supervisor.command({{kNan, 0.0, 0.0}, {}});
       },
       {kD, kD, kC, kS, kH},
       {kD, kD, kC, kS, kH}},
      {"time without standstill",
       [](Rig& r) {
         r.during(7.0, [&r] {
           r.moving();
           r.forecast(kInfinity);
         });
       },
       {kD, kD, kD, kD, kD},
       {kD, kD, kD, kS, kD}},
      {"time at standstill",
       [](Rig& r) { r.during(3.1, [&r] { r.standing(); }); },
       {kD, kD, kC, kD, kD},
       {kD, kD, kC, kD, kD}},
  };
}

/// What holds in every state: nothing is asked of the rover that the operator does not ask for.
void expectHarmless(Rig& rig, const std::string& trace) {
  SCOPED_TRACE(trace);
  const VelocityCommand out = rig.drive();
  EXPECT_GE(out.linear_mps.x(), 0.0);
  EXPECT_LE(out.linear_mps.x(), kSpeed_mps);
  EXPECT_GE(out.angular_radps.z(), 0.0);
  EXPECT_LE(out.angular_radps.z(), 0.2);
  EXPECT_TRUE(rig.supervisor.command({}).isZero()) << "the operator's stop passes at once";
  EXPECT_TRUE(rig.supervisor.command({{kInfinity, 0.0, 0.0}, {}}).isZero());
  EXPECT_FALSE(rig.supervisor.status().reason.empty());
}

TEST(StopSupervisorSafety, EveryEventInEveryState) {
  const std::vector<Situation> all = situations();
  for (const std::string& mode : {std::string("active"), std::string("advise"), std::string("off")}) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const Event& event : events()) {
        const std::string trace = mode + ": " + event.name + " when " + all[i].name;
        Rig rig(mode);
        all[i].reach(rig);
        ASSERT_EQ(rig.state(), mode == "off" ? kD : all[i].state) << trace;
        event.happen(rig);
        EXPECT_EQ(rig.state(), mode == "off" ? kD : mode == "active" ? event.active[i] : event.advise[i]) << trace;
        expectHarmless(rig, trace);
      }
    }
  }
}

TEST(StopSupervisorSafety, CommandsPassUntouchedUnlessItStopsTheRover) {
  for (const std::string& mode : {std::string("active"), std::string("advise"), std::string("off")}) {
    for (const Situation& situation : situations()) {
      Rig rig(mode);
      situation.reach(rig);
      const bool stops = mode == "active" && rig.state() >= kS;
      rig.moving();
      EXPECT_EQ(equal(rig.drive(), driveOn()), !stops) << mode << ": " << situation.name;
    }
  }
}

TEST(StopSupervisorSafety, TheOperatorsRulesHoldInEveryState) {
  for (const Situation& situation : situations()) {
    Rig rig("active");
    situation.reach(rig);
    rig.supervisor.setOverride(true);
    EXPECT_TRUE(equal(rig.drive(), driveOn())) << situation.name;
    rig.supervisor.setEmergencyStop(true);
    EXPECT_TRUE(rig.drive().isZero()) << situation.name;
    rig.supervisor.setOverride(false);
    rig.during(20.0, [&rig] { rig.moving(); });
    EXPECT_TRUE(rig.drive().isZero()) << situation.name;
    rig.supervisor.setEmergencyStop(false);
    rig.supervisor.setOverride(true);
    EXPECT_TRUE(equal(rig.drive(), driveOn())) << situation.name;
  }
}

TEST(StopSupervisorSafety, WhatTheOperatorHasSaidSurvivesARestartAndAnyChange) {
  for (const std::string& mode : {std::string("active"), std::string("advise"), std::string("off")}) {
    Rig rig(mode);
    rig.supervisor.restore({true, true});
    EXPECT_TRUE(rig.drive().isZero()) << "the first command";
    EXPECT_EQ(rig.supervisor.countdown_s(), 0.0);
    rig.during(20.0, [&rig] { rig.moving(); });
    rig.supervisor.loseEstimates();
    for (const std::string& other : {std::string("off"), std::string("active"), std::string("advise")}) {
      rig.supervisor.retune(Rig::paramsOf(other, 3.0));
      EXPECT_TRUE(rig.drive().isZero());
      EXPECT_TRUE(rig.supervisor.latch().emergency_stop);
      EXPECT_TRUE(rig.supervisor.latch().overridden);
    }
  }
}

TEST(StopSupervisorSafety, AnEmergencyStopEndsWithARampInEveryMode) {
  for (const std::string& mode : {std::string("active"), std::string("advise"), std::string("off")}) {
    Rig rig(mode);
    driveTenSeconds(rig);
    rig.supervisor.setEmergencyStop(true);
    EXPECT_TRUE(rig.drive().isZero());
    rig.supervisor.setEmergencyStop(false);
    EXPECT_TRUE(rig.drive().isZero());
    rig.moving();
    EXPECT_NEAR(rig.drive().linear_mps.x(), 0.05, 1e-9) << mode;
  }
}

}  // namespace
}  // namespace slipnav::test
