/// An operator puts the estimate to another place while the filter runs.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "recorded_drive.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav::test {
namespace {

class PoseOverrideTest : public ::testing::Test {
 protected:
  PoseOverrideTest() { filter_.initialize(drive_.initial); }

  /// Mechanizes and filters the first seconds of the drive.
  void run(double until_s) {
    InsEngine ins(Planet::byName("earth"), setup_.imu_input);
    ins.initialize(drive_.initial.nav);
    for (const DriveSample& sample : drive_.samples) {
      if (sample.is_imu && toSeconds(sample.stamp() - drive_.initial.nav.stamp) < until_s) {
        ins.push(sample.imu);
      }
    }
    while (const std::optional<InsStep> step = ins.step()) {
      filter_.push(*step);
    }
    filter_.advance([](const Estimate&, const ErrorCovariance&) {});
  }

  PoseOverride pose() const {
    PoseOverride pose;
    pose.position = filter_.state().position;
    pose.position.height_m += 5.0;
    pose.position_std_m = 0.5;
    return pose;
  }

  static Config config() {
    Config config = driveConfig(2.0);
    config.filter.updates = {};
    return config;
  }

  const RecordedDrive drive_ = recordDrive(config());
  const NavigationSetup setup_ = config().navigation();
  FilterEngine filter_{Planet::byName("earth"), setup_.filter};
};

TEST_F(PoseOverrideTest, ThePositionIsTakenOver) {
  run(8.0);
  const NavigationState before = filter_.state();
  const Correction correction = filter_.place(pose());
  EXPECT_EQ(correction.state.position.height_m, before.position.height_m + 5.0);
  EXPECT_EQ(correction.state.stamp, before.stamp);
  EXPECT_EQ(correction.state.q_b_to_n.coeffs(), before.q_b_to_n.coeffs());
  EXPECT_EQ(correction.epoch, 1U);
  EXPECT_DOUBLE_EQ(filter_.covariance()(kPosition + 1, kPosition + 1), 0.25);
  EXPECT_EQ(filter_.covariance()(kPosition, kVelocity), 0.0);
}

TEST_F(PoseOverrideTest, AHeadingTurnsTheVelocityToo) {
  run(8.0);
  const NavigationState before = filter_.state();
  const ErrorCovariance P = filter_.covariance();
  ASSERT_GT(before.v_eb_n.norm(), 0.1);
  PoseOverride turned = pose();
  turned.heading_rad = 1.0;
  turned.heading_std_rad = 0.1;
  const NavigationState after = filter_.place(turned).state;
  EXPECT_NEAR(eulerFrom_q_b_to_n(after.q_b_to_n).z(), 1.0, 1e-12);
  EXPECT_NEAR(eulerFrom_q_b_to_n(after.q_b_to_n).x(), eulerFrom_q_b_to_n(before.q_b_to_n).x(), 1e-12);
  const Vector3 before_b = before.q_b_to_n.conjugate() * before.v_eb_n;
  const Vector3 after_b = after.q_b_to_n.conjugate() * after.v_eb_n;
  EXPECT_LT((after_b - before_b).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(filter_.covariance()(kAttitude + 2, kAttitude + 2), 0.01);
  const double aside = 0.01 * after.v_eb_n.head<2>().squaredNorm();
  EXPECT_NEAR(filter_.covariance()(kVelocity, kVelocity), P(kVelocity, kVelocity) + aside, 1e-9 * aside);
  EXPECT_EQ(filter_.covariance()(kVelocity + 2, kVelocity + 2), P(kVelocity + 2, kVelocity + 2));
}

TEST_F(PoseOverrideTest, ImpossibleOnesAreRefused) {
  EXPECT_THROW(filter_.place(pose()), std::invalid_argument);  // nothing processed so far
  run(8.0);
  PoseOverride wrong = pose();
  wrong.position.latitude_rad = std::nan("");
  EXPECT_THROW(filter_.place(wrong), std::invalid_argument);
  wrong = pose();
  wrong.position_std_m = 0.0;
  EXPECT_THROW(filter_.place(wrong), std::invalid_argument);
  wrong = pose();
  wrong.heading_rad = 0.0;
  EXPECT_THROW(filter_.place(wrong), std::invalid_argument);
  EXPECT_NO_THROW(filter_.place(pose()));
}

/// Somebody has carried the rover away: a fix that follows says nothing of where it has been.
TEST_F(PoseOverrideTest, ASmootherTakesNothingOfItIntoThePast) {
  const auto history = std::make_shared<FilterHistory>(Planet::byName("earth"));
  filter_.keepHistory(history);
  filter_.initialize(drive_.initial);
  InsEngine ins(Planet::byName("earth"), setup_.imu_input);
  ins.initialize(drive_.initial.nav);
  std::map<Nanoseconds, ErrorCovariance> filtered;
  Nanoseconds placed = 0;
  for (const DriveSample& sample : drive_.samples) {
    if (!sample.is_imu) {
      continue;
    }
    ins.push(sample.imu);
    while (const std::optional<InsStep> step = ins.step()) {
      filter_.push(*step);
    }
    const std::optional<Correction> correction = filter_.advance(
        [&filtered](const Estimate& estimate, const ErrorCovariance& P) { filtered[estimate.nav.stamp] = P; });
    if (correction) {
      ins.correct(*correction);
    }
    if (placed == 0 && sample.stamp() - drive_.initial.nav.stamp > 6 * kSecond) {
      placed = filter_.state().stamp;
      ins.correct(filter_.place(pose()));
      filter_.push(PositionFix{placed + 1, filter_.state().position, Vector3::Constant(1e-4)});
    }
  }
  const std::vector<SmoothedState> epochs = history->smooth();
  ASSERT_GT(epochs.back().nav.stamp, placed + kSecond);
  ASSERT_EQ(filter_.status(kFixPosition).accepted, 1U);
  for (const SmoothedState& epoch : epochs) {
    if (epoch.nav.stamp > placed) {
      break;
    }
    const ErrorCovariance& P = filtered.at(epoch.nav.stamp);
    const ErrorVector weight = P.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_LT((weight.asDiagonal() * (epoch.P - P) * weight.asDiagonal()).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST_F(PoseOverrideTest, EveryNumberThatIsNoneIsRefused) {
  run(8.0);
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(PoseOverride&)>> changes = {
      [&](PoseOverride& p) { p.position.longitude_rad = infinity; },
      [&](PoseOverride& p) { p.position.height_m = infinity; },
      [](PoseOverride& p) { p.position.latitude_rad = 0.5 * kPi; },
      [](PoseOverride& p) { p.position.latitude_rad = -0.5 * kPi; },
      [](PoseOverride& p) { p.position_std_m = -1.0; },
      [](PoseOverride& p) { p.position_std_m = std::nan(""); },
      [&](PoseOverride& p) { p.heading_rad = infinity; },
      [](PoseOverride& p) { p.heading_std_rad = 0.0; },
      [](PoseOverride& p) { p.heading_std_rad = -0.1; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    PoseOverride wrong = pose();
    wrong.heading_rad = 1.0;
    wrong.heading_std_rad = 0.1;
    EXPECT_NO_THROW(filter_.place(wrong));
    changes[i](wrong);
    EXPECT_THROW(filter_.place(wrong), std::invalid_argument) << i;
  }
}

}  // namespace
}  // namespace slipnav::test
