#include "recorded_drive.h"

#include <algorithm>

#include "evaluation/simulated_drive.h"
#include "random_states.h"
#include "slipnav/core/ekf/error_dynamics.h"

namespace slipnav::test {
namespace {

InitialState initialFromTruth(const Config& config, const Planet& planet, const NavigationState& truth) {
  InitialState initial;
  initial.nav = truth;
  initial.nav.accel_bias_b.setZero();
  initial.nav.gyro_bias_b.setZero();
  initial.origin = truth.position;
  initial.P = ErrorDynamics(planet, config.imu.noise, config.vehicle).priorVariance().asDiagonal();
  initial.P.diagonal().segment<3>(kAttitude).setConstant(1e-6);
  initial.P.diagonal().segment<3>(kVelocity).setConstant(1e-6);
  initial.P.diagonal().segment<3>(kPosition).setConstant(1e-4);
  return initial;
}

}  // namespace

Config driveConfig(double distance_m) {
  Config config;
  config.simulator.drive.initial_rest_s = 5.0;
  config.simulator.drive.initial_straight_m = 4.0;
  config.simulator.drive.distance_m = distance_m;
  config.simulator.drive.final_rest_s = 5.0;
  return config;
}

RecordedDrive recordDrive(const Config& config) {
  const Planet planet = Planet::byName(config.planet);
  const WheelGeometry geometry = config.wheelGeometry();
  RecordedDrive drive;
  bool started = false;
  NeverStop policy;
  simulateDrive(config.simulator, planet, policy, [&](const sim::Measurements& m, const sim::TruthState& truth) {
    if (m.wheel) {
      drive.samples.push_back({false, {}, toWheelMotion(geometry, *m.wheel)});
    }
    drive.samples.push_back({true, m.imu, {}});
    drive.end = toNavState(truth, planet, config.imu.mount.position_b());
    if (!started) {
      drive.initial = initialFromTruth(config, planet, drive.end);
      started = true;
    }
  });
  std::stable_sort(drive.samples.begin(), drive.samples.end(),
                   [](const DriveSample& a, const DriveSample& b) { return a.stamp() < b.stamp(); });
  return drive;
}

EstimateLog runNavigator(const Config& config, const InitialState& initial, const std::vector<DriveSample>& samples) {
  const NavigationSetup setup = config.navigation();
  Navigator navigator(Planet::byName(config.planet), setup.imu_input, setup.filter);
  EstimateLog log;
  const auto sink = [&log](const Estimate& estimate, const ErrorCovariance& P) { log.push_back({estimate, P}); };
  navigator.initialize(initial);
  Nanoseconds newest = 0;
  for (const DriveSample& sample : samples) {
    newest = std::max(newest, sample.stamp());
    if (sample.is_imu) {
      navigator.push(sample.imu, sink);
    } else {
      navigator.push(sample.wheels, sink);
    }
  }
  navigator.completeUpTo(newest, sink);
  return log;
}

bool sameEstimates(const EstimateLog& a, const EstimateLog& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LoggedEstimate& x, const LoggedEstimate& y) {
    return x.estimate.first == y.estimate.first && sameState(x.estimate.nav, y.estimate.nav) &&
           x.estimate.vehicle.slow_slip == y.estimate.vehicle.slow_slip &&
           x.estimate.vehicle.mount_yaw_rad == y.estimate.vehicle.mount_yaw_rad &&
           x.estimate.stationary == y.estimate.stationary && x.P == y.P;
  });
}

}  // namespace slipnav::test
