#include "slipnav/core/ekf/engine/filter_history.h"

#include <gtest/gtest.h>

#include <vector>

#include "random_states.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kStart = 1'000 * kSecond;

class FilterHistoryTest : public ::testing::Test {
 protected:
  FilterHistoryTest() {
    nav_ = randomState(random_, 1.0);
    nav_.stamp = kStart;
    vehicle_ = randomVehicle(random_);
    P_ = randomCovariance(random_);
    history_.begin(P_);
  }

  void step(Nanoseconds interval) {
    nav_.stamp += interval;
    history_.endStep(nav_, vehicle_, rate_, P_);
  }

  sim::RandomStream random_{1, "history"};
  const Planet planet_ = Planet::byName("earth");
  FilterHistory history_{planet_};
  NavigationState nav_;
  VehicleState vehicle_;
  Vector3 rate_{0.1, 0.2, 0.3};
  ErrorCovariance P_;
};

TEST_F(FilterHistoryTest, KeepsTenEpochsASecondAndTheLastOne) {
  for (int i = 0; i < 53; ++i) {
    step(kSecond / 50);
  }
  const std::vector<SmoothedState> epochs = history_.smooth();
  ASSERT_EQ(epochs.size(), 12U);
  EXPECT_EQ(epochs[0].nav.stamp, kStart + kSecond / 50);
  EXPECT_EQ(epochs[1].nav.stamp, kStart + 6 * kSecond / 50);
  EXPECT_EQ(epochs[11].nav.stamp, kStart + 53 * kSecond / 50);
  EXPECT_EQ(history_.smooth().size(), 12U);
}

TEST_F(FilterHistoryTest, KeepsEveryStepOfASlowSensorAndNothingOfTheStartBefore) {
  step(kSecond);
  step(kSecond);
  EXPECT_EQ(history_.smooth().size(), 2U);
  history_.begin(P_);
  EXPECT_TRUE(history_.smooth().empty());
  step(kSecond);
  EXPECT_EQ(history_.smooth().size(), 1U);
}

/// A millisecond less than a tenth of a second.
TEST_F(FilterHistoryTest, StepsAreKeptOnceTheyAreFarEnoughApart) {
  step(kSecond);
  step(98 * kSecond / 1000);
  step(kSecond / 1000);
  step(99 * kSecond / 1000 - 1);
  step(1);
  std::vector<Nanoseconds> kept;
  for (const SmoothedState& epoch : history_.smooth()) {
    kept.push_back(epoch.nav.stamp - kStart - kSecond);
  }
  EXPECT_EQ(kept, (std::vector<Nanoseconds>{0, 99 * kSecond / 1000, 198 * kSecond / 1000}));
}

TEST_F(FilterHistoryTest, AStepThatWasNotKeptIsForgottenWithItsDrive) {
  step(kSecond);
  step(kSecond / 50);
  history_.begin(P_);
  EXPECT_TRUE(history_.smooth().empty());
}

/// Nothing has moved and nothing was added: what a later measurement says of the end holds for the beginning as well.
TEST_F(FilterHistoryTest, TakesACorrectionBackToTheEpochsBefore) {
  step(kSecond);
  history_.advance(P_);
  ErrorVector error = ErrorVector::Zero();
  for (int i = 0; i < kYawScale; ++i) {
    error(i) = 0.01 * random_.normal();
  }
  const ErrorReset reset = correct(planet_, error, nav_);
  subtractError(error, vehicle_);
  P_ *= 0.5;
  applyReset(reset, P_);
  history_.correct(error, reset, P_);
  step(kSecond);
  const std::vector<SmoothedState> epochs = history_.smooth();
  ASSERT_EQ(epochs.size(), 2U);
  EXPECT_EQ(epochs[1].nav.v_eb_n, nav_.v_eb_n);
  EXPECT_EQ(epochs[1].P, P_);
  EXPECT_LT(errorBetween(planet_, epochs[0].nav, nav_).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(epochs[0].vehicle.slow_slip, vehicle_.slow_slip, 1e-10);
  EXPECT_NEAR(epochs[0].vehicle.mount_yaw_rad, vehicle_.mount_yaw_rad, 1e-10);
  EXPECT_LT((epochs[0].omega_ib_b - rate_ - error.segment<3>(kGyroBias)).norm(), 1e-10);
  const ErrorVector weight = P_.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_LT((weight.asDiagonal() * (epochs[0].P - P_) * weight.asDiagonal()).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace slipnav::test
