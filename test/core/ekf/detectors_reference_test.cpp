/// Whatever judges wheels and IMU beside the filter, under random motion on a clock of tenths of a second: no change of
/// a verdict goes without being noticed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/stopping/obedience_watch.h"
#include "core/stopping/standstill.h"
#include "reference_trace.h"
#include "slipnav/core/ekf/adaptation/slipping_speed.h"
#include "slipnav/core/ekf/engine/lasting_slip.h"
#include "slipnav/core/ekf/engine/runaway_watch.h"
#include "slipnav/core/ekf/stationary_detector.h"
#include "slipnav/core/ekf/stuck_detector.h"
#include "slipnav/core/sensors/wheel_monitor.h"

namespace slipnav::test {
namespace {

constexpr int kLines = 60;
constexpr int kEventsPerLine = 15;
constexpr Nanoseconds kTenth = kSecond / 10;

/// Every wheel turns as fast as the others, or as another one would.
TEST(DetectorsReference, FaultsOfWheels) {
  ReferenceTrace trace("wheel_monitor");
  Dice dice(1);
  WheelMonitor monitor(WheelMonitorParams{}, pathfinderWheels());
  Nanoseconds stamp = 0;
  std::array<double, kMaxWheels> off_mps = {};
  for (int line = 0; line < kLines; ++line) {
    double sound_mps = 0.0;
    std::size_t faulty = 0;
    for (int i = 0; i < kEventsPerLine; ++i) {
      stamp += kTenth;
      off_mps[static_cast<std::size_t>(dice.roll(4))] = dice.oneIn(5) ? dice.from<double>({0.0, 0.0, 0.6, -0.5}) : 0.0;
      off_mps[1] = line % 4 == 3 ? -0.8 : off_mps[1];
      off_mps[2] = line % 8 == 7 ? 0.9 : off_mps[2];
      const double yaw_rate_radps = dice.from<double>({0.0, 0.5});
      std::array<double, kMaxWheels> speed_mps = {};
      for (std::size_t wheel = 0; wheel < 4; ++wheel) {
        speed_mps[wheel] = 0.8 + yaw_rate_radps * pathfinderWheels()[wheel].y_m + off_mps[wheel];
      }
      monitor.add(stamp, speed_mps, yaw_rate_radps);
      sound_mps += monitor.soundSpeed();
      faulty += monitor.faultyCount() + (monitor.isUsable() ? 10 : 0);
    }
    trace.note(sound_mps, faulty);
    if (line % 20 == 19) {
      monitor.reset();
    }
  }
  trace.compare();
}

TEST(DetectorsReference, StandstillOfWheelsThatSpin) {
  ReferenceTrace trace("stuck_detector");
  Dice dice(2);
  StuckDetector stuck;
  LastingSlip lasting;
  SlippingSpeed slipping;
  SpinEvidence evidence;
  for (int line = 0; line < kLines; ++line) {
    int verdicts = 0;
    int lasted = 0;
    double speed_mps = 0.0;
    for (int i = 0; i < kEventsPerLine; ++i) {
      evidence.stamp += kTenth;
      evidence.level_of_rest = !dice.oneIn(20);
      evidence.calmer_than_driving = !dice.oneIn(20);
      evidence.forward_mps = dice.from<double>({0.1, -0.1, 0.1875, dice.oneIn(9) ? 0.3125 : 0.0});
      evidence.forward_std_mps = dice.from<double>({0.0, 0.03125});
      evidence.wheels_mps = dice.from<double>({0.75, 0.75, -0.75, 0.5});
      verdicts = 2 * (verdicts % 10000) + (stuck.judge(evidence) ? 1 : 0) + (stuck.isSuspected() ? 3 : 0);
      const double slip = line % 3 == 0 ? dice.from<double>({0.75, 0.25, -0.75}) : 0.5 * (line % 3) - 0.75;
      lasted += lasting.add(slip, 0.0625, 0.25, 0.5) ? 1 : 0;
      slipping.add(evidence.stamp, evidence.wheels_mps + 0.25 * dice.roll(4));
      speed_mps += slipping.value();
    }
    trace.note(verdicts, lasted, speed_mps);
    if (line % 20 == 19) {
      stuck.reset();
      lasting.reset();
      slipping.reset();
    }
  }
  trace.compare();
}

TEST(DetectorsReference, EstimatesThatRunAwayAndRoversThatDoNotObey) {
  ReferenceTrace trace("runaway_watch");
  Dice dice(3);
  RunawayWatch runaway;
  ObedienceWatch obedience;
  Standstill standstill;
  Nanoseconds stamp = 100 * kSecond;
  for (int line = 0; line < kLines; ++line) {
    int verdicts = 0;
    double way_m = 0.0;
    double rest_s = 0.0;
    const double wheels_mps = dice.from<double>({0.0, 0.03125, 0.5, 1.0});
    const double speed_mps = dice.from<double>({0.0625, 0.25, 1.0, 2.0, 2.125, 9.0});
    for (int i = 0; i < kEventsPerLine; ++i) {
      stamp += dice.oneIn(40) ? -5 * kTenth : kTenth;
      runaway.addImu({dice.normal(), dice.normal(), -9.8}, dice.from<double>({0.125, 0.25, 6.0}));
      const double backward_mps = dice.from<double>({-1.0, -1.0, 0.0625, 0.25, 0.3125});
      const bool away = runaway.addWheels(stamp, wheels_mps, dice.oneIn(15) ? 0.0 : speed_mps, backward_mps, 0.125);
      const bool rests = line % 2 == 0 && !dice.oneIn(12);
      const RoverObservation seen{
          stamp, dice.from<double>({0.65, -0.65, 0.9}), 0.1, rests && line % 4 == 0, !dice.oneIn(3), rests};
      obedience.observe(dice.oneIn(30) ? std::nullopt : std::optional<double>(0.5), seen);
      standstill.observe(seen);
      verdicts += (away ? 1 : 0) + (obedience.isIgnored() ? 100 : 0) + 1000 * standstill.zeroUpdates();
      way_m += runaway.wayBeyond_m();
      rest_s += standstill.unacceptedRest_s();
    }
    trace.note(verdicts, way_m, rest_s, runaway.fastest_mps(), runaway.levelStd_rad(9.8), runaway.level().x(),
               runaway.level().y());
    if (line % 10 == 9) {
      runaway.reset();
      trace.note(runaway.levelStd_rad(9.8), runaway.wayBeyond_m());
    }
  }
  trace.compare();
}

/// A rover that drives over several grounds, stands with and without an engine running, and slides.
TEST(DetectorsReference, Standstill) {
  ReferenceTrace trace("stationary_detector");
  Dice dice(4);
  ImuFloor floor;
  floor.accel_density = 1e-5;
  floor.gyro_density = 1e-9;
  floor.accel_bias_std = 0.01;
  floor.gyro_bias_std = 1e-4;
  StationaryDetector detector(StationaryParams{}, floor);
  Nanoseconds stamp = 0;
  for (int line = 0; line < 2 * kLines; ++line) {
    const double wheels_mps = dice.from<double>({0.0, 0.0, 0.0005, 0.003, 0.5, 0.5});
    const double shaking = dice.from<double>({0.004, 0.01, 0.03, 0.08, 0.3, 1.0});
    const double off = dice.oneIn(8) ? 0.8 : 0.0;
    int verdicts = 0;
    for (int i = 0; i < 75; ++i) {
      stamp += kSecond / 50;
      detector.addImu(stamp, {off + shaking * dice.normal(), shaking * dice.normal(), shaking * dice.normal() - 9.8},
                      {0.1 * shaking * dice.normal(), 0.1 * shaking * dice.normal(), 0.1 * off});
      if (i % 5 == 4) {
        detector.addWheels(stamp, wheels_mps, dice.from<double>({0.0, 0.004, 0.01}));
        const int verdict = (detector.judge(9.8, !dice.oneIn(5)) ? 1 : 0) + (detector.wheelsAtRest() ? 2 : 0) +
                            (detector.hasLevelOfRest(9.8) ? 4 : 0) + (detector.isCalmerThanDriving(false) ? 8 : 0) +
                            (detector.isCalmerThanDriving(true) ? 16 : 0);
        verdicts = 3 * (verdicts % 10000) + verdict;
      }
    }
    const StationaryDetector::Window window = detector.window();
    trace.note(verdicts, window.accel_variance, window.gyro_variance, window.period_s, window.filled);
    if (line % 40 == 39) {
      detector.reset();
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
