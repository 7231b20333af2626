#include "slipnav/core/ekf/kalman_update.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "random_states.h"

namespace slipnav::test {
namespace {

Measurement randomMeasurement(sim::RandomStream& random, int rows, const ErrorCovariance& P) {
  Measurement m(rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < kErrorStates; ++column) {
      m.H(row, column) = random.normal();
    }
    const double predicted = m.H.row(row).dot(P * m.H.row(row).transpose());
    m.variance(row) = random.uniform(0.1, 2.0) * predicted;
    m.residual(row) = std::sqrt(predicted) * random.normal();
  }
  return m;
}

double smallestEigenvalueOfCorrelation(const ErrorCovariance& P) {
  const ErrorVector scale = P.diagonal().cwiseSqrt().cwiseInverse();
  const ErrorCovariance correlation = scale.asDiagonal() * P * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<ErrorCovariance>(correlation).eigenvalues().minCoeff();
}

struct Reference {
  ErrorVector error;
  ErrorCovariance P;
};

/// The textbook's dense Joseph form with the gain of the considered state set to zero.
Reference joseph(const Measurement& m, const ErrorCovariance& P) {
  const Eigen::MatrixXd H = m.H;
  const Eigen::MatrixXd R = Eigen::VectorXd(m.variance).asDiagonal();
  const Eigen::MatrixXd S = H * P * H.transpose() + R;
  Eigen::MatrixXd K = P * H.transpose() * S.inverse();
  K.row(kYawScale).setZero();
  const Eigen::MatrixXd remainder = Eigen::MatrixXd::Identity(kErrorStates, kErrorStates) - K * H;
  return {-K * m.residual, remainder * P * remainder.transpose() + K * R * K.transpose()};
}

double largestRelativeDifference(const ErrorCovariance& a, const ErrorCovariance& b) {
  const ErrorVector sigma = b.diagonal().cwiseSqrt();
  return ((a - b).array() / (sigma * sigma.transpose()).array()).abs().maxCoeff();
}

TEST(KalmanUpdate, IsTheTextbooksJosephForm) {
  sim::RandomStream random(1, "update");
  for (int i = 0; i < 50; ++i) {
    ErrorCovariance P = randomCovariance(random);
    const ErrorCovariance before = P;
    const Measurement m = randomMeasurement(random, 1 + i % kMaxMeasurementRows, P);
    const Reference expected = joseph(m, P);
    const std::optional<ErrorVector> error = kalmanUpdate(m, P);
    ASSERT_TRUE(error);
    EXPECT_LT(largestRelativeDifference(P, expected.P), 1e-12);
    EXPECT_LT((*error - expected.error).cwiseQuotient(before.diagonal().cwiseSqrt()).norm(), 1e-11);
    EXPECT_GT(largestRelativeDifference(before, expected.P), 1e-3);
  }
}

TEST(KalmanUpdate, GainIsThatOfTheTextbook) {
  sim::RandomStream random(5, "update");
  for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
    ErrorCovariance P = randomCovariance(random);
    const Measurement m = randomMeasurement(random, rows, P);
    const Eigen::MatrixXd H = m.H;
    const Eigen::MatrixXd R = Eigen::VectorXd(m.variance).asDiagonal();
    Eigen::MatrixXd expected = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    expected.row(kYawScale).setZero();
    const ErrorVector sigma = P.diagonal().cwiseSqrt();
    const ErrorCovariance updated = joseph(m, P).P;
    const ErrorCovariance before = P;
    const std::optional<UpdateGain> used = updateCovariance(m, P);
    ASSERT_TRUE(used);
    EXPECT_LT((used->S.reconstructedMatrix() - (H * before * H.transpose() + R)).norm(),
              1e-12 * used->S.reconstructedMatrix().norm());
    EXPECT_LT((sigma.cwiseInverse().asDiagonal() * (used->K - expected)).norm(),
              1e-11 * (sigma.cwiseInverse().asDiagonal() * expected).norm());
    EXPECT_LT(largestRelativeDifference(P, updated), 1e-12);
  }
}

