#include "slipnav/filter/unseen_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav {
namespace {

class UnseenMotionTest : public ::testing::Test {
 protected:
  UnseenMotionTest() {
    params_.gap_rate_std_deg_per_s = 2.0;
    params_.gap_accel_std_mps2 = 0.5;
    params_.gap_max_tilt_deg = 3.0;
    state_.stamp = 1'000'000'000;
    state_.position = {0.7, 0.1, 200.0};
    state_.v_eb_n = {0.6, -0.2, 0.0};
  }

  double sigma(int index) const { return std::sqrt(P_(index, index)); }

  Planet planet_ = Planet::byName("earth");
  FilterParams params_;
  NavigationState state_;
  ErrorCovariance P_ = ErrorCovariance::Zero();
};

TEST_F(UnseenMotionTest, AddsWhatMayHaveHappened) {
  UnseenMotion unseen(planet_, params_);
  unseen.begin(state_, 1.0, P_);
  EXPECT_NEAR(sigma(kAttitude), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kAttitude + 2), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kVelocity), 0.5, 1e-12);
  EXPECT_NEAR(sigma(kPosition), 0.25, 1e-12);
}

TEST_F(UnseenMotionTest, TheGroundLimitsTheTiltButNotTheHeading) {
  UnseenMotion unseen(planet_, params_);
  unseen.begin(state_, 5.0, P_);
  EXPECT_NEAR(sigma(kAttitude + 1), degToRad(3.0), 1e-12);
  EXPECT_NEAR(sigma(kAttitude + 2), degToRad(10.0), 1e-12);
}

TEST_F(UnseenMotionTest, LaterTheTurnComesOnceAsARotationAboutTheVertical) {
  UnseenMotion unseen(planet_, params_);
  unseen.begin(state_, 1.0, P_);
  P_.setZero();
  state_.stamp += fromSeconds(2.9);
  unseen.settle(state_, P_);
  EXPECT_TRUE(P_.isZero());
  state_.stamp += fromSeconds(0.2);
  unseen.settle(state_, P_);
  EXPECT_NEAR(sigma(kAttitude + 2), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kVelocity), degToRad(2.0) * 0.2, 1e-12);
  EXPECT_NEAR(sigma(kVelocity + 1), degToRad(2.0) * 0.6, 1e-12);
  // δv = δψ × v: a heading error to the right turns the velocity to the right
  EXPECT_GT(P_(kAttitude + 2, kVelocity + 1), 0.0);
  EXPECT_GT(P_(kAttitude + 2, kVelocity), 0.0);
  const ErrorCovariance once = P_;
  unseen.settle(state_, P_);
  EXPECT_EQ(P_, once);
}

TEST_F(UnseenMotionTest, ResetForgetsTheTurn) {
  UnseenMotion unseen(planet_, params_);
  unseen.begin(state_, 1.0, P_);
  unseen.reset();
  P_.setZero();
  state_.stamp += fromSeconds(10.0);
  unseen.settle(state_, P_);
  EXPECT_TRUE(P_.isZero());
}

}  // namespace
}  // namespace slipnav
