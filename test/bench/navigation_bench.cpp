/// Cost of the navigation: one IMU step with its covariance, one wheel update, and a whole drive.

#include <benchmark/benchmark.h>

#include <vector>

#include "slipnav/navigator/navigator.h"
#include "support/recorded_drive.h"

namespace slipnav {
namespace {

constexpr double kDrive_s = 915.0;  // the paper's longest

const Config& config() {
  static const Config config = test::driveConfig(30.0);
  return config;
}

const test::RecordedDrive& drive() {
  static const test::RecordedDrive drive = test::recordDrive(config());
  return drive;
}

/// IMU samples of the drive, mechanised without any correction.
std::vector<InsStep> steps() {
  const NavigationSetup setup = config().navigation();
  InsEngine ins(Planet::byName(config().planet), setup.imu_input);
  ins.initialise(drive().initial.nav);
  std::vector<InsStep> result;
  for (const test::DriveSample& sample : drive().samples) {
    if (sample.is_imu) {
      ins.push(sample.imu);
      while (const std::optional<InsStep> step = ins.step()) {
        result.push_back(*step);
      }
    }
  }
  return result;
}

/// Mechanisation, Φ, Q and the propagation of the covariance.
void imuStep(benchmark::State& state) {
  NavigationSetup setup = config().navigation();
  setup.filter.filter.updates.clear();
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  std::vector<ImuSample> samples;
  for (const test::DriveSample& sample : drive().samples) {
    if (sample.is_imu) {
      samples.push_back(sample.imu);
    }
  }
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(samples.size()))) {
    Navigator navigator(Planet::byName(config().planet), setup.imu_input, setup.filter);
    navigator.initialise(drive().initial);
    for (const ImuSample& sample : samples) {
      navigator.push(sample, ignore);
    }
  }
}

/// Gate and update by forward speed, heading rate, lateral and vertical velocity: what a wheel sample costs beyond the
/// IMU steps around it, with the mechanisation done again.
void wheelUpdate(benchmark::State& state) {
  const NavigationSetup setup = config().navigation();
  const InsStep step = steps().at(500);
  ErrorCovariance P = drive().initial.P;
  GatedUpdate update(setup.filter.filter);
  const BodyMotion motion{0.1, step.state.q_b_to_n.conjugate() * step.state.v_eb_n, step.omega_ib_b};
  const VelocityJacobian H_v = bodyVelocityJacobian(step.state, setup.filter.lever_imu_to_reference_b);
  const VehicleState vehicle;
  for (auto _ : state) {
    MeasurementSet set;
    set.add(kForwardSpeed, forwardSpeedMeasurement(setup.filter.wheel, 0.8, 0.8, motion, H_v, vehicle, 0.0, 1.0));
    set.add(kYawRate, yawRateMeasurement(setup.filter.wheel, 0.0, motion));
    set.add(kLateral, lateralMeasurement(setup.filter.nonholonomic, motion, H_v, vehicle, 1.0));
    set.add(kVertical, verticalMeasurement(setup.filter.nonholonomic, motion, H_v, vehicle));
    ErrorCovariance updated = P;
    benchmark::DoNotOptimize(update.apply(set, step.state.stamp, updated));
    benchmark::DoNotOptimize(updated);
  }
}

/// Filter and mechanisation over as many samples as 915 s have.
void offlineDrive(benchmark::State& state) {
  const NavigationSetup setup = config().navigation();
  const std::vector<test::DriveSample>& samples = drive().samples;
  const Nanoseconds length = samples.back().stamp() - samples.front().stamp();
  const int rounds = static_cast<int>(kDrive_s / toSeconds(length)) + 1;
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  for (auto _ : state) {
    for (int round = 0; round < rounds; ++round) {
      Navigator navigator(Planet::byName(config().planet), setup.imu_input, setup.filter);
      navigator.initialise(drive().initial);
      for (const test::DriveSample& sample : samples) {
        sample.is_imu ? static_cast<void>(navigator.push(sample.imu, ignore))
                      : static_cast<void>(navigator.push(sample.wheels, ignore));
      }
    }
  }
}

BENCHMARK(imuStep);
BENCHMARK(wheelUpdate)->Unit(benchmark::kMicrosecond);
BENCHMARK(offlineDrive)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipnav
