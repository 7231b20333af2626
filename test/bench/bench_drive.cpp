#include "bench_drive.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "evaluation/simulated_drive.h"
#include "slipnav/core/navigation/pipeline.h"
#include "support/gp_golden.h"

namespace slipnav::bench {
namespace {

constexpr double kLongestDrive_s = 915.0;  // of the paper
constexpr double kInterval_s = 0.1;

Config longDriveConfig() {
  Config config;
  config.simulator.drive.distance_m = 2.0 * kLongestDrive_s * config.simulator.drive.speed_mps;
  return config;
}

std::vector<sim::Measurements> simulateLongDrive() {
  SimulatedDrive drive(config().simulator, Planet::byName(config().planet));
  std::vector<sim::Measurements> samples;
  const Nanoseconds begin = drive.truth().stamp;
  while (toSeconds(drive.truth().stamp - begin) < kLongestDrive_s) {
    samples.push_back(drive.execute(drive.operatorCommand()));
  }
  return samples;
}

std::vector<FilterOutput> filterLongDrive() {
  std::vector<FilterOutput> outputs;
  const auto collect = [&outputs](const Estimate& estimate, const ErrorCovariance& P) {
    if (estimate.has_wheels) {
      outputs.push_back({estimate, P});
    }
  };
  Pipeline pipeline(Planet::byName(config().planet), config().navigation(), collect);
  const WheelGeometry geometry = config().wheelGeometry();
  for (const sim::Measurements& sample : longDrive()) {
    pushMeasurements(sample, geometry, pipeline);
  }
  return outputs;
}

}  // namespace

const Config& config() {
  static const Config config = longDriveConfig();
  return config;
}

const std::vector<sim::Measurements>& longDrive() {
  static const std::vector<sim::Measurements> samples = simulateLongDrive();
  return samples;
}

const std::vector<FilterOutput>& filterOutputs() {
  static const std::vector<FilterOutput> outputs = filterLongDrive();
  return outputs;
}

SlipSamples realSlip(std::size_t count) {
  const std::vector<double> slips = readGpSlip().slips;
  const std::size_t period = 2 * slips.size() - 1;  // odd: windows that slide by 1 s are all different
  SlipSamples samples;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t phase = i % period;
    samples.times_s.push_back(kInterval_s * static_cast<double>(i));
    samples.slips.push_back(slips[phase < slips.size() ? phase : period - phase]);
  }
  return samples;
}

SlipSamples windowOf(const SlipSamples& recording, std::size_t start, std::size_t count) {
  const auto from = static_cast<std::ptrdiff_t>(start);
  const auto to = static_cast<std::ptrdiff_t>(start + count);
  return {{recording.times_s.begin() + from, recording.times_s.begin() + to},
          {recording.slips.begin() + from, recording.slips.begin() + to},
          {}};
}

double percentile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

double threadTime_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace slipnav::bench