/// (I − K H) P (I − K H)ᵀ + K R Kᵀ for a gain that is far from optimal.
TEST(KalmanUpdate, JosephTermsHoldForAnyGain) {
  sim::RandomStream random(6, "update");
  for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
    ErrorCovariance P = randomCovariance(random);
    const Measurement m = randomMeasurement(random, rows, P);
    KalmanGain K = covarianceWithPrediction(m.H, P);
    for (int row = 0; row < rows; ++row) {
      K.col(row) *= random.uniform(-0.5, 0.5) / m.variance(row);
    }
    const Eigen::MatrixXd H = m.H;
    const Eigen::MatrixXd R = Eigen::VectorXd(m.variance).asDiagonal();
    const Eigen::MatrixXd remainder = Eigen::MatrixXd::Identity(kErrorStates, kErrorStates) - K * H;
    const ErrorCovariance expected = remainder * P * remainder.transpose() + K * R * K.transpose();
    const InnovationCovariance S = H * P * H.transpose() + R;
    addJosephTerms(K, P * H.transpose(), S, P);
    EXPECT_LT(largestRelativeDifference(P, expected), 1e-12);
    EXPECT_EQ(P, P.transpose());
  }
}

/// One row that sees one state: the scalar formulas, with the sign of the residual.
TEST(KalmanUpdate, MovesTheEstimateTowardsTheMeasurement) {
  ErrorCovariance P = ErrorCovariance::Identity();
  P(kVelocity, kVelocity) = 4.0;
  P(kPosition, kVelocity) = P(kVelocity, kPosition) = 1.0;
  Measurement m(1);
  m.H(0, kVelocity) = 1.0;
  m.variance(0) = 1.0;
  m.residual(0) = 2.0;  // measured is larger than predicted: the estimate is too small, its error negative
  const std::optional<ErrorVector> error = kalmanUpdate(m, P);
  ASSERT_TRUE(error);
  EXPECT_NEAR((*error)(kVelocity), -1.6, 1e-15);
  EXPECT_NEAR((*error)(kPosition), -0.4, 1e-15);
  EXPECT_NEAR(P(kVelocity, kVelocity), 0.8, 1e-15);
  EXPECT_NEAR(P(kPosition, kPosition), 0.8, 1e-15);
}

TEST(KalmanUpdate, StaysSymmetricAndPositiveDefinite) {
  sim::RandomStream random(2, "update");
  ErrorCovariance P = randomCovariance(random);
  for (int i = 0; i < 2000; ++i) {
    Measurement m = randomMeasurement(random, 1 + i % kMaxMeasurementRows, P);
    m.variance *= i % 10 == 0 ? 1e-6 : 1.0;  // very precise ones are what breaks the short form
    ASSERT_TRUE(kalmanUpdate(m, P));
    ASSERT_TRUE(P == P.transpose());
    P += 1e-3 * randomCovariance(random);
  }
  EXPECT_GT(smallestEigenvalueOfCorrelation(P), 1e-8);
}

