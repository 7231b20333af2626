#include "core/ins/leveling.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "analytic_motion.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

TEST(Leveling, FindsRollAndPitchAtRest) {
  for (const double roll : {-0.4, 0.0, 0.3}) {
    for (const double pitch : {-0.5, 0.0, 0.2}) {
      const Quaternion q = q_b_to_n_fromEuler(roll, pitch, 1.0);
      const Vector2 leveled = levelAtRest(q.conjugate() * Vector3(0.0, 0.0, -9.8));
      EXPECT_NEAR(leveled.x(), roll, 1e-12);
      EXPECT_NEAR(leveled.y(), pitch, 1e-12);
    }
  }
}

/// A drive that speeds up, turns and rocks: what is left is gravity's reaction at its start.
TEST(Leveling, FindsGravityOnTheMove) {
  const Planet earth = Planet::byName("earth");
  const double R = earth.meridianRadius(0.7);
  // along the meridian with a speed that falls from 0.75 to 0.45 m/s, rocking in roll and pitch
  const AnalyticMotion motion(earth,
                              eulerAttitude({0.05, 0.0, 0.04, 1.5, 0.2}, {0.1, 0.0, 0.05, 1.1, 0.4}, constant(0.0)),
                              {0.7, 0.6 / R, 0.5 / R, 0.3, 0.0}, constant(0.0), constant(0.0));
  std::vector<ImuSample> samples = {{AnalyticMotion::kEpoch, Vector3::Zero(), Vector3::Zero()}};
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    const ImuInterval imu = motion.imu(0.02 * i, 0.02 * (i + 1));
    samples.push_back({AnalyticMotion::kEpoch + fromSeconds(0.02 * (i + 1)), imu.f_ib_b, imu.omega_ib_b});
  }
  const NavigationState start = motion.state(0.0);
  const Vector3 reaction = reactionToGravityOnTheMove(samples, start.v_eb_n.x(), motion.state(0.02 * count).v_eb_n.x());
  const Vector2 leveled = levelAtRest(reaction);
  const Vector3 truth = eulerFrom_q_b_to_n(start.q_b_to_n);
  // the speed is taken along the body's x axis, which rocks by 0.15 rad against the level: 0.8·0.15/10 s of 9.8 m/s²
  EXPECT_NEAR(leveled.x(), truth.x(), 0.002);
  EXPECT_NEAR(leveled.y(), truth.y(), 0.002);
  // the plain mean, without rotation and change of speed, is worse
  Vector3 sum = Vector3::Zero();
  for (const ImuSample& sample : samples) {
    sum += sample.f_ib_b;
  }
  EXPECT_GT((levelAtRest(sum) - truth.head<2>()).norm(), 0.01);
}

TEST(Leveling, OneSampleIsNotEnough) {
  EXPECT_THROW(reactionToGravityOnTheMove({}, 0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(reactionToGravityOnTheMove({ImuSample{}}, 0.0, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav::test
