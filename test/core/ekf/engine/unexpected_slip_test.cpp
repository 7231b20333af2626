#include "slipnav/core/ekf/engine/unexpected_slip.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "random_states.h"
#include "recorded_drive.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

constexpr int kTerms = UnexpectedSlip::kTerms;
constexpr int kAll = kErrorStates + kTerms;
constexpr int kSteps = 60;
constexpr double kStepWay_m = 0.5;
constexpr double kWay_m = kSteps * kStepWay_m;

ErrorTransition randomTransition(sim::RandomStream& random) {
  ErrorTransition t;
  t.nav.setZero();
  t.nav.leftCols<9>().setIdentity();
  t.nav = t.nav.unaryExpr([&](double entry) { return entry + 0.02 * random.normal(); });
  t.attitude_from_yaw_scale.setZero();
  t.velocity_from_yaw_scale.setZero();
  t.motion_from_offset.setConstant(0.01 * random.normal());
  t.decay.setConstant(0.95);
  t.noise.setConstant(1e-4);
  return t;
}

Measurement randomMeasurement(sim::RandomStream& random) {
  Measurement m(2);
  for (int row = 0; row < 2; ++row) {
    m.H.row(row) = Eigen::RowVectorXd::NullaryExpr(kErrorStates, [&] { return random.normal(); });
    m.variance(row) = 0.05;
  }
  return m;
}

/// A filter to which the coefficients of the slip are states.
struct WholeFilter {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(kAll);
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(kAll, kAll);

  void propagate(const ErrorTransition& t, double way_m) {
    Eigen::MatrixXd phi = Eigen::MatrixXd::Identity(kAll, kAll);
    phi.topLeftCorner<kErrorStates, kErrorStates>() = t.matrix();
    const double decay = t.decay(kSlowSlip - 9);
    for (int k = 0; k < kTerms; ++k) {
      phi(kSlowSlip, kErrorStates + k) = std::pow(way_m + kStepWay_m, k) - decay * std::pow(way_m, k);
    }
    Eigen::MatrixXd half = Eigen::MatrixXd::Zero(kAll, kAll);
    half.diagonal().head<kErrorStates>() = 0.5 * t.noise;
    x = phi * x;
    P = phi * (P + half) * phi.transpose() + half;
  }

  void update(const Measurement& m, const Eigen::VectorXd& measured) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m.H.rows(), kAll);
    H.leftCols<kErrorStates>() = m.H;
    const Eigen::MatrixXd S = H * P * H.transpose() + Eigen::MatrixXd(m.variance.asDiagonal());
    const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
    x += K * (measured - H * x);
    P = ((Eigen::MatrixXd::Identity(kAll, kAll) - K * H) * P).eval();
  }
};

/// The filter without them and what runs beside it are together as good.
TEST(UnexpectedSlip, IsAsIfItHadBeenEstimatedFromTheBegin) {
  sim::RandomStream random(3, "unexpected slip");
  ErrorCovariance P = randomCovariance(random);
  P.row(kYawScale).setZero();
  P.col(kYawScale).setZero();
  ErrorVector x = ErrorVector::Zero();
  UnexpectedSlip beside;
  WholeFilter whole;
  whole.P.topLeftCorner<kErrorStates, kErrorStates>() = P;
  for (int k = 0; k < kTerms; ++k) {
    whole.P(kErrorStates + k, kErrorStates + k) = std::pow(kWay_m, -2 * k);
  }
  // A slip that is constant is there from the begin.
  whole.P(kSlowSlip, kSlowSlip) += 1.0;
  whole.P(kSlowSlip, kErrorStates) = whole.P(kErrorStates, kSlowSlip) = 1.0;
  for (int step = 0; step < kSteps; ++step) {
    ErrorTransition t = randomTransition(random);
    t.noise(kYawScale) = 0.0;
    beside.propagate(t, kStepWay_m);
    ErrorDynamics::propagate(t, P);
    x = t.matrix() * x;
    whole.propagate(t, step * kStepWay_m);
    const Measurement model = randomMeasurement(random);
    const Eigen::VectorXd measured = Eigen::VectorXd::NullaryExpr(2, [&] { return random.normal(); });
    Measurement m = model;
    m.residual = measured - model.H * x;
    const std::optional<UpdateGain> used = updateCovariance(m, P);
    ASSERT_TRUE(used);
    beside.update(m, *used, true);
    x += used->K * m.residual;
    whole.update(model, measured);
  }
  const std::optional<UnexpectedSlip::Finding> found = beside.finding();
  ASSERT_TRUE(found);
  const ErrorVector expected = whole.x.head<kErrorStates>();
  EXPECT_GT((x - expected).norm(), 0.01 * expected.norm()) << "nothing to find";
  EXPECT_LT((x - found->error - expected).norm(), 1e-8 * expected.norm());
  const ErrorCovariance P_expected = whole.P.topLeftCorner<kErrorStates, kErrorStates>();
  EXPECT_GT((P - P_expected).norm(), 0.01 * P_expected.norm()) << "nothing to find";
  EXPECT_LT((P + found->P - P_expected).norm(), 1e-8 * P_expected.norm());
}