/// Schmidt's partitioned formulas: the considered state is known no better, what is correlated with it stays
/// correlated.
TEST(KalmanUpdate, ConsideredStateIsNotEstimatedButKeepsItsCorrelations) {
  sim::RandomStream random(3, "update");
  constexpr int n = kErrorStates - 1;
  static_assert(kYawScale == n, "the partition below takes it for the last");
  for (int i = 0; i < 20; ++i) {
    ErrorCovariance P = randomCovariance(random);
    const ErrorCovariance before = P;
    const Measurement m = randomMeasurement(random, 2, P);
    const std::optional<ErrorVector> error = kalmanUpdate(m, P);
    ASSERT_TRUE(error);
    EXPECT_EQ((*error)(kYawScale), 0.0);
    EXPECT_DOUBLE_EQ(P(kYawScale, kYawScale), before(kYawScale, kYawScale));

    const Eigen::MatrixXd Pxx = before.topLeftCorner<n, n>();
    const Eigen::VectorXd Pxc = before.block<n, 1>(0, n);
    const double Pcc = before(n, n);
    const Eigen::MatrixXd Hx = m.H.leftCols<n>();
    const Eigen::VectorXd Hc = m.H.col(n);
    const Eigen::MatrixXd R = Eigen::VectorXd(m.variance).asDiagonal();
    const Eigen::MatrixXd S = Hx * Pxx * Hx.transpose() + Hx * Pxc * Hc.transpose() +
                              Hc * Pxc.transpose() * Hx.transpose() + Hc * Pcc * Hc.transpose() + R;
    const Eigen::MatrixXd K = (Pxx * Hx.transpose() + Pxc * Hc.transpose()) * S.inverse();
    const Eigen::VectorXd kept = Pxc - K * (Hx * Pxc + Hc * Pcc);
    const Eigen::MatrixXd left = Pxx - K * (Hx * Pxx + Hc * Pxc.transpose());
    ErrorCovariance expected;
    expected << left, kept, kept.transpose(), Pcc;
    EXPECT_LT(largestRelativeDifference(P, expected), 1e-12);
    EXPECT_GT((kept - Pxc).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(KalmanUpdate, TheSizeOfAnInnovationIsThatOfItsDensity) {
  sim::RandomStream random(6, "update");
  for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
    const ErrorCovariance P = randomCovariance(random);
    const Measurement m = randomMeasurement(random, rows, P);
    const Eigen::MatrixXd R = m.variance.asDiagonal();
    const Eigen::MatrixXd S = m.H * P * m.H.transpose() + R;
    const std::optional<InnovationSize> size = innovationSize(m, P);
    ASSERT_TRUE(size);
    EXPECT_EQ(size->rows, rows);
    EXPECT_NEAR(size->log_determinant, std::log(S.determinant()), 1e-9 * std::abs(std::log(S.determinant())));
    EXPECT_DOUBLE_EQ(size->squared, *normalizedInnovationSquared(m, P));
  }
}

TEST(KalmanUpdate, BadInputLeavesEverythingUntouched) {
  sim::RandomStream random(4, "update");
  ErrorCovariance P = randomCovariance(random);
  const ErrorCovariance before = P;
  const Measurement good = randomMeasurement(random, 3, P);
  const auto isRefused = [&](auto&& change) {
    Measurement bad = good;
    change(bad);
    return !kalmanUpdate(bad, P) && !normalizedInnovationSquared(bad, P) && !innovationSize(bad, P) && P == before;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isRefused([&](Measurement& m) { m.residual(1) = nan; }));
  EXPECT_TRUE(isRefused([&](Measurement& m) { m.residual(0) = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(isRefused([&](Measurement& m) { m.H(2, 5) = nan; }));
  EXPECT_TRUE(isRefused([&](Measurement& m) { m.variance(0) = nan; }));
  EXPECT_TRUE(isRefused([&](Measurement& m) { m.variance(1) = -1e9; }));
  EXPECT_TRUE(kalmanUpdate(good, P));

  ErrorCovariance not_positive = before;
  not_positive(kVelocity, kVelocity) = -1e9;
  const ErrorCovariance broken = not_positive;
  EXPECT_FALSE(kalmanUpdate(good, not_positive));
  EXPECT_TRUE(not_positive == broken);
}

TEST(KalmanUpdate, NormalizedInnovationIsThatOfTheDenseFormula) {
  sim::RandomStream random(5, "update");
  const ErrorCovariance P = randomCovariance(random);
  for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
    const Measurement m = randomMeasurement(random, rows, P);
    const Eigen::MatrixXd H = m.H;
    const Eigen::MatrixXd R = Eigen::VectorXd(m.variance).asDiagonal();
    const Eigen::VectorXd r = m.residual;
    const double expected = r.dot((H * P * H.transpose() + R).inverse() * r);
    EXPECT_NEAR(normalizedInnovationSquared(m, P).value(), expected, 1e-10 * expected);
  }
}

TEST(KalmanUpdate, ChiSquareQuantilesAreThoseOfTheTables) {
  // NIST/SEMATECH e-Handbook, table 1.3.6.7.4
  EXPECT_NEAR(chiSquareQuantile(1, 0.05), 3.841, 5e-4);
  EXPECT_NEAR(chiSquareQuantile(3, 0.05), 7.815, 5e-4);
  EXPECT_NEAR(chiSquareQuantile(1, 0.001), 10.828, 5e-4);
  EXPECT_NEAR(chiSquareQuantile(6, 0.01), 16.812, 5e-4);
  EXPECT_NEAR(chiSquareQuantile(6, 0.99), 0.872, 5e-4);
  EXPECT_THROW(chiSquareQuantile(0, 0.05), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(3, 0.0), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(3, 1.0), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(3, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav::test
