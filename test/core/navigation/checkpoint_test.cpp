#include "core/navigation/checkpoint.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "random_states.h"

namespace slipnav::test {
namespace {

Checkpoint someCheckpoint() {
  Checkpoint checkpoint;
  InitialState& state = checkpoint.state;
  state.nav.stamp = 1'600'000'000'123'456'789;
  state.nav.q_b_to_n = Quaternion(0.1, -0.2, 0.3, 0.4).normalized();
  state.nav.v_eb_n = {0.1, 1.0 / 3.0, -2e-17};
  state.nav.position = {0.69, -1.39, 300.25};
  state.nav.accel_bias_b = {1e-3, -2e-3, 3e-3};
  state.nav.gyro_bias_b = {1e-5, -2e-5, 3e-5};
  state.vehicle = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06};
  state.origin = {0.691, -1.391, 299.0};
  state.standstill_variance = 1e-6;
  const ErrorCovariance root = ErrorCovariance::Random();
  state.P = root * root.transpose() + ErrorCovariance::Identity();
  checkpoint.session = 3;
  checkpoint.slip_hyperparameters = {0.1, 2.5};
  return checkpoint;
}

std::string refusalOf(const std::string& text) {
  try {
    parseCheckpoint(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Checkpoint, NothingIsLostInText) {
  const Checkpoint checkpoint = someCheckpoint();
  const Checkpoint back = parseCheckpoint(formatCheckpoint(checkpoint));
  EXPECT_TRUE(sameState(back.state.nav, checkpoint.state.nav));
  EXPECT_EQ(back.state.nav.stamp, checkpoint.state.nav.stamp);
  EXPECT_EQ(back.state.P, checkpoint.state.P);
  EXPECT_EQ(back.state.origin.longitude_rad, checkpoint.state.origin.longitude_rad);
  EXPECT_EQ(back.state.vehicle.wheel_scale, 0.01);
  EXPECT_EQ(back.state.vehicle.slow_slip, 0.02);
  EXPECT_EQ(back.state.vehicle.fast_slip, 0.03);
  EXPECT_EQ(back.state.vehicle.side_slip, 0.04);
  EXPECT_EQ(back.state.vehicle.mount_pitch_rad, 0.05);
  EXPECT_EQ(back.state.vehicle.mount_yaw_rad, 0.06);
  EXPECT_EQ(back.state.standstill_variance, checkpoint.state.standstill_variance);
  EXPECT_EQ(back.session, 3U);
  EXPECT_EQ(back.slip_hyperparameters, checkpoint.slip_hyperparameters);
}

TEST(Checkpoint, EveryChangedCharacterIsNoticed) {
  const std::string text = formatCheckpoint(someCheckpoint());
  for (std::size_t i = 0; i < text.size(); i += 7) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_NE(refusalOf(damaged), "") << "at " << i;
  }
}

TEST(Checkpoint, RefusalsNameWhatIsWrong) {
  const std::string text = formatCheckpoint(someCheckpoint());
  EXPECT_EQ(refusalOf(""), "checkpoint has another format or version");
  EXPECT_EQ(refusalOf(replaced(text, "checkpoint 2", "checkpoint 3")), "checkpoint has another format or version");
  EXPECT_EQ(refusalOf(text.substr(0, text.size() / 2)), "checkpoint is truncated");
  EXPECT_EQ(refusalOf(replaced(text, "session 3", "session 4")), "checkpoint is damaged: its checksum is wrong");
}

TEST(Checkpoint, NumbersThatAreNoStateAreRefused) {
  Checkpoint checkpoint = someCheckpoint();
  checkpoint.state.P(4, 4) = -1.0;
  EXPECT_EQ(refusalOf(formatCheckpoint(checkpoint)), "checkpoint contains an impossible state");
  checkpoint = someCheckpoint();
  checkpoint.state.nav.q_b_to_n.coeffs() *= 1.1;
  EXPECT_EQ(refusalOf(formatCheckpoint(checkpoint)), "checkpoint contains an impossible state");
  checkpoint = someCheckpoint();
  checkpoint.state.nav.v_eb_n.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusalOf(formatCheckpoint(checkpoint)), "checkpoint has a wrong value in 'v_eb_n'");
}

TEST(Checkpoint, MoreHyperparametersThanAnyModelHasAreRefused) {
  Checkpoint checkpoint = someCheckpoint();
  checkpoint.slip_hyperparameters.assign(64, 0.5);
  EXPECT_EQ(parseCheckpoint(formatCheckpoint(checkpoint)).slip_hyperparameters.size(), 64U);
  checkpoint.slip_hyperparameters.push_back(0.5);
  EXPECT_EQ(refusalOf(formatCheckpoint(checkpoint)), "checkpoint has a wrong value in 'slip_hyperparameters'");
}

/// Of each of the numbers that a state can be wrong in, the last one that is possible and the first one that is not.
TEST(Checkpoint, TheLimitsOfAStateBelongToNone) {
  const auto isRefused = [](const std::function<void(InitialState&)>& change) {
    Checkpoint checkpoint = someCheckpoint();
    change(checkpoint.state);
    return !refusalOf(formatCheckpoint(checkpoint)).empty();
  };
  EXPECT_TRUE(isRefused([](InitialState& s) { s.nav.stamp = 0; }));
  EXPECT_FALSE(isRefused([](InitialState& s) { s.nav.stamp = 1; }));
  EXPECT_TRUE(isRefused([](InitialState& s) { s.nav.position.latitude_rad = -0.5 * kPi; }));
  EXPECT_FALSE(isRefused([](InitialState& s) { s.nav.position.latitude_rad = -1.57; }));
  EXPECT_TRUE(isRefused([](InitialState& s) { s.origin.latitude_rad = 0.5 * kPi; }));
  EXPECT_FALSE(isRefused([](InitialState& s) { s.origin.latitude_rad = 1.57; }));
  EXPECT_TRUE(isRefused([](InitialState& s) { s.standstill_variance = -1e-12; }));
  EXPECT_FALSE(isRefused([](InitialState& s) { s.standstill_variance = 0.0; }));
  EXPECT_TRUE(isRefused([](InitialState& s) { s.nav.q_b_to_n.coeffs() *= 1.0 + 2e-6; }));
  EXPECT_FALSE(isRefused([](InitialState& s) { s.nav.q_b_to_n.coeffs() *= 1.0 + 5e-7; }));
  EXPECT_TRUE(isRefused([](InitialState& s) { s.P(3, 4) += 1e-3 * s.P.norm(); }));
}

/// A checkpoint file in the temporary folder.
class CheckpointFile : public ::testing::Test {
 protected:
  void TearDown() override {
    std::remove(file_.c_str());
    std::remove((file_ + ".1").c_str());
  }

