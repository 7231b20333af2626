#include "slipnav/core/ekf/engine/gated_update.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace slipnav::test {
namespace {

constexpr Nanoseconds kStart = 1'000'000'000'000;
constexpr double kSigma = 0.1;  ///< of the state and of the noise

FilterParams params() {
  FilterParams params;
  params.gate_alpha = 0.01;
  params.zero_velocity_gate_alpha = 1e-6;
  params.max_rejection_s = 2.0;
  return params;
}

/// Measures the north velocity (and with three rows all of it) with a residual of that many standard deviations.
Measurement velocityOff(double sigmas, int rows = 1) {
  Measurement m(rows);
  for (int row = 0; row < rows; ++row) {
    m.H(row, kVelocity + row) = 1.0;
    m.variance(row) = kSigma * kSigma;
  }
  m.residual(0) = sigmas * std::sqrt(2.0) * kSigma;
  return m;
}

/// What the filter does with those that pass.
std::optional<ErrorVector> updateWith(GatedUpdate& gates, MeasurementSet& set, Nanoseconds stamp, ErrorCovariance& P) {
  const std::optional<Measurement> passed = gates.select(set, stamp, P);
  return passed ? kalmanUpdate(*passed, P) : std::nullopt;
}

class GatedUpdateTest : public ::testing::Test {
 protected:
  std::optional<ErrorVector> apply(Component component, const Measurement& measurement, double t_s) {
    MeasurementSet set;
    set.add(component, measurement);
    return updateWith(update_, set, kStart + fromSeconds(t_s), P_);
  }

