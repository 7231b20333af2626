/// What the supervisor promises, whatever comes: long random sequences of everything that can happen.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include "core/stopping/stop_reach.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestInterval_s = 0.2;
constexpr int kSteps = 20000;
/// Of what is commanded: the longest that a command may come back by a ramp.
constexpr double kFastest = 3.5;  // norm of three components of up to 2
constexpr std::array<const char*, 3> kModes = {"off", "advise", "active"};

/// Draws what happens next, and checks what comes of it.
class RandomDrive {
 public:
  RandomDrive(const std::string& mode, unsigned seed)
      : first_mode_(mode), params_(paramsOf(mode)), supervisor_(params_), random_(seed) {}

  void run() {
    for (int i = 0; i < kSteps && !::testing::Test::HasFailure(); ++i) {
      happen();
      checkDuration();
      checkCountdown();
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
      operator_.overridden = chance(0.3);
      supervisor_.setOverride(operator_.overridden);
    }
    if (chance(0.002)) {
      operator_.emergency_stop = chance(0.3);
      supervisor_.setEmergencyStop(operator_.emergency_stop);
    }
    if (chance(0.002)) {
      supervisor_.stopNow();
    }
    if (chance(0.001)) {
      supervisor_.loseEstimates();
      lost_ = true;
    }
    if (lost_ && chance(0.7)) {
      passTimeWithoutEstimates();
    }
    if (chance(0.0005)) {
      stamp_ -= fromSeconds(uniform(0.0, 100.0));
    }
    if (chance(0.001)) {
      restart();
    }
    if (chance(0.002)) {
      retune();
    }
  }

  /// The process dies and another one begins, which knows only what was latched.
  void restart() {
    const StopLatch kept = supervisor_.latch();
    supervisor_ = StopSupervisor(params_);
    supervisor_.restore(kept);
    newest_ = 0;
    lost_ = true;
  }

  void retune() {
    params_.mode = chance(0.5) ? first_mode_ : kModes.at(std::uniform_int_distribution<std::size_t>(0, 2)(random_));
    params_.deceleration_mps2 = uniform(0.5, 1.0);
    params_.min_drive_s = uniform(1.0, 10.0);
    supervisor_.retune(params_);
  }

  void passTimeWithoutEstimates() {
    const double elapsed_s = uniform(0.0, kLongestInterval_s);
    supervisor_.passTime(fromSeconds(elapsed_s));
    clock_s_ += elapsed_s;
  }

  void observe() {
    if (lost_ && chance(0.95)) {
      return;  // they are lost for a while
    }
    lost_ = false;
    stamp_ += fromSeconds(uniform(0.001, kLongestInterval_s));
    const bool standing = motion_ == 1 && !chance(0.02);
    const bool wheels_at_rest = motion_ > 0;
    supervisor_.observe({stamp_, motion_ == 0 ? uniform(-1.0, 1.0) : 0.0, chance(0.02) ? kNan : uniform(0.0, 0.02),
                         standing, chance(0.5), wheels_at_rest});
    const Nanoseconds stamp = supervisor_.status().stamp;
    clock_s_ += newest_ > 0 && stamp > newest_ ? toSeconds(stamp - newest_) : 0.0;
    newest_ = stamp;
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
    ASSERT_EQ(status.emergency_stop, operator_.emergency_stop) << "only the operator sets and releases it";
    ASSERT_EQ(status.overridden, operator_.overridden);
    if (!in.isFinite() || in.isZero() || operator_.emergency_stop) {
      ASSERT_TRUE(out.isZero());
      return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      expectShortened(in.linear_mps[axis], out.linear_mps[axis]);
      expectShortened(in.angular_radps[axis], out.angular_radps[axis]);
    }
    const bool stops = params_.mode == "active" && status.state >= StopState::kStopping;
    const bool untouched = in.linear_mps == out.linear_mps && in.angular_radps == out.angular_radps;
    const bool coming_back = clock_s_ - stopped_s_ <= kFastest / 0.5 + kLongestInterval_s;
    ASSERT_TRUE(stops || coming_back || untouched);
    ASSERT_TRUE(!status.overridden || untouched);
    ASSERT_TRUE(!stops || status.state != StopState::kHolding || out.isZero());
  }

