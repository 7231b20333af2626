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

}  // namespace slipnav
