/// Cost of the navigation: one IMU step with its covariance, one wheel update, and a whole drive.

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "bench_drive.h"
#include "core/forecast/forecaster.h"
#include "evaluation/simulated_drive.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav::bench {
namespace {

/// Everything of the drive through a pipeline.
void navigate(Pipeline& pipeline) {
  const WheelGeometry geometry = config().wheelGeometry();
  for (const sim::Measurements& sample : longDrive()) {
    pushMeasurements(sample, geometry, pipeline);
  }
}

/// Where the drive starts, as the initialization finds it.
InitialState startOfDrive() {
  Pipeline pipeline(Planet::byName(config().planet), config().navigation(),
                    [](const Estimate&, const ErrorCovariance&) {});
  navigate(pipeline);
  return pipeline.initial().value();
}

/// Mechanization, Φ, Q and the propagation of the covariance.
void imuStep(benchmark::State& state) {
  NavigationSetup setup = config().navigation();
  setup.filter.filter.updates.clear();
  const InitialState start = startOfDrive();
  std::vector<ImuSample> samples;
  for (const sim::Measurements& sample : longDrive()) {
    if (sample.imu.stamp > start.nav.stamp) {
      samples.push_back(sample.imu);
    }
  }
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(samples.size()))) {
    Navigator navigator(Planet::byName(config().planet), setup.imu_input, setup.filter);
    navigator.initialize(start);
    for (const ImuSample& sample : samples) {
      navigator.push(sample, [](const Estimate&, const ErrorCovariance&) {});
    }
  }
  state.counters["limit_us"] = 5.0;
}

/// The last estimate of the drive that a wheel sample went into, and its covariance.
struct WheelMoment {
  Estimate estimate;
  ErrorCovariance P;
};

WheelMoment lastWheelMoment() {
  WheelMoment moment;
  Pipeline pipeline(Planet::byName(config().planet), config().navigation(),
                    [&moment](const Estimate& estimate, const ErrorCovariance& P) {
                      if (estimate.has_wheels) {
                        moment = {estimate, P};
                      }
                    });
  navigate(pipeline);
  return moment;
}

MeasurementSet wheelMeasurements(const FilterSetup& setup, const Estimate& estimate) {
  const VelocityJacobian H_v = bodyVelocityJacobian(estimate.nav, setup.lever_imu_to_reference_b);
  const double speed_mps = estimate.wheels.motion.forward_mps;
  MeasurementSet set;
  set.add(kForwardSpeed, forwardSpeedMeasurement(setup.wheel, {speed_mps, speed_mps, 0.1, 0.0}, estimate.motion, H_v,
                                                 estimate.vehicle, 0.0, estimate.noise_factors));
  set.add(kYawRate, yawRateMeasurement(setup.wheel, 0.0, 0.1 * speed_mps, estimate.motion));
  set.add(kLateral, lateralMeasurement(setup.nonholonomic, estimate.motion, H_v, estimate.vehicle,
                                       estimate.noise_factors.lateral));
  set.add(kVertical, verticalMeasurement(setup.nonholonomic, estimate.motion, H_v, estimate.vehicle,
                                         estimate.noise_factors.vertical));
  return set;
}

/// Models, gates and update by forward speed, heading rate, lateral and vertical velocity.
void wheelUpdate(benchmark::State& state) {
  const FilterSetup setup = config().navigation().filter;
  const WheelMoment moment = lastWheelMoment();
  GatedUpdate update(setup.filter);
  for (auto _ : state) {
    MeasurementSet set = wheelMeasurements(setup, moment.estimate);
    ErrorCovariance P = moment.P;
    benchmark::DoNotOptimize(kalmanUpdate(update.select(set, moment.estimate.nav.stamp, P).value(), P));
    benchmark::DoNotOptimize(P);
  }
  state.counters["limit_us"] = 15.0;
}

/// Initialization, mechanization and filter over 915 s of all sensors.
void offlineDrive(benchmark::State& state) {
  longDrive();
  for (auto _ : state) {
    Pipeline pipeline(Planet::byName(config().planet), config().navigation(),
                      [](const Estimate&, const ErrorCovariance&) {});
    navigate(pipeline);
  }
  state.counters["limit_us"] = 0.6e6;
}

/// The same with a forecast every second.
void offlineDriveAndForecasts(benchmark::State& state) {
  longDrive();
  const Planet planet = Planet::byName(config().planet);
  const NavigationSetup setup = config().navigation();
  double forecasts = 0.0;
  for (auto _ : state) {
    Forecaster forecaster(planet, setup.filter, config().forecast);
    forecasts = 0.0;
    Pipeline pipeline(planet, setup, [&](const Estimate& estimate, const ErrorCovariance& P) {
      forecasts += forecaster.push(estimate, P) ? 1.0 : 0.0;
    });
    navigate(pipeline);
  }
  state.counters["forecasts"] = forecasts;
}

BENCHMARK(imuStep)->Unit(benchmark::kMicrosecond);
BENCHMARK(wheelUpdate)->Unit(benchmark::kMicrosecond);
BENCHMARK(offlineDrive)->Unit(benchmark::kMillisecond);
BENCHMARK(offlineDriveAndForecasts)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipnav::bench
