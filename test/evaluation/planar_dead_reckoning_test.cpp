#include "evaluation/planar_dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace slipnav {
namespace {

ImuSample imuAt(double t_s, double yaw_rate_radps) {
  ImuSample imu;
  imu.stamp = fromSeconds(t_s);
  imu.omega_ib_b = {0.3, -0.2, yaw_rate_radps};
  return imu;
}

/// Feeds IMU at 50 Hz and wheel speed at 10 Hz over [from, to) seconds.
void feed(PlanarDeadReckoning& planar, double from_s, double to_s, double speed_mps, double yaw_rate_radps) {
  const auto steps = static_cast<int>(std::lround((to_s - from_s) * 50.0));
  for (int i = 1; i <= steps; ++i) {
    const double t_s = from_s + 0.02 * i;
    planar.addImu(imuAt(t_s, yaw_rate_radps));
    if (i % 5 == 0) {
      planar.addSpeed({fromSeconds(t_s), speed_mps});
    }
  }
}

TEST(PlanarDeadReckoning, drivesAQuarterCircleToTheRight) {
  PlanarDeadReckoning planar;
  planar.addImu(imuAt(0.0, 0.0));
  planar.start({0, 10.0, 20.0, 0.0});
  // heading north, radius 8 m, clockwise as a positive rate about the down axis
  feed(planar, 0.0, 10.0, 0.8 * kPi / 2.0, 0.1 * kPi / 2.0);
  const PlanarSample& end = planar.track().back();
  EXPECT_EQ(planar.track().front().stamp, 0);
  EXPECT_EQ(planar.track().size(), 101U);
  EXPECT_EQ(end.stamp, fromSeconds(10.0));
  EXPECT_NEAR(end.heading_rad, kPi / 2.0, 1e-9);
  EXPECT_NEAR(end.east_m, 18.0, 1e-4);
  EXPECT_NEAR(end.north_m, 28.0, 1e-4);
}

TEST(PlanarDeadReckoning, removesTheBiasOfAnInitialStandstill) {
  constexpr double kBias = 0.01;
  PlanarDeadReckoning planar;
  feed(planar, 0.0, 10.0, 0.0, kBias);
  planar.start({fromSeconds(5.0), 0.0, 0.0, kPi / 2.0});
  feed(planar, 10.0, 110.0, 1.0, kBias);
  EXPECT_NEAR(planar.gyroBias(), kBias, 1e-12);
  const PlanarSample& end = planar.track().back();
  EXPECT_NEAR(end.heading_rad, kPi / 2.0, 1e-9);
  EXPECT_NEAR(end.east_m, 100.0, 1e-9);
  EXPECT_NEAR(end.north_m, 0.0, 1e-6);
}

TEST(PlanarDeadReckoning, takesTheBiasFromTheFirstStandstillOnly) {
  PlanarDeadReckoning planar;
  planar.start({0, 0.0, 0.0, 0.0});
  feed(planar, 0.0, 5.0, 0.0, 0.01);
  feed(planar, 5.0, 10.0, 0.5, 0.01);
  feed(planar, 10.0, 30.0, 0.0, 0.03);
  EXPECT_NEAR(planar.gyroBias(), 0.01, 1e-12);
  EXPECT_NEAR(planar.track().back().heading_rad, 0.02 * 20.0, 1e-9) << "the later standstill is integrated";
}

TEST(PlanarDeadReckoning, weighsTheBiasByTimeWhereWheelEpochsSplitTheGyro) {
  PlanarDeadReckoning planar;
  for (int i = 0; i <= 3; ++i) {
    planar.addImu(imuAt(i, 0.1 * i));
  }
  planar.addSpeed({fromSeconds(0.5), 0.0});
  planar.addSpeed({fromSeconds(1.5), 0.0});
  planar.addSpeed({fromSeconds(3.0), 0.0});
  EXPECT_NEAR(planar.gyroBias(), 0.2, 1e-12);
}

TEST(PlanarDeadReckoning, doesWithoutBiasAfterAShortStandstill) {
  PlanarDeadReckoning planar;
  planar.start({0, 0.0, 0.0, 0.0});
  feed(planar, 0.0, 1.5, 0.0, 0.01);
  feed(planar, 1.5, 2.5, 0.5, 0.01);
  EXPECT_EQ(planar.gyroBias(), 0.0);
  EXPECT_NEAR(planar.track().back().heading_rad, 0.01, 1e-9);
}

TEST(PlanarDeadReckoning, doesNotCareHowTheInputsInterleave) {
  PlanarDeadReckoning imu_first;
  PlanarDeadReckoning speed_first;
  for (PlanarDeadReckoning* planar : {&imu_first, &speed_first}) {
    planar->start({0, 0.0, 0.0, 0.0});
  }
  // wheel epochs that fall between IMU epochs, and a rate that varies
  for (int i = 0; i <= 500; ++i) {
    imu_first.addImu(imuAt(0.02 * i, std::sin(0.1 * i)));
  }
  for (int k = 1; k <= 95; ++k) {
    imu_first.addSpeed({fromSeconds(0.1 * k + 0.013), 0.5 + 0.003 * k});
    speed_first.addSpeed({fromSeconds(0.1 * k + 0.013), 0.5 + 0.003 * k});
  }
  for (int i = 0; i <= 500; ++i) {
    speed_first.addImu(imuAt(0.02 * i, std::sin(0.1 * i)));
  }
  ASSERT_EQ(imu_first.track().size(), 96U);
  ASSERT_EQ(speed_first.track().size(), 96U);
  EXPECT_EQ(imu_first.track().back().east_m, speed_first.track().back().east_m);
  EXPECT_EQ(imu_first.track().back().heading_rad, speed_first.track().back().heading_rad);
}

TEST(PlanarDeadReckoning, splitsTheGyroAtWheelEpochs) {
  PlanarDeadReckoning planar;
  planar.start({0, 0.0, 0.0, 0.0});
  planar.addImu(imuAt(0.0, 0.0));
  planar.addImu(imuAt(1.0, 0.4));
  planar.addImu(imuAt(2.0, 0.8));
  planar.addSpeed({fromSeconds(0.5), 1.0});
  planar.addSpeed({fromSeconds(1.75), 1.0});
  ASSERT_EQ(planar.track().size(), 3U);
  EXPECT_NEAR(planar.track()[1].heading_rad, 0.2, 1e-12);
  EXPECT_NEAR(planar.track()[2].heading_rad, 0.4 + 0.6, 1e-12);
}

TEST(PlanarDeadReckoning, beginsInTheMiddleOfAnInterval) {
  PlanarDeadReckoning planar;
  planar.addImu(imuAt(0.0, 0.0));
  planar.start({fromSeconds(0.95), 1.0, 2.0, 0.0});
  feed(planar, 0.0, 2.0, 1.0, 0.0);
  EXPECT_EQ(planar.track().front().north_m, 2.0);
  EXPECT_EQ(planar.track()[1].stamp, fromSeconds(1.0));
  EXPECT_NEAR(planar.track()[1].north_m, 2.05, 1e-9);
  EXPECT_NEAR(planar.track().back().north_m, 3.05, 1e-9);
  EXPECT_THROW(planar.start({}), std::logic_error);
}

TEST(PlanarDeadReckoning, leavesOutStaleSamples) {
  PlanarDeadReckoning planar;
  EXPECT_TRUE(planar.addImu(imuAt(1.0, 0.0)));
  EXPECT_FALSE(planar.addImu(imuAt(1.0, 0.0)));
  EXPECT_FALSE(planar.addImu(imuAt(0.5, 0.0)));
  EXPECT_TRUE(planar.addSpeed({fromSeconds(1.0), 0.5}));
  EXPECT_FALSE(planar.addSpeed({fromSeconds(1.0), 0.5}));
  EXPECT_TRUE(planar.track().empty());
}

}  // namespace
}  // namespace slipnav
