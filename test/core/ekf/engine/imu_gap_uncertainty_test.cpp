#include "slipnav/core/ekf/engine/imu_gap_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

class ImuGapUncertaintyTest : public ::testing::Test {
 protected:
  ImuGapUncertaintyTest() {
    params_.gap_rate_std_deg_per_s = 2.0;
    params_.gap_accel_std_mps2 = 0.5;
    params_.gap_max_tilt_deg = 3.0;
    state_.stamp = 1'000'000'000;
  }

  double sigma(int index) const { return std::sqrt(P_(index, index)); }

  void agree(ImuGapUncertainty& unseen, int times) {
    for (int i = 0; i < times; ++i) {
      unseen.standstill(true, P_);
    }
  }

  FilterParams params_;
  NavigationState state_;
  ErrorCovariance P_ = ErrorCovariance::Zero();
};

TEST_F(ImuGapUncertaintyTest, AddsWhatMayHaveHappened) {
  ImuGapUncertainty unseen(params_);
  unseen.begin(state_, 1.0, 0.0, P_);
  EXPECT_NEAR(sigma(kAttitude), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kAttitude + 2), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kVelocity), 0.5, 1e-12);
  EXPECT_NEAR(sigma(kPosition), 0.25, 1e-12);
}

/// A minute of silence, as of a clock that was set ahead, is no minute of speeding up.
TEST_F(ImuGapUncertaintyTest, AVehicleGoesAsFastAsItDoes) {
  ImuGapUncertainty unseen(params_);
  unseen.begin(state_, 60.0, 0.8, P_);
  EXPECT_NEAR(sigma(kVelocity), 1.6, 1e-12);
  EXPECT_NEAR(sigma(kPosition), 1.6 * (60.0 - 1.6), 1e-9) << "3.2 s to 1.6 m/s, and then on";
  P_.setZero();
  unseen.begin(state_, 1.0, 0.8, P_);
  EXPECT_NEAR(sigma(kPosition), 0.25, 1e-12);
}

TEST_F(ImuGapUncertaintyTest, TheGroundLimitsTheTiltButNotTheHeading) {
  ImuGapUncertainty unseen(params_);
  unseen.begin(state_, 5.0, 0.0, P_);
  EXPECT_NEAR(sigma(kAttitude + 1), degToRad(3.0), 1e-12);
  EXPECT_NEAR(sigma(kAttitude + 2), degToRad(10.0), 1e-12);
}

TEST_F(ImuGapUncertaintyTest, SoonAfterAGapAContradictionCastsDoubtOnTiltAndVelocity) {
  ImuGapUncertainty unseen(params_);
  unseen.begin(state_, 1.0, 0.0, P_);
  P_.setZero();
  unseen.doubt(state_.stamp + fromSeconds(9.9), P_);
  EXPECT_NEAR(sigma(kAttitude), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kVelocity + 2), 0.5, 1e-12);
  EXPECT_EQ(sigma(kAttitude + 2), 0.0);
  EXPECT_EQ(sigma(kPosition), 0.0);
  P_.setZero();
  unseen.doubt(state_.stamp + fromSeconds(19.0), P_);  // within the same time of the last doubt
  EXPECT_FALSE(P_.isZero());
  P_.setZero();
  unseen.doubt(state_.stamp + fromSeconds(30.0), P_);
  EXPECT_TRUE(P_.isZero());
}

TEST_F(ImuGapUncertaintyTest, AStandstillCastsDoubtUntilItHasBeenAgreedToForAWhile) {
  ImuGapUncertainty unseen(params_);
  unseen.standstill(false, P_);
  EXPECT_TRUE(P_.isZero());
  unseen.begin(state_, 1.0, 0.0, P_);
  unseen.standstill(true, P_);
  P_.setZero();
  unseen.standstill(false, P_);
  EXPECT_NEAR(sigma(kAttitude), degToRad(2.0), 1e-12);
  EXPECT_NEAR(sigma(kVelocity), 0.5, 1e-12);
  P_.setZero();
  agree(unseen, 10);
  unseen.standstill(false, P_);
  unseen.doubt(state_.stamp, P_);
  EXPECT_TRUE(P_.isZero());
}

TEST_F(ImuGapUncertaintyTest, AgreementThatIsInterruptedCountsFromTheBeginning) {
  ImuGapUncertainty unseen(params_);
  unseen.begin(state_, 1.0, 0.0, P_);
  for (int i = 0; i < 2; ++i) {
    agree(unseen, 9);
    P_.setZero();
    unseen.standstill(false, P_);
    EXPECT_NEAR(sigma(kVelocity), 0.5, 1e-12) << "one time too few";
  }
}

TEST_F(ImuGapUncertaintyTest, WithoutAGapNothingIsDoubted) {
  ImuGapUncertainty unseen(params_);
  unseen.doubt(state_.stamp, P_);
  EXPECT_TRUE(P_.isZero());
}

TEST_F(ImuGapUncertaintyTest, WayAndTurnAreInDoubtWhenNothingNeedHaveMoved) {
  NavigationState after = state_;
  after.stamp += fromSeconds(2.0);
  state_.v_eb_n = after.v_eb_n = Vector3(0.6, -0.8, 0.0);
  after.q_b_to_n = q_b_to_n_fromEuler(0.0, 0.0, 0.1);
  ImuGapUncertainty::allowForStandstill(state_, after, P_);
  EXPECT_NEAR(sigma(kPosition), 1.2, 1e-12);
  EXPECT_NEAR(sigma(kPosition + 1), 1.6, 1e-12);
  EXPECT_NEAR(P_(kPosition, kPosition + 1), -1.2 * 1.6, 1e-12);
  EXPECT_NEAR(sigma(kAttitude + 2), 0.1, 1e-12);
  EXPECT_EQ(sigma(kAttitude), 0.0);
}

/// Ten seconds after a gap, to the nanosecond.
TEST_F(ImuGapUncertaintyTest, IsSettledByWheelsAfterTenSeconds) {
  for (const Nanoseconds after : {10 * kSecond - 1, 10 * kSecond}) {
    ImuGapUncertainty unseen(params_);
    unseen.begin(state_, 1.0, 0.0, P_);
    P_.setZero();
    unseen.doubt(state_.stamp + after, P_);
    EXPECT_EQ(P_.isZero(), after == 10 * kSecond) << after;
  }
}

}  // namespace
}  // namespace slipnav
