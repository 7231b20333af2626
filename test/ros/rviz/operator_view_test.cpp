#include "ros/rviz/operator_view.h"

#include <gtest/gtest.h>

#include <limits>

namespace slipnav {
namespace {

class OperatorViewTest : public ::testing::Test {
 protected:
  StopStatus stopAt(std::uint8_t state, double time_left_s = std::numeric_limits<double>::infinity()) {
    StopStatus stop;
    stop.mode = StopStatus::MODE_ACTIVE;
    stop.state = state;
    stop.time_left_s = time_left_s;
    stop.reason = "why";
    return stop;
  }

  OperatorView view_;
};

TEST_F(OperatorViewTest, EveryState) {
  EXPECT_EQ(view_.picture(0.0).state, "NO DATA");
  view_.take(stopAt(StopStatus::DRIVING, 34.2), 0.0);
  EXPECT_EQ(view_.picture(0.0).state, "DRIVING");
  EXPECT_EQ(view_.picture(0.0).countdown, "stop in 34 s");
  EXPECT_EQ(view_.picture(0.0).reason, "why");
  EXPECT_EQ(view_.picture(0.0).mode, StopStatus::MODE_ACTIVE);
  view_.take(stopAt(StopStatus::COUNTING_DOWN, 4.0), 0.0);
  EXPECT_EQ(view_.picture(0.0).state, "STOP AHEAD");
  view_.take(stopAt(StopStatus::STOPPING, 0.0), 0.0);
  EXPECT_EQ(view_.picture(0.0).state, "STOPPING");
  EXPECT_EQ(view_.picture(0.0).countdown, "");
  view_.take(stopAt(StopStatus::HOLDING, 2.0), 0.0);
  EXPECT_EQ(view_.picture(0.0).countdown, "at most 2 s more");
}

TEST_F(OperatorViewTest, AnEmergencyStopAndAnOverrideHaveNoCountdown) {
  StopStatus stop = stopAt(StopStatus::DRIVING, 34.0);
  stop.overridden = 1;
  view_.take(stop, 0.0);
  EXPECT_EQ(view_.picture(0.0).state, "OVERRIDE");
  EXPECT_EQ(view_.picture(0.0).countdown, "");
  stop.emergency_stop = 1;
  view_.take(stop, 0.0);
  EXPECT_EQ(view_.picture(0.0).state, "EMERGENCY STOP");
  EXPECT_EQ(view_.picture(0.0).mood, Mood::kDanger);
  EXPECT_EQ(view_.picture(0.0).countdown, "");
}

TEST_F(OperatorViewTest, NothingStaleIsShown) {
  Slip slip;
  slip.mean_ratio = 0.12;
  slip.forward_speed_mps = 0.5;
  slip.duration_s = 0.1;
  ErrorForecast forecast;
  forecast.horizontal_bound_m = {0.4, 0.5};
  forecast.threshold_m = 3.0;
  view_.take(stopAt(StopStatus::DRIVING, 30.0), 0.0);
  view_.take(slip, 0.0);
  view_.take(forecast, 0.0);
  EXPECT_EQ(view_.picture(1.0).slip, "12 %");
  EXPECT_EQ(view_.picture(1.0).bound_m, 0.4);
  const OperatorPicture stale = view_.picture(10.0);
  EXPECT_EQ(stale.state, "NO DATA");
  EXPECT_TRUE(stale.countdown.empty());
  EXPECT_TRUE(stale.slip.empty());
  EXPECT_TRUE(stale.since_stop.empty());
  EXPECT_FALSE(stale.bound_m.has_value());
  EXPECT_EQ(stale.history.size(), 1U);
}

TEST_F(OperatorViewTest, TheStartSaysWhatItWaitsFor) {
  Initialization start;
  start.progress = "waiting for gps/fix";
  view_.take(start, 0.0);
  EXPECT_FALSE(view_.picture(0.0).mode.has_value()) << "nobody has said it";
  view_.take(stopAt(StopStatus::DRIVING), 100.0);
  EXPECT_EQ(view_.picture(100.0).state, "START");
  EXPECT_EQ(view_.picture(100.0).reason, "waiting for gps/fix");
  start.done = 1;
  view_.take(start, 100.0);
  EXPECT_EQ(view_.picture(100.0).state, "DRIVING");
}

/// Its progress is latched: it stays when the process that wrote it has ended.
TEST_F(OperatorViewTest, AStartEndsWithItsNodelet) {
  Initialization start;
  start.progress = "waiting for a standstill";
  view_.take(start, 0.0);
  EXPECT_EQ(view_.picture(100.0).state, "START") << "nobody has reported to the diagnostics";
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(1);
  array.status[0].name = "slipnav_manager: /rover/initializer";
  view_.take(array, 100.0);
  EXPECT_EQ(view_.picture(101.0).state, "START");
  EXPECT_EQ(view_.picture(105.0).state, "NO DATA");
  view_.take(array, 110.0);
  EXPECT_EQ(view_.picture(110.0).state, "START");
}

TEST_F(OperatorViewTest, TheWorstAlarmComesFirstAndSilenceIsOne) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(3);
  array.status[0].name = "filter: /filter";
  array.status[0].level = diagnostic_msgs::DiagnosticStatus::WARN;
  array.status[0].message = "wheels silent";
  array.status[1].name = "ins: /ins";
  array.status[1].message = "mechanizing";
  array.status[2].name = "stop_supervisor: /stop_supervisor";
  array.status[2].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  array.status[2].message = "emergency stop without effect";
  view_.take(array, 0.0);
  const OperatorPicture picture = view_.picture(1.0);
  ASSERT_EQ(picture.alarms.size(), 2U);
  EXPECT_EQ(picture.alarms[0].words, "stop_supervisor: emergency stop without effect");
  EXPECT_EQ(picture.alarms[1].words, "filter: wheels silent");
  EXPECT_EQ(view_.picture(9.0).alarms.size(), 3U);
  EXPECT_EQ(view_.picture(9.0).alarms[1].words, "ins: has stopped reporting");
}

TEST_F(OperatorViewTest, FiguresOfTheDriveGoWithTheirSource) {
  std_msgs::String figures;
  figures.data = "distance 3.0 m";
  view_.take(figures, 0.0);
  EXPECT_EQ(view_.picture(1.0).figures, "distance 3.0 m");
  EXPECT_EQ(view_.picture(9.0).figures, "");
}

TEST_F(OperatorViewTest, TheWaySinceTheStopBeginsAtStandstill) {
  Slip slip;
  slip.forward_speed_mps = -1.0;
  slip.duration_s = 0.5;
  for (int i = 0; i < 5; ++i) {
    view_.take(slip, 0.0);
  }
  EXPECT_EQ(view_.picture(0.0).since_stop, "2.5 m");
  slip.stationary = 1;
  view_.take(slip, 0.0);
  EXPECT_EQ(view_.picture(0.0).since_stop, "0.0 m");
}

}  // namespace
}  // namespace slipnav
