#include "slipnav/eval/simulated_run.h"

namespace slipnav {

SimulatedRun::SimulatedRun(const Config& config)
    : planet_(Planet::byName(config.planet)),
      geometry_(config.wheelGeometry()),
      imu_position_b_(config.imu.mount.position_b()),
      initial_straight_m_(config.simulator.drive.initial_straight_m),
      run_(config, true) {}

void SimulatedRun::add(const sim::Measurements& measurements, const sim::TruthState& truth) {
  pushMeasurements(measurements, geometry_, run_);
  if (measurements.truth) {
    run_.addTruthFix(*measurements.truth);
  }
  if (truth.distance_m > initial_straight_m_) {
    run_.setTruth(toNavState(truth, planet_, imu_position_b_), true);
  }
}

RunReport simulateAndMeasure(const Config& config, StopPolicy& policy, const DriveSink& recorder) {
  SimulatedRun run(config);
  run.onEstimate([&config, &policy](const Estimate& estimate, const ErrorCovariance& P) {
    policy.observe(observationOf(estimate, P, config.stationary.wheel_speed_mps));
  });
  run.onForecast([&policy](const ErrorOutlook& forecast) {
    policy.setForecast({forecast.stamp, forecast.time_to_stop_s});
  });
  simulateDrive(config.simulator, Planet::byName(config.planet), policy,
                [&run, &recorder](const sim::Measurements& measurements, const sim::TruthState& truth) {
                  run.add(measurements, truth);
                  if (recorder) {
                    recorder(measurements, truth);
                  }
                });
  return run.finish();
}

}  // namespace slipnav
