#include "simulated_start.h"

#include <cmath>

#include "evaluation/simulated_drive.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav::test {

Config startConfig(int seed) {
  Config config;
  config.simulator.seed = seed;
  config.simulator.terrain = "paved";
  config.simulator.drive.initial_rest_s = 12.0;
  config.simulator.drive.initial_straight_m = 14.0;
  config.simulator.drive.distance_m = 1.0;
  config.simulator.gps.horizontal_noise_m = 0.02;
  config.simulator.gps.vertical_noise_m = 0.04;
  config.simulator.imu.gyro_turn_on_bias_deg_per_h = 50.0;
  config.simulator.imu.accel_turn_on_bias_mg = 1.5;
  config.imu.noise.gyro_bias_std_deg_per_h = 50.0;
  config.imu.noise.accel_bias_std_ug = 1500.0;
  config.imu.noise.gyro_noise_deg_per_sqrt_h = config.simulator.imu.gyro_noise_deg_per_sqrt_h;
  config.imu.noise.accel_noise_mps_per_sqrt_h = config.simulator.imu.accel_noise_mps_per_sqrt_h;
  config.initialization.source = "gnss";
  config.initialization.min_rest_s = 5.0;
  config.initialization.drive_distance_m = 10.0;
  return config;
}

Start initialize(const Config& config, const Interference& interference) {
  const Planet planet = Planet::byName(config.planet);
  const NavigationSetup setup = config.navigation();
  const WheelGeometry geometry = config.wheelGeometry();
  Initializer initializer(planet, setup.initialization, setup.imu_input, setup.filter);
  Start start;
  std::vector<NavigationState> truths;
  sim::RandomStream velocity_noise(static_cast<std::uint64_t>(config.simulator.seed), "satellite velocity");
  NeverStop policy;
  simulateDrive(config.simulator, planet, policy, [&](const sim::Measurements& m, const sim::TruthState& truth) {
    const double t_s = toSeconds(truth.stamp) - config.simulator.start_time_s;
    if (start.initial || t_s < interference.ignore_before_s) {
      return;
    }
    truths.push_back(toNavState(truth, planet, config.imu.mount.position_b()));
    if (m.gps && (t_s < interference.no_fixes_from_s || t_s > interference.no_fixes_until_s)) {
      initializer.push(toPositionFix(*m.gps));
    }
    if (m.gps && interference.velocity_std_mps > 0.0) {
      const double std_mps = interference.velocity_std_mps;
      initializer.push(VelocityFix{truth.stamp, truths.back().v_eb_n + std_mps * velocity_noise.normal3(),
                                   Vector3::Constant(std_mps * std_mps)});
    }
    if (m.wheel) {
      initializer.push(toWheelMotion(geometry, *m.wheel));
    }
    initializer.push(m.imu);
    start.initial = initializer.result();
    if (start.said.empty() || start.said.back() != initializer.progress()) {
      start.said.push_back(initializer.progress());
    }
  });
  start.progress = initializer.progress();
  for (const NavigationState& truth : truths) {
    if (start.initial && truth.stamp == start.initial->nav.stamp) {
      start.truth = truth;
    }
  }
  return start;
}

ErrorVector errorOf(const Start& start) {
  return errorBetween(Planet::byName("earth"), start.initial->nav, start.truth);
}

double sigmas(const Start& start, int index) {
  return std::abs(errorOf(start)(index)) / std::sqrt(start.initial->P(index, index));
}

}  // namespace slipnav::test
