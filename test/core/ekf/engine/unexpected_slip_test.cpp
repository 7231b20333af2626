#include "slipnav/core/ekf/engine/unexpected_slip.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/navigation/navigator.h"
#include "random_states.h"
#include "recorded_drive.h"
#include "simulation/random.h"
#include "slipnav/core/navigation/health.h"

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
  UnexpectedSlip beside(1.0);
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
  const UnexpectedSlip::Finding found = beside.finding();
  const ErrorVector expected = whole.x.head<kErrorStates>();
  EXPECT_GT((x - expected).norm(), 0.01 * expected.norm()) << "nothing to find";
  EXPECT_LT((x - found.error - expected).norm(), 1e-8 * expected.norm());
  const ErrorCovariance P_expected = whole.P.topLeftCorner<kErrorStates, kErrorStates>();
  EXPECT_GT((P - P_expected).norm(), 0.01 * P_expected.norm()) << "nothing to find";
  EXPECT_LT((P + found.P - P_expected).norm(), 1e-8 * P_expected.norm());
}

/// A way on which every measurement contradicts.
class ContradictedWay {
 public:
  explicit ContradictedWay(std::uint64_t seed) : random_(seed, "unexpected slip"), P_(randomCovariance(random_)) {}

  void drive(double way_m, bool is_evidence = true) {
    slip.propagate(randomTransition(random_), way_m);
    Measurement m = randomMeasurement(random_);
    m.residual.setConstant(5.0);
    slip.update(m, updateCovariance(m, P_).value(), is_evidence);
  }

  UnexpectedSlip slip{1.0};

 private:
  sim::RandomStream random_;
  ErrorCovariance P_;
};

TEST(UnexpectedSlip, OfWhatNobodyMeasuredIsNothing) {
  ContradictedWay way(4);
  way.drive(2.0, false);
  EXPECT_EQ(way.slip.squared(), 0.0);
  way.drive(0.1);
  EXPECT_GT(way.slip.squared(), 0.0);
}

TEST(UnexpectedSlip, HasDoneNothingToAStateThatIsForgotten) {
  ContradictedWay way(6);
  UnexpectedSlip& slip = way.slip;
  way.drive(2.0);
  EXPECT_NE(slip.finding().error(kPosition), 0.0);
  slip.forget(kPosition);
  const UnexpectedSlip::Finding found = slip.finding();
  EXPECT_EQ(found.error(kPosition), 0.0);
  EXPECT_EQ(found.P.row(kPosition).norm(), 0.0);
  EXPECT_NE(found.error(kVelocity), 0.0);
}

TEST(UnexpectedSlip, NeedsAWay) {
  ContradictedWay way(5);
  way.drive(0.9);
  EXPECT_EQ(way.slip.squared(), 0.0);
  way.drive(0.2);
  EXPECT_GT(way.slip.squared(), 0.0);
  way.slip.begin();
  EXPECT_EQ(way.slip.squared(), 0.0);
  way.drive(0.5);
  EXPECT_EQ(way.slip.squared(), 0.0) << "a new one";
}

constexpr const char* kAlarm = "slip unnoticed for meters: velocity and position corrected";

/// A drive without stops, after which the filter stands still at the end of its samples.
struct Outcome {
  EstimateLog log;
  std::uint64_t slips = 0;
  Alarms alarms;
};

Outcome runWithHealth(const Config& config, const InitialState& initial, const std::vector<DriveSample>& samples) {
  const NavigationSetup setup = config.navigation();
  Navigator navigator(Planet::byName(config.planet), setup.imu_input, setup.filter);
  navigator.initialize(initial);
  HealthMonitor health(setup.filter);
  Outcome run;
  const auto sink = [&run](const Estimate& estimate, const ErrorCovariance& P) { run.log.push_back({estimate, P}); };
  for (const DriveSample& sample : samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, sink);
    } else {
      navigator.push(sample.wheels, sink);
    }
    health.noteFilter(navigator.filter());
  }
  run.slips = navigator.filter().unexpectedSlips();
  run.alarms = health.alarms();
  return run;
}

