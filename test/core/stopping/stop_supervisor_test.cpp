/// The course of a stop: how it slows the rover down, when the hold ends.

#include <gtest/gtest.h>

#include "supervisor_rig.h"

namespace slipnav::test {
namespace {

TEST(StopSupervisor, SlowsDownAlongTheArcWithinItsLimit) {
  Rig rig("active");
  situations()[3].reach(rig);
  double before_mps = kSpeed_mps;
  int steps = 0;
  for (; before_mps > 0.0 && steps < 100; ++steps) {
    rig.moving();
    const VelocityCommand out = rig.drive();
    EXPECT_NEAR(before_mps - out.linear_mps.x(), std::min(before_mps, 0.05), 1e-9);
    EXPECT_NEAR(out.angular_radps.z(), 0.25 * out.linear_mps.x(), 1e-9);
    before_mps = out.linear_mps.x();
  }
  EXPECT_EQ(steps, 16);  // 0.8 m/s by 0.5 m/s²
}

TEST(StopSupervisor, AStopThatTheOperatorEndsAtOnceStaysEnded) {
  Rig rig("active");
  situations()[3].reach(rig);
  rig.moving();
  EXPECT_FALSE(rig.drive().isZero());
  EXPECT_TRUE(rig.supervisor.command({}).isZero());
  EXPECT_TRUE(rig.drive().isZero());
}

TEST(StopSupervisor, ARoverThatStandsIsNotSetInMotionByAStop) {
  Rig rig("active");
  driveTenSeconds(rig);
  rig.supervisor.command({});
  rig.forecast(0.0);
  ASSERT_EQ(rig.state(), kS);
  EXPECT_TRUE(rig.drive().linear_mps.isZero());
}

TEST(StopSupervisor, StopsInTimeToStandWhenTheThresholdIsReached) {
  Rig rig("active");
  driveTenSeconds(rig);
  rig.forecast(4.0);
  EXPECT_NEAR(rig.supervisor.status().time_left_s, 4.0 - kSpeed_mps / 0.5, 1e-6);
  rig.during(2.3, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kC);
  rig.moving();
  EXPECT_EQ(rig.state(), kS);
  EXPECT_EQ(rig.supervisor.status().reason, "the position error reaches its threshold");
}

TEST(StopSupervisor, AHoldEndsWithConvergence) {
  Rig rig("active");
  situations()[4].reach(rig);
  rig.during(0.6, [&rig] { rig.standing(1e-5); });
  EXPECT_EQ(rig.state(), kH) << "a velocity that is known from few updates may be so by chance";
  rig.standing(1e-5);
  EXPECT_EQ(rig.state(), kD);
  EXPECT_EQ(rig.supervisor.status().reason, "the velocity has converged after 0.7 s");
  EXPECT_EQ(rig.supervisor.status().stops, 1U);
  EXPECT_TRUE(rig.drive().isZero());
}

TEST(StopSupervisor, AfterAHoldTheCommandComesBackByARamp) {
  Rig rig("active");
  situations()[4].reach(rig);
  rig.during(0.7, [&rig] { rig.standing(1e-5); });
  ASSERT_EQ(rig.state(), kD);
  double before_mps = rig.drive().linear_mps.x();
  EXPECT_EQ(before_mps, 0.0);
  int steps = 0;
  for (; before_mps < kSpeed_mps && steps < 100; ++steps) {
    rig.moving();
    const VelocityCommand out = rig.drive();
    EXPECT_NEAR(out.linear_mps.x() - before_mps, 0.05, 1e-9);
    EXPECT_NEAR(out.angular_radps.z(), 0.25 * out.linear_mps.x(), 1e-9);
    before_mps = out.linear_mps.x();
  }
  EXPECT_EQ(steps, 16);  // 0.8 m/s by 0.5 m/s²
  rig.moving();
  EXPECT_TRUE(equal(rig.drive(), driveOn()));
}

TEST(StopSupervisor, TheRampEndsWithAStopOfTheOperatorsOwn) {
  Rig rig("active");
  situations()[4].reach(rig);
  rig.during(0.7, [&rig] { rig.standing(1e-5); });
  EXPECT_TRUE(rig.drive().isZero());
  EXPECT_TRUE(rig.supervisor.command({}).isZero());
  EXPECT_TRUE(equal(rig.drive(), driveOn()));
}

TEST(StopSupervisor, AStopGoesOnWithoutEstimatesAndWithinItsLimit) {
  Rig rig("active");
  situations()[3].reach(rig);
  rig.during(0.5, [&rig] { rig.moving(); });
  const double before_mps = rig.drive().linear_mps.x();
  rig.supervisor.loseEstimates();
  rig.supervisor.passTime(fromSeconds(0.5));
  EXPECT_NEAR(rig.drive().linear_mps.x(), before_mps - 0.25, 1e-9);
  rig.supervisor.passTime(fromSeconds(2.0));
  EXPECT_TRUE(rig.drive().isZero());
  rig.supervisor.passTime(fromSeconds(2.9));
  EXPECT_EQ(rig.state(), kS);
  rig.supervisor.passTime(fromSeconds(0.2));
  EXPECT_EQ(rig.state(), kD);
  EXPECT_EQ(rig.supervisor.status().reason, "no estimates");
  rig.supervisor.passTime(fromSeconds(1.0));
  rig.drive();
  rig.supervisor.passTime(fromSeconds(0.8));
  EXPECT_NEAR(rig.drive().linear_mps.x(), 0.4, 0.41) << "by a ramp";
  rig.supervisor.passTime(fromSeconds(2.0));
  EXPECT_TRUE(equal(rig.drive(), driveOn()));
}

TEST(StopSupervisor, TimeThatPassedWithoutEstimatesCountsWhenTheyComeBack) {
  Rig rig("active");
  situations()[3].reach(rig);
  rig.supervisor.loseEstimates();
  rig.supervisor.passTime(fromSeconds(4.0));
  rig.during(1.9, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS);
  rig.during(0.2, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kD) << "6 s after it began";
}

TEST(StopSupervisor, OnlyWheelSamplesBringZeroUpdates) {
  Rig rig("active");
  situations()[4].reach(rig);
  for (int i = 0; i < 20; ++i) {
    rig.stamp += kInterval / 10;
    rig.supervisor.observe({rig.stamp, 0.0, 1e-5, true, false, true});
  }
  EXPECT_EQ(rig.state(), kH);
}

TEST(StopSupervisor, AHoldEndsAtItsLimit) {
  for (const double limit_s : {0.5, 3.0}) {
    Rig rig("active", limit_s);
    situations()[4].reach(rig);
    EXPECT_NEAR(rig.supervisor.status().time_left_s, limit_s, 1e-9);
    rig.during(limit_s - 0.1, [&rig] { rig.standing(); });
    EXPECT_EQ(rig.state(), kH);
    EXPECT_TRUE(rig.drive().isZero());
    rig.standing();
    EXPECT_EQ(rig.state(), kD);
    rig.drive();
    rig.moving();
    EXPECT_GT(rig.drive().linear_mps.x(), 0.0);
  }
}

TEST(StopSupervisor, ASlidingRoverIsNotHeld) {
  Rig rig("active");
  situations()[3].reach(rig);
  rig.during(1.5, [&rig] { rig.wheelsStandOnly(); });
  EXPECT_EQ(rig.state(), kS);
  rig.wheelsStandOnly();
  EXPECT_EQ(rig.state(), kD);
  EXPECT_EQ(rig.supervisor.status().refusals, 1U);
  EXPECT_EQ(rig.supervisor.status().stops, 0U);
  rig.moving();
  rig.forecast(0.0);
  EXPECT_EQ(rig.supervisor.status().reason,
            "the rover slides: its wheels are at rest, but it is not; next stop not before 30.0 s");
  EXPECT_GT(rig.drive().linear_mps.x(), 0.0);
  rig.during(28.0, [&rig] {
    rig.moving();
    rig.forecast(0.0);
  });
  EXPECT_EQ(rig.state(), kC);
  rig.during(2.5, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS);
}

TEST(StopSupervisor, ARoverThatDoesNotComeToRestIsReleased) {
  Rig rig("active");
  situations()[3].reach(rig);
  rig.during(5.9, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS);
  rig.moving();
  EXPECT_EQ(rig.state(), kD);
  EXPECT_EQ(rig.supervisor.status().reason, "the rover does not come to rest within 6.0 s");
  rig.drive();
  rig.moving();
  EXPECT_GT(rig.drive().linear_mps.x(), 0.0);
}

TEST(StopSupervisor, AdviceStandsUntilItIsFollowed) {
  Rig rig("advise");
  situations()[3].reach(rig);
  rig.during(60.0, [&rig] { rig.moving(); });
  EXPECT_EQ(rig.state(), kS);
  EXPECT_EQ(rig.supervisor.status().time_left_s, 0.0);
  rig.standing();
  EXPECT_EQ(rig.state(), kH);
  rig.moving();
  EXPECT_EQ(rig.supervisor.status().reason, "resumed before the velocity had converged");
}

TEST(StopSupervisor, SaysWhyItCannotStopNow) {
  Rig rig("active");
  EXPECT_EQ(rig.supervisor.stopNow(), "no estimates");
  rig.moving();
  rig.supervisor.setOverride(true);
  EXPECT_EQ(rig.supervisor.stopNow(), "overridden by the operator");
  rig.supervisor.setEmergencyStop(true);
  EXPECT_EQ(rig.supervisor.stopNow(), "emergency stop");
  rig.supervisor.setEmergencyStop(false);
  rig.supervisor.setOverride(false);
  EXPECT_EQ(rig.supervisor.stopNow(), "");
  EXPECT_EQ(rig.state(), kS);
  EXPECT_EQ(rig.supervisor.stopNow(), "");
  EXPECT_EQ(Rig("off").supervisor.stopNow(), "the supervisor is off");
}

TEST(StopSupervisor, ObservesWhatTheFilterSays) {
  Estimate estimate;
  estimate.nav.stamp = 7;
  estimate.stationary = true;
  estimate.has_wheels = true;
  estimate.wheels.count = 4;
  estimate.wheels.largest_speed_mps = 0.001;
  estimate.motion.v_eb_b = {0.5, 0.0, 0.0};
  ErrorCovariance P = ErrorCovariance::Zero();
  P.diagonal().segment<3>(kVelocity) << 1e-4, 4e-4, 7e-4;
  const RoverObservation observation = observationOf(estimate, P, 0.001);
  EXPECT_EQ(observation.stamp, 7);
  EXPECT_EQ(observation.forward_mps, 0.5);
  EXPECT_NEAR(observation.speed_std_mps, 0.02, 1e-15);
  EXPECT_TRUE(observation.stationary);
  EXPECT_TRUE(observation.has_wheels);
  EXPECT_TRUE(observation.wheels_at_rest);
  EXPECT_FALSE(observationOf(estimate, P, 0.0009).wheels_at_rest);
  estimate.has_wheels = false;
  EXPECT_FALSE(observationOf(estimate, P, 0.001).has_wheels);
  estimate.wheels.count = 0;
  EXPECT_FALSE(observationOf(estimate, P, 0.001).wheels_at_rest);
}

}  // namespace
}  // namespace slipnav::test
