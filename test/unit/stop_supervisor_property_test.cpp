/// What the supervisor promises, whatever comes: long random sequences of everything that can happen.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "slipnav/stop/stop_supervisor.h"

namespace slipnav::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestInterval_s = 0.2;
constexpr int kSteps = 20000;

/// Draws what happens next, and checks what comes of it.
class RandomDrive {
 public:
  RandomDrive(const std::string& mode, unsigned seed) : params_(paramsOf(mode)), supervisor_(params_), random_(seed) {}

  void run() {
    for (int i = 0; i < kSteps && !::testing::Test::HasFailure(); ++i) {
      happen();
      checkDuration();
      checkCommand(drawCommand());
    }
  }

  bool hasHeld() const { return has_held_; }

 private:
  static StopParams paramsOf(const std::string& mode) {
    StopParams params;
    params.mode = mode;
    return params;
  }

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  void happen() {
    if (chance(0.01)) {
      motion_ = std::uniform_int_distribution<int>(0, 2)(random_);
    }
    if (chance(0.7)) {
      observe();
    }
    if (chance(0.05)) {
      supervisor_.setForecast({stamp_, chance(0.1) ? kNan : chance(0.3) ? kInfinity : uniform(-5.0, 60.0)});
    }
    if (chance(0.002)) {
      supervisor_.setOverride(chance(0.3));
    }
    if (chance(0.002)) {
      supervisor_.setEmergencyStop(chance(0.3));
    }
    if (chance(0.002)) {
      supervisor_.stopNow();
    }
    if (chance(0.001)) {
      supervisor_.loseEstimates();
    }
    if (chance(0.0005)) {
      stamp_ -= fromSeconds(uniform(0.0, 100.0));
    }
  }

  void observe() {
    stamp_ += fromSeconds(uniform(0.001, kLongestInterval_s));
    const bool standing = motion_ == 1 && !chance(0.02);
    const bool wheels_at_rest = motion_ > 0;
    supervisor_.observe({stamp_, motion_ == 0 ? uniform(-1.0, 1.0) : 0.0, chance(0.02) ? kNan : uniform(0.0, 0.02),
                         standing, chance(0.5), wheels_at_rest});
  }

  VelocityCommand drawCommand() {
    if (chance(0.3)) {
      command_ = {};
      for (int axis = 0; axis < 3; ++axis) {
        command_.linear_mps[axis] = chance(0.5) ? uniform(-2.0, 2.0) : 0.0;
        command_.angular_radps[axis] = chance(0.5) ? uniform(-2.0, 2.0) : 0.0;
      }
    }
    if (chance(0.01)) {
      return {{kNan, 0.0, 0.0}, {}};
    }
    return chance(0.05) ? VelocityCommand{} : command_;
  }

  void checkCommand(const VelocityCommand& in) {
    const VelocityCommand out = supervisor_.command(in);
    const SupervisorStatus& status = supervisor_.status();
    if (!in.isFinite() || in.isZero() || status.emergency_stop) {
      ASSERT_TRUE(out.isZero());
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      expectShortened(in.linear_mps[axis], out.linear_mps[axis]);
      expectShortened(in.angular_radps[axis], out.angular_radps[axis]);
    }
    const bool stops = params_.mode == "active" && status.state >= StopState::kStopping;
    const bool untouched = in.linear_mps == out.linear_mps && in.angular_radps == out.angular_radps;
    ASSERT_TRUE(stops || untouched);
    ASSERT_TRUE(!status.overridden || untouched);
    ASSERT_TRUE(!stops || status.state != StopState::kHolding || out.isZero());
  }

  static void expectShortened(double in, double out) {
    ASSERT_LE(std::abs(out), std::abs(in));
    ASSERT_GE(out * in, 0.0);
  }

  /// A stop that the supervisor makes ends within its limits.
  void checkDuration() {
    const SupervisorStatus& status = supervisor_.status();
    has_held_ = has_held_ || status.state == StopState::kHolding;
    if (params_.mode != "active" || status.state < StopState::kStopping || status.stamp < stop_since_.value_or(0)) {
      stop_since_.reset();
      hold_since_.reset();
      return;
    }
    stop_since_ = stop_since_.value_or(status.stamp);
    if (status.state == StopState::kHolding) {
      hold_since_ = hold_since_.value_or(status.stamp);
    }
    const double slack_s = 2.0 * kLongestInterval_s;
    ASSERT_LE(toSeconds(status.stamp - *stop_since_), params_.max_stop_s + params_.max_hold_s + slack_s);
    if (status.state == StopState::kHolding) {
      ASSERT_LE(toSeconds(status.stamp - *hold_since_), params_.max_hold_s + slack_s);
    }
  }

  StopParams params_;
  StopSupervisor supervisor_;
  std::mt19937 random_;
  Nanoseconds stamp_ = fromSeconds(1000.0);
  int motion_ = 0;  ///< 0 driving, 1 standing, 2 sliding on standing wheels
  VelocityCommand command_;
  std::optional<Nanoseconds> stop_since_;
  std::optional<Nanoseconds> hold_since_;
  bool has_held_ = false;
};

class StopSupervisorPromises : public ::testing::TestWithParam<const char*> {};

TEST_P(StopSupervisorPromises, HoldWhateverComes) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomDrive drive(GetParam(), seed);
    drive.run();
    EXPECT_EQ(drive.hasHeld(), std::string(GetParam()) != "off");
  }
}

INSTANTIATE_TEST_SUITE_P(AllModes, StopSupervisorPromises, ::testing::Values("off", "advise", "active"));

}  // namespace
}  // namespace slipnav::test
