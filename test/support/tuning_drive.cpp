#include "tuning_drive.h"

#include "evaluation/simulated_drive.h"
#include "recorded_drive.h"
#include "simulation/random.h"

namespace slipnav::test {

Config tuningConfig(int seed, double distance_m) {
  Config config = driveConfig(distance_m);
  config.simulator.seed = seed;
  config.simulator.terrain = "paved";
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 3.0;
  config.vehicle.fast_slip_std = 0.002;
  config.wheel.slip_noise_std = 0.0005;
  config.filter.adaptation.factor_std = 1.0;  // what is learned while driving need not be configured
  config.filter.adaptation.slip_factor_std = 1.0;
  return config;
}

TuningDrive simulateTuningDrive(const Config& config) {
  TuningDrive drive{"simulated", config, {}};
  const WheelGeometry geometry = config.wheelGeometry();
  PeriodicStops policy(8.0, 1.0);
  simulateDrive(config.simulator, Planet::byName(config.planet), policy,
                [&](const sim::Measurements& measurements, const sim::TruthState& /*truth*/) {
                  if (measurements.wheel) {
                    drive.samples.emplace_back(toWheelMotion(geometry, *measurements.wheel));
                  }
                  drive.samples.emplace_back(measurements.imu);
                });
  return drive;
}

void addWheelNoise(double std_mps, TuningDrive& drive) {
  sim::RandomStream random(1, "wheel noise");
  for (Sample& sample : drive.samples) {
    if (auto* wheels = std::get_if<WheelMotion>(&sample); wheels != nullptr && wheels->largest_speed_mps > 0.0) {
      wheels->motion.forward_mps += std_mps * random.normal();
    }
  }
}

}  // namespace slipnav::test