  void save(std::uint32_t session) const {
    Checkpoint checkpoint = someCheckpoint();
    checkpoint.session = session;
    saveCheckpoint(file_, checkpoint);
  }

  static void damage(const std::string& file) { std::ofstream(file, std::ios::app) << "x"; }

  const std::string file_ = ::testing::TempDir() + "slipnav_checkpoint_test";
};

TEST_F(CheckpointFile, TheNewestIsRead) {
  save(1);
  save(2);
  const LoadedCheckpoint loaded = loadCheckpoint(file_);
  ASSERT_TRUE(loaded.checkpoint);
  EXPECT_EQ(loaded.checkpoint->session, 2U);
  EXPECT_TRUE(loaded.refused.empty());
}

TEST_F(CheckpointFile, InPlaceOfADamagedOneTheOneBeforeIsRead) {
  save(1);
  save(2);
  damage(file_);
  const LoadedCheckpoint loaded = loadCheckpoint(file_);
  ASSERT_TRUE(loaded.checkpoint);
  EXPECT_EQ(loaded.checkpoint->session, 1U);
  ASSERT_EQ(loaded.refused.size(), 1U);
  EXPECT_EQ(loaded.refused.front(), file_ + ": checkpoint is damaged: its checksum is wrong");
}

TEST_F(CheckpointFile, TwoDamagedOnesAreBothRefused) {
  save(1);
  save(2);
  damage(file_);
  damage(file_ + ".1");
  const LoadedCheckpoint loaded = loadCheckpoint(file_);
  EXPECT_FALSE(loaded.checkpoint);
  EXPECT_EQ(loaded.refused.size(), 2U);
}

TEST_F(CheckpointFile, WithoutAFileThereIsNothingToSay) {
  const LoadedCheckpoint loaded = loadCheckpoint(file_);
  EXPECT_FALSE(loaded.checkpoint);
  EXPECT_TRUE(loaded.refused.empty());
}

TEST_F(CheckpointFile, AWriterThatDiedBetweenTheTwoMovesLeavesTheOneBefore) {
  save(1);
  std::rename(file_.c_str(), (file_ + ".1").c_str());
  ASSERT_TRUE(loadCheckpoint(file_).checkpoint);
}

TEST_F(CheckpointFile, AFolderThatIsNotThereIsNamed) {
  EXPECT_THROW(saveCheckpoint("/nonexistent/checkpoint", someCheckpoint()), std::runtime_error);
}

TEST(ResumeFrom, GrowsByWhatMayHaveBeenDrivenMeanwhile) {
  const Checkpoint checkpoint = someCheckpoint();
  CheckpointParams params;
  params.speed_mps = 0.5;
  params.turn_rate_deg_per_s = 4.0;
  params.tilt_deg_per_s = 1.0;
  ErrorVector prior = ErrorVector::Constant(0.25);
  const ErrorCovariance& before = checkpoint.state.P;
  const InitialState state = resumeFrom(checkpoint, checkpoint.state.nav.stamp + 3 * kSecond, prior, params);
  EXPECT_EQ(state.nav.stamp, checkpoint.state.nav.stamp + 3 * kSecond);
  EXPECT_TRUE(state.nav.v_eb_n.isZero());
  EXPECT_DOUBLE_EQ(state.P(kPosition, kPosition), before(kPosition, kPosition) + 1.5 * 1.5);
  EXPECT_DOUBLE_EQ(state.P(kVelocity + 1, kVelocity + 1), 0.25);
  EXPECT_DOUBLE_EQ(state.P(kVelocity + 1, kPosition), 0.0);
  EXPECT_DOUBLE_EQ(state.P(kAttitude, kAttitude), before(kAttitude, kAttitude) + std::pow(degToRad(3.0), 2));
  EXPECT_DOUBLE_EQ(state.P(kAttitude + 2, kAttitude + 2),
                   before(kAttitude + 2, kAttitude + 2) + std::pow(degToRad(12.0), 2));
  EXPECT_EQ(state.vehicle.wheel_scale, checkpoint.state.vehicle.wheel_scale);
  EXPECT_EQ(state.vehicle.mount_pitch_rad, checkpoint.state.vehicle.mount_pitch_rad);
  EXPECT_EQ(state.vehicle.mount_yaw_rad, checkpoint.state.vehicle.mount_yaw_rad);
  EXPECT_EQ(state.P(kGyroBias, kGyroBias), before(kGyroBias, kGyroBias));
}

/// The ground is another one by then: each slip begins with its own prior, and correlates with nothing.
TEST(ResumeFrom, SlipIsForgotten) {
  const Checkpoint checkpoint = someCheckpoint();
  ErrorVector prior = ErrorVector::Zero();
  prior(kSlowSlip) = 0.1;
  prior(kFastSlip) = 0.2;
  prior(kSideSlip) = 0.3;
  const InitialState state = resumeFrom(checkpoint, checkpoint.state.nav.stamp + kSecond, prior, {});
  EXPECT_EQ(state.vehicle.slow_slip, 0.0);
  EXPECT_EQ(state.vehicle.fast_slip, 0.0);
  EXPECT_EQ(state.vehicle.side_slip, 0.0);
  for (const int slip : {kSlowSlip, kFastSlip, kSideSlip}) {
    EXPECT_EQ(state.P(slip, slip), prior(slip));
    EXPECT_EQ(state.P.row(slip).cwiseAbs().sum(), prior(slip));
    EXPECT_EQ(state.P.col(slip).cwiseAbs().sum(), prior(slip));
  }
}

TEST(ResumeFrom, TurnsStayWithinWhatTheFilterCanTake) {
  const Checkpoint checkpoint = someCheckpoint();
  const CheckpointParams params;
  const InitialState state =
      resumeFrom(checkpoint, checkpoint.state.nav.stamp + 500 * kSecond, ErrorVector::Ones(), params);
  const double added = state.P(kAttitude + 2, kAttitude + 2) - checkpoint.state.P(kAttitude + 2, kAttitude + 2);
  EXPECT_NEAR(std::sqrt(added), degToRad(params.max_turn_deg), 1e-9);
}

TEST(ResumeFrom, AnotherTimeIsRefused) {
  const Checkpoint checkpoint = someCheckpoint();
  const CheckpointParams params;
  const auto resumeAfter = [&](double age_s) {
    resumeFrom(checkpoint, checkpoint.state.nav.stamp + fromSeconds(age_s), ErrorVector::Ones(), params);
  };
  EXPECT_NO_THROW(resumeAfter(0.9 * params.max_age_s));
  EXPECT_THROW(resumeAfter(1.1 * params.max_age_s), std::invalid_argument);
  EXPECT_THROW(resumeAfter(-1.0), std::invalid_argument);
}

/// The oldest that is used, and the one before.
TEST(ResumeFrom, AnAgeOfExactlyTheLimitIsNotTooOld) {
  const Checkpoint checkpoint = someCheckpoint();
  const Nanoseconds stamp = checkpoint.state.nav.stamp;
  CheckpointParams params;
  params.max_age_s = 16.0;
  EXPECT_NO_THROW(resumeFrom(checkpoint, stamp, ErrorVector::Ones(), params));
  EXPECT_NO_THROW(resumeFrom(checkpoint, stamp + 16 * kSecond, ErrorVector::Ones(), params));
  try {
    resumeFrom(checkpoint, stamp + 17 * kSecond + kSecond / 4, ErrorVector::Ones(), params);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "checkpoint is 17.3 s old; checkpoint.max_age_s is 16");
  }
}

}  // namespace
}  // namespace slipnav::test