  GatedUpdate update_{params()};
  ErrorCovariance P_ = kSigma * kSigma * ErrorCovariance::Identity();
};

TEST_F(GatedUpdateTest, AcceptsUpToTheGateAndCounts) {
  ASSERT_TRUE(apply(kForwardSpeed, velocityOff(1.5), 0.0));
  const ComponentStatus& status = update_.status(kForwardSpeed);
  EXPECT_EQ(status.accepted, 1U);
  EXPECT_EQ(status.rejected, 0U);
  EXPECT_NEAR(status.last_nis, 2.25, 1e-12);
  EXPECT_NEAR(status.nis_sum, 2.25, 1e-12);
  EXPECT_EQ(update_.status(kYawRate).accepted, 0U);
  EXPECT_NEAR(P_(kVelocity, kVelocity), 0.5 * kSigma * kSigma, 1e-15);
}

TEST_F(GatedUpdateTest, RejectsOutliersAndLeavesTheCovariance) {
  const ErrorCovariance before = P_;
  // 1 % of one degree of freedom: 2.576 σ
  EXPECT_FALSE(apply(kForwardSpeed, velocityOff(2.6), 0.0));
  EXPECT_TRUE(P_ == before);
  EXPECT_EQ(update_.status(kForwardSpeed).rejected, 1U);
  EXPECT_EQ(update_.status(kForwardSpeed).accepted, 0U);
  EXPECT_EQ(update_.status(kForwardSpeed).rejected_since, kStart);
  EXPECT_EQ(update_.status(kForwardSpeed).nis_sum, 0.0);
  EXPECT_NEAR(update_.status(kForwardSpeed).last_nis, 2.6 * 2.6, 1e-12);
  EXPECT_TRUE(apply(kForwardSpeed, velocityOff(2.55), 0.1));
  EXPECT_EQ(update_.status(kForwardSpeed).rejected_since, 0);
}

TEST_F(GatedUpdateTest, CountsTheNisPerDegreeOfFreedom) {
  EXPECT_TRUE(apply(kFixPosition, velocityOff(3.0, 3), 0.0));
  EXPECT_NEAR(update_.status(kFixPosition).last_nis, 3.0, 1e-12);
}

TEST_F(GatedUpdateTest, OneThatFailsDoesNotKeepOthersOut) {
  MeasurementSet set;
  set.add(kForwardSpeed, velocityOff(50.0));
  Measurement east(1);
  east.H(0, kVelocity + 1) = 1.0;
  east.variance(0) = kSigma * kSigma;
  east.residual(0) = 0.1;
  set.add(kLateral, east);
  const std::optional<ErrorVector> error = updateWith(update_, set, kStart, P_);
  ASSERT_TRUE(error);
  EXPECT_EQ((*error)(kVelocity), 0.0);
  EXPECT_NEAR((*error)(kVelocity + 1), -0.05, 1e-15);
  EXPECT_EQ(update_.status(kForwardSpeed).rejected, 1U);
  EXPECT_EQ(update_.status(kLateral).accepted, 1U);
}

TEST_F(GatedUpdateTest, AllThatPassUpdateTogether) {
  Measurement second = velocityOff(0.0);
  second.H(0, kPosition) = 1.0;
  MeasurementSet set;
  set.add(kForwardSpeed, velocityOff(1.0));
  set.add(kVertical, second);
  ErrorCovariance together = P_;
  Measurement both(2);
  both.H.row(0) = velocityOff(1.0).H.row(0);
  both.H.row(1) = second.H.row(0);
  both.variance.setConstant(kSigma * kSigma);
  both.residual << velocityOff(1.0).residual(0), 0.0;
  const ErrorVector expected = kalmanUpdate(both, together).value();
  const std::optional<ErrorVector> error = updateWith(update_, set, kStart, P_);
  ASSERT_TRUE(error);
  EXPECT_LT((*error - expected).norm(), 1e-15);
  EXPECT_LT((P_ - together).norm(), 1e-15);
}

/// What contradicts for longer than max_rejection_s is the state: P is opened until the innovation is plausible.
TEST_F(GatedUpdateTest, PersistentContradictionOpensTheState) {
  const double sigmas = 10.0;
  for (double t_s = 0.0; t_s <= 1.95; t_s += 0.1) {
    ASSERT_FALSE(apply(kLateral, velocityOff(sigmas), t_s));
  }
  const double residual = velocityOff(sigmas).residual(0);
  const std::optional<ErrorVector> error = apply(kLateral, velocityOff(sigmas), 2.2);
  ASSERT_TRUE(error);
  EXPECT_LT((*error)(kVelocity), -0.9 * residual);  // the state gives way, not the measurement
  EXPECT_GT(P_(kVelocity, kVelocity), 0.9 * kSigma * kSigma);
  EXPECT_NEAR(P_(kPosition, kPosition), kSigma * kSigma, 1e-12);  // not correlated: not opened
  EXPECT_EQ(update_.status(kLateral).accepted, 1U);
  EXPECT_EQ(update_.status(kLateral).opened, 1U);
}

TEST_F(GatedUpdateTest, AnAgreementInBetweenStartsTheTimeAnew) {
  for (double t_s = 0.0; t_s <= 5.0; t_s += 0.1) {
    const bool agrees = std::lround(10.0 * t_s) % 10 == 9;
    EXPECT_EQ(apply(kLateral, velocityOff(agrees ? 0.0 : 100.0), t_s).has_value(), agrees) << t_s;
  }
}

/// Whatever the state says, a standstill that encoders and IMU agree on is used within a second.
TEST_F(GatedUpdateTest, AStandstillIsUsedWithinASecond) {
  for (const double sigmas : {10.0, 100.0, 1000.0}) {
    const ErrorCovariance before = P_;
    GatedUpdate fresh{params()};
    MeasurementSet set;
    set.add(kZeroVelocity, velocityOff(sigmas, 3));
    EXPECT_FALSE(updateWith(fresh, set, kStart, P_)) << "a single one may be an outlier";
    const std::optional<ErrorVector> error = updateWith(fresh, set, kStart + kSecond, P_);
    ASSERT_TRUE(error) << sigmas;
    EXPECT_LT((*error)(kVelocity), -0.9 * velocityOff(sigmas, 3).residual(0));
    P_ = before;
  }
}

/// Scrub contradicts the gyro for as long as a turn lasts, and a receiver may be wrong for minutes.
TEST_F(GatedUpdateTest, HeadingRatesAndFixesNeverOpenTheState) {
  const ErrorCovariance before = P_;
  for (double t_s = 0.0; t_s < 30.0; t_s += 0.1) {
    ASSERT_FALSE(apply(kYawRate, velocityOff(10.0), t_s));
    ASSERT_FALSE(apply(kFixPosition, velocityOff(10.0, 3), t_s));
  }
  EXPECT_TRUE(P_ == before);
}

TEST_F(GatedUpdateTest, ZeroMotionHasItsOwnWiderGate) {
  // three degrees of freedom: 1 % is 11.3, one in a million 30.7
  EXPECT_FALSE(apply(kFixPosition, velocityOff(5.0, 3), 0.0));
  const ErrorCovariance before = P_;
  for (const Component zero : {kZeroVelocity, kZeroRate}) {
    EXPECT_TRUE(apply(zero, velocityOff(5.0, 3), 0.0));
    P_ = before;
  }
  EXPECT_FALSE(apply(kZeroVelocity, velocityOff(6.0, 3), 0.0));
}

TEST_F(GatedUpdateTest, NotANumberIsRejected) {
  const ErrorCovariance before = P_;
  for (double t_s = 0.0; t_s < 10.0; t_s += 1.0) {
    EXPECT_FALSE(apply(kForwardSpeed, velocityOff(std::numeric_limits<double>::quiet_NaN()), t_s));
  }
  EXPECT_TRUE(P_ == before);
  EXPECT_EQ(update_.status(kForwardSpeed).rejected, 10U);
}

TEST_F(GatedUpdateTest, OtherGatesHoldFromThenOnAndTheCountsStay) {
  ASSERT_TRUE(apply(kForwardSpeed, velocityOff(2.0), 0.0));
  FilterParams narrow = params();
  narrow.gate_alpha = 0.2;  // 1.28 σ
  update_.retune(narrow);
  EXPECT_FALSE(apply(kForwardSpeed, velocityOff(2.0), 0.1));
  EXPECT_TRUE(apply(kForwardSpeed, velocityOff(1.0), 0.2));
  EXPECT_EQ(update_.status(kForwardSpeed).accepted, 2U);
  EXPECT_EQ(update_.status(kForwardSpeed).rejected, 1U);
}

TEST_F(GatedUpdateTest, ItsPatienceEndsExactlyWhenItIsSaidTo) {
  FilterParams other = params();
  other.max_rejection_s = 1.0;
  other.max_standstill_doubt_s = 0.5;
  update_.retune(other);
  const std::vector<std::pair<Component, double>> patience_s = {
      {kForwardSpeed, 1.0}, {kLateral, 1.0}, {kVertical, 1.0}, {kZeroVelocity, 0.5}, {kZeroRate, 0.5}};
  for (const auto& [component, seconds] : patience_s) {
    P_ = kSigma * kSigma * ErrorCovariance::Identity();
    EXPECT_FALSE(apply(component, velocityOff(20.0), 0.0));
    EXPECT_FALSE(apply(component, velocityOff(20.0), seconds - 1e-3)) << component;
    EXPECT_TRUE(apply(component, velocityOff(20.0), seconds)) << component;
    EXPECT_EQ(update_.status(component).rejected, 2U);
  }
}

}  // namespace
}  // namespace slipnav::test
