#include "ros/runtime/health_report.h"

#include <gtest/gtest.h>

#include "config/config.h"
#include "ros/runtime/fit_to_drive.h"
#include "ros/runtime/sensor_watch.h"

namespace slipnav {
namespace {

using diagnostic_msgs::DiagnosticStatus;

std::string messageAt(HealthReport& report, const HealthMonitor& health, double now_s) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  status.summary(DiagnosticStatus::OK, "fine");
  report.add(health, now_s, status);
  return status.message;
}

TEST(HealthReport, AlarmsEndWithTheirCauseWhateverTheStampsDo) {
  HealthMonitor health(Config().navigation().filter);
  HealthReport report;
  EXPECT_EQ(messageAt(report, health, 100.0), "fine");
  health.note("something", 10 * kSecond);
  EXPECT_EQ(messageAt(report, health, 100.4), "something");
  EXPECT_EQ(messageAt(report, health, 100.9), "something");
  EXPECT_EQ(messageAt(report, health, 101.5), "fine") << "although no later stamp has come";
  health.note("something", 10 * kSecond);
  EXPECT_EQ(messageAt(report, health, 102.0), "something");
}

TEST(SensorWatch, TellsSilenceFromWhatCannotBeUsed) {
  SensorWatch watch("IMU", 0.5);
  EXPECT_EQ(watch.problem("imu", {10.0, 10.0}), "") << "nothing has been heard";
  watch.used({10.0, 10.0});
  EXPECT_EQ(watch.problem("imu", {10.4, 10.4}), "");
  EXPECT_EQ(watch.problem("imu", {10.6, 10.6}), "IMU silent: nothing usable on imu");
  EXPECT_EQ(watch.problem("imu", {10.0, 10.6}), "") << "time stands still, as in a recording that pauses";
  watch.refused("NaN", {10.6, 10.6});
  EXPECT_EQ(watch.problem("imu", {10.7, 10.7}), "no usable samples of IMU: NaN");
  watch.used({10.8, 10.8});
  EXPECT_EQ(watch.problem("imu", {10.9, 10.9}), "");
}

TEST(SensorWatch, SaysWhyNothingHasEverBeenOfUse) {
  SensorWatch watch("wheels", 0.5);
  for (double t_s = 5.0; t_s < 6.0; t_s += 0.1) {
    watch.refused("misnamed", {t_s, t_s});
  }
  EXPECT_EQ(watch.problem("joints", {6.0, 6.0}), "no usable samples of wheels: misnamed");
}

diagnostic_msgs::DiagnosticArray said(const std::string& name, int level, const std::string& message,
                                      const std::string& hardware = kHardwareId) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(1);
  array.status[0].name = name;
  array.status[0].level = static_cast<signed char>(level);
  array.status[0].message = message;
  array.status[0].hardware_id = hardware;
  return array;
}

TEST(FitToDrive, SumsUpTheWorstFirst) {
  FitToDrive fit("/");
  EXPECT_EQ(fit.verdict(0.0).level, DiagnosticStatus::WARN);
  fit.take(said("manager: /ins", DiagnosticStatus::OK, "mechanizing"), 0.0);
  fit.take(said("manager: /filter", DiagnosticStatus::OK, "running"), 0.0);
  EXPECT_EQ(fit.verdict(1.0).level, DiagnosticStatus::OK);
  EXPECT_EQ(fit.verdict(1.0).message, "fit to drive");
  fit.take(said("manager: /filter", DiagnosticStatus::WARN, "IMU gap"), 1.0);
  EXPECT_EQ(fit.verdict(1.0).level, DiagnosticStatus::WARN);
  EXPECT_EQ(fit.verdict(1.0).message, "fit to drive with limits: filter: IMU gap");
  fit.take(said("manager: /forecast", DiagnosticStatus::STALE, "estimates have stopped"), 1.0);
  fit.take(said("manager: /ins", DiagnosticStatus::ERROR, "IMU silent"), 1.0);
  EXPECT_EQ(fit.verdict(1.0).level, DiagnosticStatus::ERROR);
  EXPECT_EQ(fit.verdict(1.0).message,
            "not fit to drive: ins: IMU silent; forecast: estimates have stopped; filter: IMU gap");
}

TEST(FitToDrive, ANodeletThatFallsSilentIsAnError) {
  FitToDrive fit("/");
  fit.take(said("manager: /ins", DiagnosticStatus::OK, "mechanizing"), 0.0);
  EXPECT_EQ(fit.verdict(1.9).level, DiagnosticStatus::OK);
  EXPECT_EQ(fit.verdict(2.1).level, DiagnosticStatus::ERROR);
  EXPECT_EQ(fit.verdict(2.1).message, "not fit to drive: ins has stopped reporting");
}

TEST(FitToDrive, OthersDoNotCount) {
  FitToDrive fit("/a");
  EXPECT_EQ(fit.name(), "/a/fit to drive");
  fit.take(said("manager: /a/ins", DiagnosticStatus::OK, "mechanizing"), 0.0);
  fit.take(said("manager: /b/ins", DiagnosticStatus::ERROR, "another rover"), 0.0);
  fit.take(said("manager: /a/camera", DiagnosticStatus::ERROR, "not of this package", "none"), 0.0);
  fit.take(said("manager: /a/fit to drive", DiagnosticStatus::ERROR, "itself"), 0.0);
  EXPECT_EQ(fit.verdict(0.0).level, DiagnosticStatus::OK) << fit.verdict(0.0).message;
}

}  // namespace
}  // namespace slipnav
