#include "core/stopping/stop_verdict.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

class StopVerdictTest : public ::testing::Test {
 protected:
  void expect(StopConcern concern, const std::string& words) const {
    const StopVerdict verdict = judgeStops(status_, mode_, signs_);
    EXPECT_EQ(verdict.concern, concern) << words;
    EXPECT_EQ(verdict.words, words);
  }

  SupervisorStatus status_;
  StopMode mode_ = StopMode::kActive;
  StopSigns signs_;
};

TEST_F(StopVerdictTest, TheReasonStandsWhereNothingIsWrong) {
  status_.reason = "driving for the first time";
  expect(StopConcern::kNone, "driving for the first time");
}

/// Each added sign is worse than those before.
TEST_F(StopVerdictTest, TheWorstComesFirst) {
  signs_.forecaster_silent = true;
  expect(StopConcern::kProblem, "no forecasts: periodic stops");
  signs_.commands_silent = true;
  expect(StopConcern::kProblem, "cmd_vel_in is silent");
  signs_.commands_unheard = true;
  expect(StopConcern::kProblem, "nobody listens to cmd_vel");
  signs_.estimates_missing = true;
  expect(StopConcern::kProblem, "no estimates");
  status_.emergency_stop = true;
  expect(StopConcern::kProblem, "emergency stop");
  signs_.rivals = "/a and /b";
  expect(StopConcern::kDanger, "more than one node publishes nav_state: /a and /b");
  signs_.not_kept = "the disk is full";
  expect(StopConcern::kDanger, "emergency stop and override are not kept: the disk is full");
  signs_.ignored = true;
  expect(StopConcern::kDanger, "the rover keeps driving although it is told to stop");
  signs_.unheard = "nobody listens to cmd_vel or e_stop";
  expect(StopConcern::kDanger, "emergency stop without effect: nobody listens to cmd_vel or e_stop");
}

TEST_F(StopVerdictTest, StaleForecastsAreAProblemAsWell) {
  status_.forecasts_stale = true;
  expect(StopConcern::kProblem, "no forecasts: periodic stops");
}

TEST_F(StopVerdictTest, OneThatIsOffHasNoProblemsButDangers) {
  mode_ = StopMode::kOff;
  signs_.estimates_missing = signs_.commands_silent = signs_.commands_unheard = true;
  expect(StopConcern::kNone, "");
  signs_.not_kept = "the disk is full";
  expect(StopConcern::kDanger, "emergency stop and override are not kept: the disk is full");
}

TEST_F(StopVerdictTest, WhoOnlyAdvisesNeedsNoListener) {
  mode_ = StopMode::kAdvise;
  signs_.commands_unheard = true;
  expect(StopConcern::kNone, "");
}

}  // namespace
}  // namespace slipnav
