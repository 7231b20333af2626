/// The results of a few drives, to the sixth digit: no change of the code changes an estimate, a forecast or a stop
/// without being noticed. Where it is meant to, the differences say what it does, and
/// `SLIPNAV_WRITE_REFERENCE=1 build/devel/lib/slipnav/slipnav_unit_tests --gtest_filter='*ReferenceDrives*'` writes the
/// new results to test/golden/drives.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "config/override.h"
#include "evaluation/simulated_run.h"
#include "simulation/world_files.h"

namespace slipnav::test {
namespace {

/// Relative. Compilers differ in the last digits.
constexpr double kTolerance = 1e-6;
constexpr int kDigits = 10;

/// One part of what can happen to a rover in each, in the shortest drive in which it does.
struct ReferenceDrive {
  const char* name;
  const char* world;
  const char* grade;
  const char* policy;
  std::vector<const char*> settings;
};

const std::vector<ReferenceDrive>& referenceDrives() {
  static const std::vector<ReferenceDrive> kDrives = {
      {"autonomous", "rough", "tactical", "autonomous", {"forecast.threshold_m=1", "simulator.drive.distance_m=50"}},
      {"changing_ground", "transitions", "tactical", "periodic:25:2", {"simulator.drive.distance_m=70"}},
      {"small_sensor", "host_bursts", "mems", "periodic:20:3", {"simulator.drive.distance_m=30"}},
      {"sand", "sand", "tactical", "none", {"simulator.drive.distance_m=60"}},
      {"stuck", "stuck_20s", "tactical", "none", {"simulator.drive.distance_m=25", "simulator.drive.stuck_after_m=12"}},
      {"dead_encoder",
       "dead_encoder",
       "phone",
       "periodic:20:3",
       {"simulator.drive.distance_m=30", "simulator.encoder.dead_after_s=70"}},
      {"satellites",
       "unpaved",
       "tactical",
       "none",
       {"gnss.use=always", "simulator.gps.outlier_part=0.2", "simulator.gps.outlier_m=30",
        "simulator.drive.distance_m=30"}},
      {"skid_steer", "skid_steer", "mems", "none", {"simulator.drive.distance_m=30"}},
      {"crawl", "slow", "tactical", "autonomous", {"simulator.drive.distance_m=1", "forecast.threshold_m=0.05"}},
      {"paper_method",
       "rough",
       "tactical",
       "autonomous",
       {"forecast.schedule=paper", "forecast.bound=absolute", "stop.forecast_timeout_s=60", "forecast.threshold_m=1",
        "simulator.drive.distance_m=40"}},
      {"dense_process",
       "soft_patches",
       "tactical",
       "autonomous",
       {"forecast.inference=dense", "forecast.threshold_m=1", "simulator.drive.distance_m=25"}},
  };
  return kDrives;
}

using Figures = std::map<std::string, double>;

void addTrack(const EstimateTrack& track, Figures& figures) {
  for (const EstimateSample& sample : track) {
    figures["track.sigma_m"] += std::sqrt(sample.covariance_enu_m2.trace());
    figures["track.speed_mps"] += sample.speed_mps;
  }
}

void addFilter(const std::vector<FilterRow>& rows, Figures& figures) {
  for (const FilterRow& row : rows) {
    figures["filter.accel_bias_mps2"] += row.accel_bias_flu_mps2.norm();
    figures["filter.accel_sigma_mps2"] += row.accel_sigma_mps2.norm();
    figures["filter.gyro_bias_radps"] += row.gyro_bias_flu_radps.norm();
    figures["filter.gyro_sigma_radps"] += row.gyro_sigma_radps.norm();
    for (std::size_t kind = 0; kind < row.nis.size(); ++kind) {
      figures[std::string("filter.nis.") + componentName(static_cast<Component>(kind))] += row.nis[kind].value_or(0.0);
    }
  }
}

void addForecasts(const RunReport& run, Figures& figures) {
  for (const ForecastRow& row : run.forecasts) {
    figures["forecast.bound_m"] += row.horizontal_bound_m;
    figures["forecast.time_to_stop_s"] += row.time_to_stop_s.value_or(0.0);
  }
  for (const SlipForecastRow& row : run.diagnostics.slip_forecasts) {
    figures["forecast.slip"] += row.mean;
    figures["forecast.slip_sigma"] += row.stddev;
  }
}

/// Sums over the drive, and what it came to.
Figures figuresOf(const SimulationReport& report) {
  const Metrics& metrics = report.run.metrics;
  Figures figures;
  figures["duration_s"] = metrics.duration_s;
  figures["stops"] = static_cast<double>(metrics.stop_count);
  figures["samples.rejected"] = static_cast<double>(metrics.rejected_samples);
  figures["error.enu_pct"] = metrics.enu_error_pct.value_or(-1.0);
  figures["error.final_m"] = metrics.horizontal_final_m.value_or(-1.0);
  figures["error.up_m"] = metrics.rms_up_m.value_or(-1.0);
  figures["error.position_nees"] = metrics.position_nees_mean.value_or(-1.0);
  figures["end.attitude_nees"] = report.figures.nees_end_attitude.value_or(-1.0);
  figures["end.velocity_nees"] = report.figures.nees_end_velocity.value_or(-1.0);
  figures["end.position_nees"] = report.figures.nees_end_position.value_or(-1.0);
  figures["largest_speed_mps"] = report.figures.largest_speed_mps;
  figures["stops.used"] = static_cast<double>(report.figures.stops_used);
  for (const auto& alarm : report.figures.alarms) {
    figures["alarm." + alarm.first] = static_cast<double>(alarm.second.count);
  }
  addTrack(report.run.estimates, figures);
  addFilter(report.run.diagnostics.filter, figures);
  addForecasts(report.run, figures);
  return figures;
}

SimulationReport drive(const ReferenceDrive& reference) {
  const std::string folder = SLIPNAV_SOURCE_DIR "/config/";
  std::vector<Override> settings;
  for (const char* setting : reference.settings) {
    settings.push_back(keyOverride(setting));
  }
  const Config config = Config::load({sim::configurationNamed(reference.grade, folder + "grades", "grade"),
                                      sim::configurationNamed(reference.world, folder + "worlds", "world")},
                                     settings);
  const std::unique_ptr<StopPolicy> policy = makeStopPolicy(reference.policy, config.stop);
  return simulateAndMeasure(config, *policy);
}

std::string fileOf(const ReferenceDrive& reference) {
  return std::string(SLIPNAV_SOURCE_DIR "/test/golden/drives/") + reference.name + ".csv";
}

/// Lines "value,figure"; names of alarms contain commas.
Figures read(const std::string& path) {
  Figures figures;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t comma = line.find(',');
    figures[line.substr(comma + 1)] = std::stod(line.substr(0, comma));
  }
  return figures;
}

void write(const Figures& figures, const std::string& path) {
  std::ofstream file(path);
  file.precision(kDigits);
  for (const auto& figure : figures) {
    file << figure.second << ',' << figure.first << '\n';
  }
}

class ReferenceDrives : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ReferenceDrives, HaveTheSameResults) {
  const ReferenceDrive& reference = referenceDrives()[GetParam()];
  const Figures found = figuresOf(drive(reference));
  if (std::getenv("SLIPNAV_WRITE_REFERENCE") != nullptr) {
    write(found, fileOf(reference));
  }
  const Figures expected = read(fileOf(reference));
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& figure : expected) {
    const auto same = found.find(figure.first);
    ASSERT_NE(same, found.end()) << figure.first;
    EXPECT_NEAR(same->second, figure.second, kTolerance * (std::abs(figure.second) + kTolerance)) << figure.first;
  }
}

INSTANTIATE_TEST_SUITE_P(Drives, ReferenceDrives, ::testing::Range(std::size_t{0}, referenceDrives().size()),
                         [](const auto& index) { return std::string(referenceDrives()[index.param].name); });

}  // namespace
}  // namespace slipnav::test
