#include "evaluation/simulated_run.h"

#include <algorithm>
#include <limits>

namespace slipnav {
namespace {

/// How much a stamp may be before the instant at which the sample was taken.
Nanoseconds earliness(const sim::HostStampParams& stamps) {
  return fromSeconds(sim::kLargestStampNoise * stamps.noise_s + std::max(0.0, -stamps.delay_s));
}

}  // namespace

SimulatedRun::SimulatedRun(const Config& config, bool with_baselines)
    : planet_(Planet::byName(config.planet)),
      geometry_(config.wheelGeometry()),
      imu_position_b_(config.imu.mount.position_b()),
      initial_straight_m_(config.simulator.drive.initial_straight_m),
      exact_stamps_(config.simulator.imu.host_stamps.exact() && config.simulator.encoder.host_stamps.exact()),
      earliest_stamp_(
          std::max(earliness(config.simulator.imu.host_stamps), earliness(config.simulator.encoder.host_stamps))),
      run_(config, with_baselines),
      judge_(planet_, imu_position_b_, initial_straight_m_ + config.simulator.drive.distance_m) {
  run_.onEstimate([this](const Estimate& estimate, const ErrorCovariance& P) {
    judge_.compare(estimate, P);
    if (on_estimate_) {
      on_estimate_(estimate, P);
    }
  });
}

void SimulatedRun::add(const sim::Measurements& measurements, const sim::TruthState& truth) {
  judge_.addTruth(measurements.imu.stamp, truth);
  if (exact_stamps_) {
    pushMeasurements(measurements, geometry_, run_);
  } else {
    pushMeasurements(measurements, geometry_, *this);
    release(truth.stamp - earliest_stamp_);
  }
  if (measurements.truth) {
    run_.addTruthFix(*measurements.truth);
  }
  if (truth.distance_m > initial_straight_m_) {
    run_.setTruth(toNavState(truth, planet_, imu_position_b_), true);
  }
}

void SimulatedRun::enqueue(Nanoseconds stamp, const Sample& sample) {
  const auto later = [](Nanoseconds a, const Stamped& b) { return a < b.stamp; };
  waiting_.insert(std::upper_bound(waiting_.begin(), waiting_.end(), stamp, later), {stamp, sample});
}

void SimulatedRun::release(Nanoseconds until) {
  auto next = waiting_.begin();
  for (; next != waiting_.end() && next->stamp <= until; ++next) {
    std::visit([this](const auto& sample) { run_.push(sample); }, next->sample);
  }
  waiting_.erase(waiting_.begin(), next);
}

RunReport SimulatedRun::finish() {
  release(std::numeric_limits<Nanoseconds>::max());
  return run_.finish({});
}

SimulationFigures SimulatedRun::figures() const {
  SimulationFigures figures = judge_.figures();
  figures.alarms = run_.pipeline().health().alarms();
  return figures;
}

SimulationReport simulateAndMeasure(const Config& config, StopPolicy& policy, const DriveSink& recorder,
                                    bool with_baselines, bool smooth) {
  SimulatedRun run(config, with_baselines);
  if (smooth) {
    run.smoothAfterwards();
  }
  run.onEstimate([&config, &policy](const Estimate& estimate, const ErrorCovariance& P) {
    policy.observe(observationOf(estimate, P, config.stationary.wheel_speed_mps));
  });
  run.onForecast([&policy](const ErrorOutlook& forecast) {
    policy.setForecast({forecast.stamp, forecast.time_to_stop_s, forecast.kept_s});
  });
  simulateDrive(config.simulator, Planet::byName(config.planet), policy,
                [&run, &recorder](const sim::Measurements& measurements, const sim::TruthState& truth) {
                  run.add(measurements, truth);
                  if (recorder) {
                    recorder(measurements, truth);
                  }
                });
  RunReport report = run.finish();
  return {std::move(report), run.figures()};
}

}  // namespace slipnav
