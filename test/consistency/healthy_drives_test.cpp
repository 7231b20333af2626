/// Diagnostics that warn on good drives are not read on bad ones.

#include <gtest/gtest.h>

#include <string>

#include "evaluation/alarm_text.h"
#include "evaluation/simulated_run.h"

namespace slipnav {
namespace {

constexpr double kDistance_m = 150.0;

class HealthyDrives : public ::testing::TestWithParam<int> {};

TEST_P(HealthyDrives, NothingIsReported) {
  const char* const terrains[] = {"paved", "unpaved", "gravel", "rough", "rough"};
  Config config;
  config.simulator.seed = GetParam();
  config.simulator.terrain = terrains[GetParam() % 5];
  config.simulator.drive.distance_m = kDistance_m;
  const auto policy = makeStopPolicy("periodic:30:3", config.stop);
  const SimulationReport report = simulateAndMeasure(config, *policy, {}, false);
  EXPECT_TRUE(report.figures.alarms.empty())
      << config.simulator.terrain << "\n"
      << alarmLines("  ", report.figures.alarms, fromSeconds(config.simulator.start_time_s));
}

INSTANTIATE_TEST_SUITE_P(Seeds, HealthyDrives, ::testing::Range(1, 11));

}  // namespace
}  // namespace slipnav