/// A way on loose ground that is too short to show it: the drive's only stop does, at its end.
TEST(UnexpectedSlip, IsFoundAtTheStop) {
  Config config = driveConfig(40.0);
  config.simulator.terrain = "gravel";
  config.simulator.ground.slip_offset = 0.25;
  const RecordedDrive drive = recordDrive(config);
  const Outcome run = runWithHealth(config, drive.initial, drive.samples);
  const auto first_stop = std::find_if(run.log.begin(), run.log.end(), [&](const LoggedEstimate& logged) {
    return logged.estimate.stationary && logged.estimate.nav.stamp > drive.initial.nav.stamp + 20 * kSecond;
  });
  ASSERT_NE(first_stop, run.log.end());
  ASSERT_EQ(run.alarms.count(kAlarm), 1U);
  EXPECT_GE(run.alarms.at(kAlarm).first, first_stop->estimate.nav.stamp);
  const Planet planet = Planet::byName(config.planet);
  const auto off_m = [&](const LoggedEstimate& logged) {
    return positionDifference(planet, logged.estimate.nav.position, drive.end.position).head<2>().norm();
  };
  const double before_m = off_m(*std::prev(first_stop));
  const double after_m = off_m(run.log.back());
  const ErrorCovariance& P = run.log.back().P;
  EXPECT_LT(after_m, 0.5 * before_m);
  EXPECT_LT(after_m, 3.0 * std::sqrt(P(kPosition, kPosition) + P(kPosition + 1, kPosition + 1)));
}

/// The last estimate at speed.
const LoggedEstimate& lastAtSpeed(const EstimateLog& log) {
  return *std::find_if(log.rbegin(), log.rend(), [](const LoggedEstimate& logged) {
    return !logged.estimate.stationary && logged.estimate.nav.v_eb_n.norm() > 0.2;
  });
}

/// Sand that begins gradually, and no stop that would show it.
TEST(UnexpectedSlip, IsFoundWhileDriving) {
  constexpr double kDistance_m = 200.0;
  Config config = driveConfig(kDistance_m);
  config.simulator.terrain = "gravel";
  config.simulator.ground.slip_offset = 0.4;
  const RecordedDrive drive = recordDrive(config);
  const Outcome run = runWithHealth(config, drive.initial, drive.samples);
  EXPECT_GE(run.slips, 1U);
  EXPECT_EQ(run.alarms.count(kAlarm), 1U);
  const NavigationState& last = lastAtSpeed(run.log).estimate.nav;
  const Vector3 off = positionDifference(Planet::byName(config.planet), last.position, drive.end.position);
  EXPECT_LT(off.head<2>().norm(), 0.06 * kDistance_m);
}

/// Many lengths of the slow slip later: it has not returned to zero.
TEST(UnexpectedSlip, LastsOnceItIsFound) {
  constexpr double kSlip = 0.4;
  Config config = driveConfig(300.0);
  config.vehicle.slow_slip_length_m = 24.0;
  config.simulator.terrain = "paved";
  config.simulator.ground.slip_offset = kSlip;
  const RecordedDrive drive = recordDrive(config);
  const Outcome run = runWithHealth(config, drive.initial, drive.samples);
  ASSERT_EQ(run.alarms.count(kAlarm), 1U);
  double least = kSlip;
  for (const LoggedEstimate& logged : run.log) {
    if (logged.estimate.nav.stamp > run.alarms.at(kAlarm).first) {
      least = std::min(least, logged.estimate.vehicle.slow_slip);
    }
  }
  EXPECT_GT(least, 0.4 * kSlip);
}

/// Wheels half as large as configured; nothing slips like that.
TEST(UnexpectedSlip, IsNoSlipThatNoGroundHas) {
  Config config = driveConfig(60.0);
  config.simulator.terrain = "paved";
  const RecordedDrive drive = recordDrive(config);
  EXPECT_EQ(runWithHealth(config, drive.initial, drive.samples).slips, 0U) << "sound wheels";
  std::vector<DriveSample> samples = drive.samples;
  for (DriveSample& sample : samples) {
    sample.wheels.motion.forward_mps *= 0.55;
    for (double& speed : sample.wheels.circumferential_mps) {
      speed *= 0.55;
    }
    sample.wheels.largest_speed_mps *= 0.55;
  }
  EXPECT_EQ(runWithHealth(config, drive.initial, samples).slips, 0U);
}

TEST(UnexpectedSlip, IsNotThereWhereNoneIsConfigured) {
  Config config = driveConfig(50.0);
  config.simulator.terrain = "unpaved";
  config.simulator.ground.slip_offset = 0.4;
  const RecordedDrive drive = recordDrive(config);
  EXPECT_GE(runWithHealth(config, drive.initial, drive.samples).slips, 1U);
  config.vehicle.slow_slip_std = 0.0;
  EXPECT_EQ(runWithHealth(config, drive.initial, drive.samples).slips, 0U);
}

}  // namespace
}  // namespace slipnav::test
