/// Satellite positions while driving: errors and covariance as the fixes deserve.

#include <gtest/gtest.h>

#include "evaluation/simulated_run.h"

namespace slipnav {
namespace {

/// Errors that are independent from fix to fix.
struct Receiver {
  double noise_m;
  double outlier_part;
  double largest_median_m;
};

class FixesWhileDriving : public ::testing::TestWithParam<Receiver> {};

TEST_P(FixesWhileDriving, ErrorsAreBoundedAndHonest) {
  const Receiver& receiver = GetParam();
  Config config;
  config.simulator.seed = 3;
  config.simulator.drive.distance_m = 250.0;
  config.simulator.gps.horizontal_noise_m = config.simulator.gps.vertical_noise_m = receiver.noise_m;
  config.simulator.gps.outlier_part = receiver.outlier_part;
  config.gnss.use = "always";
  config.gnss.correlation_s = 0.0;
  NeverStop never;
  const Metrics metrics = simulateAndMeasure(config, never, {}, false).run.metrics;
  EXPECT_LT(metrics.horizontal_median_m, receiver.largest_median_m);
  EXPECT_GT(metrics.position_nees_mean, 0.4);
  EXPECT_LT(metrics.position_nees_mean, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Receivers, FixesWhileDriving,
                         ::testing::Values(Receiver{0.02, 0.0, 0.03}, Receiver{1.0, 0.0, 0.4}, Receiver{3.0, 0.0, 0.9},
                                           Receiver{1.0, 0.2, 0.45}));

}  // namespace
}  // namespace slipnav
