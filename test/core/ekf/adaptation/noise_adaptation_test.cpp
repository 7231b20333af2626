/// Which innovation tells of which noise.

#include "slipnav/core/ekf/adaptation/noise_adaptation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/square.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kWay_m = 0.1;

/// A rover that drives east on the level, its filter fed with innovations.
class Learner {
 public:
  Learner() : dynamics_(Planet::byName("earth"), imu_, {}), adaptation_({}, imu_, 0.0) {
    state_.position.latitude_rad = 0.7;
    state_.v_eb_n = Vector3(0.0, 1.0, 0.0);
  }

  const NoiseAdaptation& adaptation() const { return adaptation_; }

  /// Noise of one more step.
  ErrorVector step(double slow_slip = 0.0) {
    InsStep step;
    step.start = fromSeconds(kStep_s * steps_++);
    step.state = state_;
    step.state.stamp = step.start + fromSeconds(kStep_s);
    step.f_ib_b = Vector3(0.0, 0.0, -9.8);
    ErrorTransition transition =
        dynamics_.transition(state_, state_, step.f_ib_b, Vector3::Zero(), Vector3::Zero(), kStep_s);
    adaptation_.addNoise(dynamics_, step, step.state, slow_slip, kWay_m, transition);
    return transition.noise;
  }

  void forward(double residual, double variance) {
    adaptation_.learnForward({}, {1.0, 1.0, kStep_s, 0.0}, {residual, variance, 0.0});
  }
  void sideways(double residual, double variance) {
    adaptation_.learnLateral(variance, {residual, variance, 0.0}, Vector3::UnitX());
    adaptation_.constraintsUsed();
  }
  void offGround(double residual, double variance) {
    adaptation_.learnVertical(variance, {residual, variance, 0.0});
    adaptation_.constraintsUsed();
  }

 private:
  ImuNoiseParams imu_;
  ErrorDynamics dynamics_;
  NoiseAdaptation adaptation_;
  NavigationState state_;
  int steps_ = 0;
};

TEST(NoiseAdaptation, ASmoothRoadMakesNothingLessThanConfigured) {
  Learner learner;
  for (int i = 0; i < 500; ++i) {
    learner.step();
    learner.forward(1e-4, square(0.05));
    learner.sideways(i % 2 == 0 ? 1e-4 : -1e-4, square(0.02));
    learner.offGround(i % 2 == 0 ? 1e-4 : -1e-4, square(0.02));
  }
  const NoiseFactors factors = learner.adaptation().factors();
  EXPECT_EQ(factors.fast_slip, 1.0);
  EXPECT_EQ(factors.lateral, 1.0);
  EXPECT_EQ(factors.vertical, 1.0);
  EXPECT_LT(factors.wheel, 0.5) << "an encoder may be as fine as it is";
}

TEST(NoiseAdaptation, LearnsThatABodySways) {
  Learner learner;
  sim::RandomStream random(3, "sway");
  for (int i = 0; i < 200; ++i) {
    learner.step();
    learner.sideways(0.1 * random.normal(), square(0.02) * learner.adaptation().factors().lateral);
  }
  EXPECT_NEAR(std::sqrt(learner.adaptation().factors().lateral), 5.0, 2.0);
  EXPECT_EQ(learner.adaptation().factors().vertical, 1.0);
}

/// What contradicts in the same way for long is the state: the IMU is doubted, not the constraint.
TEST(NoiseAdaptation, APersistentContradictionIsNoNoiseOfTheConstraint) {
  Learner learner;
  const ErrorVector before = learner.step();
  sim::RandomStream random(3, "heave");
  for (int i = 0; i < 30; ++i) {
    learner.step();
    learner.offGround(0.06 + 0.02 * random.normal(), square(0.02) * learner.adaptation().factors().vertical);
  }
  EXPECT_LT(std::sqrt(learner.adaptation().factors().vertical), 1.5);
  const ErrorVector after = learner.step();
  for (const int state : {kAttitude + 0, kAttitude + 1, kAccelBias + 2}) {
    EXPECT_GT(after(state), 30.0 * before(state)) << state;
  }
  EXPECT_GT(after(kVelocity + 2), 2.0 * before(kVelocity + 2)) << "beside the part of the bias that is unsteady anyway";
}

TEST(NoiseAdaptation, AVelocityThatStaysToTheSideIsNoSway) {
  Learner learner;
  const ErrorVector before = learner.step();
  sim::RandomStream random(3, "drift");
  for (int i = 0; i < 30; ++i) {
    learner.step();
    learner.sideways(0.06 + 0.02 * random.normal(), square(0.02) * learner.adaptation().factors().lateral);
  }
  EXPECT_LT(std::sqrt(learner.adaptation().factors().lateral), 1.5);
  const ErrorVector after = learner.step();
  EXPECT_GT(after(kAttitude), 30.0 * before(kAttitude));
}

TEST(NoiseAdaptation, GroundSlipsAtLeastAsMuchAsItIsSeenTo) {
  Learner learner;
  const double firm = learner.step(0.0)(kSlowSlip);
  EXPECT_EQ(learner.step(0.01)(kSlowSlip), firm) << "less than the ground may have anyway";
  learner.step(0.4);
  EXPECT_NEAR(learner.adaptation().ground().slow_slip_variance, square(0.4), 1e-12);
  EXPECT_GT(learner.step(0.4)(kSlowSlip), 50.0 * firm);
}

/// Wheels smaller than configured look like that, but none is three times as small.
TEST(NoiseAdaptation, AVehicleFasterThanItsWheelsIsNotTheGround) {
  Learner learner;
  learner.step(-0.2);
  EXPECT_NEAR(learner.adaptation().ground().slow_slip_variance, square(0.2), 1e-12);
  learner.step(-2.0);
  EXPECT_NEAR(learner.adaptation().ground().slow_slip_variance, square(1.0 / 3.0), 1e-12);
}

TEST(NoiseAdaptation, ARoverAtRestHasTheNoiseOfItsDataSheet) {
  ImuNoiseParams imu;
  const ErrorDynamics dynamics(Planet::byName("earth"), imu, {});
  NoiseAdaptation adaptation({}, imu, 0.0);
  InsStep step;
  step.state.stamp = fromSeconds(kStep_s);
  step.f_ib_b = Vector3(0.0, 0.0, -9.8);
  const ErrorTransition bare =
      dynamics.transition(step.state, step.state, step.f_ib_b, Vector3::Zero(), Vector3::Zero(), kStep_s);
  ErrorTransition resting = bare;
  adaptation.addNoise(dynamics, step, step.state, 0.0, 0.0, resting);
  EXPECT_LT((resting.noise.head<kNavStates>() - bare.noise.head<kNavStates>()).norm(), 1e-15);
  ErrorTransition driving = bare;
  adaptation.addNoise(dynamics, step, step.state, 0.0, kWay_m, driving);
  const double unsteady = square(0.1 * imuFloor(imu).accel_bias_std) * kStep_s;
  const double factor = square(NoiseScaleParams().imu_factor_std);
  EXPECT_NEAR(driving.noise(kVelocity), factor * bare.noise(kVelocity) + unsteady, 1e-6 * driving.noise(kVelocity));
  EXPECT_NEAR(driving.noise(kAttitude), factor * bare.noise(kAttitude), 1e-6 * driving.noise(kAttitude));
}

}  // namespace
}  // namespace slipnav::test