  /// Who counts down to a stop is never told to wait for ever, and never that there is none while there is one.
  void checkCountdown() {
    const std::optional<double> countdown_s = supervisor_.countdown_s();
    const SupervisorStatus& status = supervisor_.status();
    const bool stopped = status.emergency_stop || status.state >= StopState::kStopping;
    ASSERT_TRUE(!stopped || countdown_s == 0.0);
    ASSERT_TRUE(!countdown_s || (*countdown_s >= 0.0 && *countdown_s <= params_.no_stop_due_s));
    if (stopped) {
      stopped_s_ = clock_s_;
    }
  }

  static void expectShortened(double in, double out) {
    ASSERT_LE(std::abs(out), std::abs(in));
    ASSERT_GE(out * in, 0.0);
  }

  /// A stop that the supervisor makes ends within its limits.
  void checkDuration() {
    const SupervisorStatus& status = supervisor_.status();
    has_held_ = has_held_ || status.state == StopState::kHolding;
    if (params_.mode != "active" || status.state < StopState::kStopping) {
      stop_since_s_.reset();
      hold_since_s_.reset();
      return;
    }
    stop_since_s_ = stop_since_s_.value_or(clock_s_);
    if (status.state == StopState::kHolding) {
      hold_since_s_ = hold_since_s_.value_or(clock_s_);
    }
    const double slack_s = 2.0 * kLongestInterval_s;
    ASSERT_LE(clock_s_ - *stop_since_s_, params_.max_stop_s + params_.max_hold_s + slack_s);
    if (status.state == StopState::kHolding) {
      ASSERT_LE(clock_s_ - *hold_since_s_, params_.max_hold_s + slack_s);
    }
  }

  std::string first_mode_;
  StopParams params_;
  StopSupervisor supervisor_;
  std::mt19937 random_;
  StopLatch operator_;  ///< what the operator has said last
  Nanoseconds stamp_ = fromSeconds(1000.0);
  Nanoseconds newest_ = 0;  ///< estimate that was taken
  double clock_s_ = 0.0;    ///< time that has passed, with estimates and without
  double stopped_s_ = 0.0;  ///< when it was the last time that the rover had to stand
  bool lost_ = false;       ///< there are no estimates
  int motion_ = 0;          ///< 0 driving, 1 standing, 2 sliding on standing wheels
  VelocityCommand command_;
  std::optional<double> stop_since_s_;
  std::optional<double> hold_since_s_;
  bool has_held_ = false;
};

class StopSupervisorPromises : public ::testing::TestWithParam<const char*> {};

TEST_P(StopSupervisorPromises, HoldWhateverComes) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomDrive drive(GetParam(), seed);
    drive.run();
    EXPECT_TRUE(drive.hasHeld());
  }
}

INSTANTIATE_TEST_SUITE_P(AllModes, StopSupervisorPromises, ::testing::ValuesIn(kModes));

/// An emergency stop counts as one when somebody who has to obey hears it, and never else.
TEST(StopReach, EveryModeWithEveryListener) {
  for (const StopMode mode : {StopMode::kOff, StopMode::kAdvise, StopMode::kActive}) {
    for (const std::size_t commands : {0U, 1U, 2U}) {
      for (const std::size_t lock : {0U, 1U, 2U}) {
        const bool obeyed = lock > 0 || (mode == StopMode::kActive && commands > 0);
        EXPECT_EQ(whyNoEmergencyStop(mode, {commands, lock}).empty(), obeyed);
        EXPECT_EQ(whyNoStop(mode, {commands, lock}).empty(), mode == StopMode::kActive && commands > 0);
      }
    }
  }
}

}  // namespace
}  // namespace slipnav::test
