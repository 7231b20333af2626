/// Free inertial navigation on a rover that rocks hard, with an IMU without errors: only the mechanization is to blame.

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/simulated_drive.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav::test {
namespace {

TEST(RockingDrive, FifteenMinutesUnaidedStayWithinAMetre) {
  Config config;
  config.filter.updates = {};
  config.initialization.source = "truth";
  config.simulator.terrain = "rocking";
  config.simulator.imu.error_free = true;
  config.simulator.imu.rate_hz = 50.0;
  config.simulator.drive.initial_rest_s = 5.0;
  config.simulator.drive.distance_m = 710.0;
  const Planet planet = Planet::byName(config.planet);
  const WheelGeometry geometry = config.wheelGeometry();
  const Vector3 imu_position_b = config.imu.mount.position_b();

  NavigationState estimate;
  Pipeline pipeline(planet, config.navigation(),
                    [&estimate](const Estimate& e, const ErrorCovariance&) { estimate = e.nav; });
  double worst_m = 0.0;
  double duration_s = 0.0;
  NeverStop policy;
  simulateDrive(config.simulator, planet, policy, [&](const sim::Measurements& m, const sim::TruthState& truth) {
    const NavigationState state = toNavState(truth, planet, imu_position_b);
    pipeline.setTruth(state, true);
    pushMeasurements(m, geometry, pipeline);
    if (estimate.stamp == state.stamp) {
      worst_m = std::max(worst_m, positionDifference(planet, estimate.position, state.position).head<2>().norm());
      duration_s = toSeconds(state.stamp - pipeline.initial()->nav.stamp);
    }
  });
  EXPECT_GT(duration_s, 900.0);
  EXPECT_LT(worst_m, 1.0);
  EXPECT_GT(worst_m, 1e-6);  // something was compared
}

}  // namespace
}  // namespace slipnav::test