TEST(UnexpectedSlip, OfWhatNobodyMeasuredIsNothing) {
  sim::RandomStream random(4, "unexpected slip");
  ErrorCovariance P = randomCovariance(random);
  UnexpectedSlip slip;
  slip.propagate(randomTransition(random), 2.0);
  Measurement m = randomMeasurement(random);
  m.residual.setConstant(5.0);
  slip.update(m, updateCovariance(m, P).value(), false);
  EXPECT_EQ(slip.finding()->squared, 0.0);
  m.residual.setConstant(5.0);
  slip.update(m, updateCovariance(m, P).value(), true);
  EXPECT_GT(slip.finding()->squared, 0.0);
}

TEST(UnexpectedSlip, HasDoneNothingToAStateThatIsForgotten) {
  sim::RandomStream random(6, "unexpected slip");
  ErrorCovariance P = randomCovariance(random);
  UnexpectedSlip slip;
  slip.propagate(randomTransition(random), 2.0);
  Measurement m = randomMeasurement(random);
  m.residual.setConstant(5.0);
  slip.update(m, updateCovariance(m, P).value(), true);
  EXPECT_NE(slip.finding()->error(kPosition), 0.0);
  slip.forget(kPosition);
  const UnexpectedSlip::Finding found = slip.finding().value();
  EXPECT_EQ(found.error(kPosition), 0.0);
  EXPECT_EQ(found.P.row(kPosition).norm(), 0.0);
  EXPECT_NE(found.error(kVelocity), 0.0);
}

TEST(UnexpectedSlip, NeedsAWay) {
  sim::RandomStream random(5, "unexpected slip");
  UnexpectedSlip slip;
  EXPECT_FALSE(slip.finding());
  slip.propagate(randomTransition(random), 2.0);
  EXPECT_TRUE(slip.finding());
  slip.begin();
  EXPECT_FALSE(slip.finding());
}

/// Half of the way on sand that begins gradually: the drive's only stop is its end.
TEST(UnexpectedSlip, IsFoundAtTheStop) {
  Config config = driveConfig(50.0);
  config.simulator.terrain = "unpaved";
  config.simulator.ground.slip_offset = 0.4;
  const RecordedDrive drive = recordDrive(config);
  const EstimateLog log = runNavigator(config, drive.initial, drive.samples);
  const auto first_stop = std::find_if(log.begin(), log.end(), [&](const LoggedEstimate& logged) {
    return logged.estimate.stationary && logged.estimate.nav.stamp > drive.initial.nav.stamp + 20 * kSecond;
  });
  ASSERT_NE(first_stop, log.end());
  const Planet planet = Planet::byName(config.planet);
  const auto off_m = [&](const LoggedEstimate& logged) {
    return positionDifference(planet, logged.estimate.nav.position, drive.end.position).head<2>().norm();
  };
  const double before_m = off_m(*std::prev(first_stop));
  const double after_m = off_m(log.back());
  const auto std_m = [](const LoggedEstimate& logged) {
    return std::sqrt(logged.P(kPosition, kPosition) + logged.P(kPosition + 1, kPosition + 1));
  };
  EXPECT_GT(before_m, 3.0 * std_m(*std::prev(first_stop))) << "nothing to find";
  EXPECT_LT(after_m, 0.5 * before_m);
  EXPECT_LT(after_m, 3.0 * std_m(log.back()));
}

}  // namespace
}  // namespace slipnav::test
