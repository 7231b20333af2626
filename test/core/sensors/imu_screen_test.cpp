#include "slipnav/core/sensors/imu_screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace slipnav::test {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;

ImuInputParams params() {
  ImuInputParams params;
  params.max_specific_force_mps2 = 100.0;
  params.max_rate_deg_per_s = 500.0;
  params.gap_factor = 2.5;
  return params;
}

ImuSample sampleAt(double t_s) { return {kStart + fromSeconds(t_s), Vector3(0.0, 0.0, -9.8), Vector3::Zero()}; }

/// A screen that has seen regular samples at 50 Hz up to t = 0.
ImuScreen running() {
  ImuScreen screen(params());
  for (int i = -50; i <= 0; ++i) {
    EXPECT_EQ(screen.check(sampleAt(0.02 * i)).verdict, ImuVerdict::kAccepted);
  }
  return screen;
}

TEST(ImuScreen, RegularSamplesAreAccepted) {
  ImuScreen screen = running();
  const ImuScreen::Result result = screen.check(sampleAt(0.021));
  EXPECT_EQ(result.verdict, ImuVerdict::kAccepted);
  EXPECT_NEAR(result.interval.duration_s, 0.021, 1e-9);
  EXPECT_EQ(result.gap_s, 0.0);
  EXPECT_EQ(screen.newestStamp(), sampleAt(0.021).stamp);
}

TEST(ImuScreen, ASensorThatSaysTheSameOnAllAxesIsFrozenUntilOneMoves) {
  ImuScreen screen(params());
  for (int i = 0; i <= params().stuck_samples; ++i) {
    EXPECT_FALSE(screen.isFrozen()) << i;
    EXPECT_EQ(screen.check(sampleAt(0.02 * i)).verdict, ImuVerdict::kAccepted);
  }
  EXPECT_TRUE(screen.isFrozen());
  ImuSample moved = sampleAt(1.0);
  moved.omega_ib_b.z() = 1e-6;
  screen.check(moved);
  EXPECT_FALSE(screen.isFrozen());
}

TEST(ImuScreen, TheFirstSampleHasNoInterval) {
  ImuScreen screen(params());
  EXPECT_EQ(screen.newestStamp(), 0);
  EXPECT_EQ(screen.check(sampleAt(0.0)).interval.duration_s, 0.0);
}

TEST(ImuScreen, BadNumbersAreRefusedAndLeaveNoTrace) {
  ImuScreen screen = running();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ImuSample sample = sampleAt(0.02);
  sample.f_ib_b.y() = nan;
  EXPECT_EQ(screen.check(sample).verdict, ImuVerdict::kNotFinite);
  sample = sampleAt(0.02);
  sample.omega_ib_b.x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(screen.check(sample).verdict, ImuVerdict::kNotFinite);
  sample = sampleAt(0.02);
  sample.f_ib_b.z() = -101.0;
  EXPECT_EQ(screen.check(sample).verdict, ImuVerdict::kOutOfRange);
  sample = sampleAt(0.02);
  sample.omega_ib_b.z() = degToRad(501.0);
  EXPECT_EQ(screen.check(sample).verdict, ImuVerdict::kOutOfRange);
  EXPECT_EQ(screen.newestStamp(), kStart);
  EXPECT_EQ(screen.check(sampleAt(0.02)).verdict, ImuVerdict::kAccepted);
}

/// Samples with noise on all axes but one, which has the same value from the first on.
std::vector<ImuVerdict> verdictsWithStuckGyro(int samples, ImuScreen& screen) {
  std::vector<ImuVerdict> verdicts;
  for (int i = 1; i <= samples; ++i) {
    ImuSample sample = sampleAt(0.02 * i);
    sample.omega_ib_b = {1e-5 * (i % 7), 0.125, -1e-5 * (i % 5)};
    verdicts.push_back(screen.check(sample).verdict);
  }
  return verdicts;
}

TEST(ImuScreen, AStuckAxisIsRefusedUntilItMoves) {
  ImuScreen screen(params());
  const std::vector<ImuVerdict> verdicts = verdictsWithStuckGyro(params().stuck_samples + 5, screen);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), ImuVerdict::kStuck), 5);
  EXPECT_EQ(verdicts.back(), ImuVerdict::kStuck);
  ImuSample moving = sampleAt(0.02 * (params().stuck_samples + 6));
  moving.omega_ib_b = {2e-5, 0.126, 3e-5};
  EXPECT_TRUE(isAccepted(screen.check(moving).verdict));
}

TEST(ImuScreen, ASensorThatIsConstantOnAllAxesIsNotStuck) {
  ImuScreen screen = running();
  for (int i = 1; i < 100; ++i) {
    ASSERT_EQ(screen.check(sampleAt(0.02 * i)).verdict, ImuVerdict::kAccepted);
  }
}

TEST(ImuScreen, WithoutALimitNothingIsStuck) {
  ImuInputParams tolerant = params();
  tolerant.stuck_samples = 0;
  ImuScreen screen(tolerant);
  const std::vector<ImuVerdict> verdicts = verdictsWithStuckGyro(100, screen);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), ImuVerdict::kStuck), 0);
}

TEST(ImuScreen, RepeatedAndSlightlyOlderSamplesAreRefused) {
  ImuScreen screen = running();
  EXPECT_EQ(screen.check(sampleAt(0.0)).verdict, ImuVerdict::kNotNewer);
  EXPECT_EQ(screen.check(sampleAt(-0.02)).verdict, ImuVerdict::kNotNewer);
  EXPECT_EQ(screen.check(sampleAt(-0.999)).verdict, ImuVerdict::kNotNewer);
  EXPECT_EQ(screen.newestStamp(), kStart);
  EXPECT_EQ(screen.restarts(), 0U);
}

/// What a source says after a restart does not follow from anything before it.
TEST(ImuScreen, ASourceThatHasRestartedStartsOver) {
  ImuScreen screen = running();
  const ImuScreen::Result first = screen.check(sampleAt(-1.0));
  EXPECT_EQ(first.verdict, ImuVerdict::kTimeWentBack);
  EXPECT_TRUE(isAccepted(first.verdict));
  EXPECT_EQ(first.interval.duration_s, 0.0);
  EXPECT_EQ(screen.newestStamp(), sampleAt(-1.0).stamp);
  EXPECT_EQ(screen.check(sampleAt(-0.5)).verdict, ImuVerdict::kAccepted);  // any first interval is the usual one
  EXPECT_EQ(screen.check(sampleAt(-500.0)).verdict, ImuVerdict::kTimeWentBack);
  EXPECT_EQ(screen.restarts(), 2U);
}

TEST(ImuScreen, GapsAreMeasuredAgainstTheUsualInterval) {
  ImuScreen screen = running();
  const ImuScreen::Result late = screen.check(sampleAt(0.049));
  EXPECT_EQ(late.verdict, ImuVerdict::kAccepted);
  ImuScreen other = running();
  const ImuScreen::Result gap = other.check(sampleAt(0.1));
  EXPECT_EQ(gap.verdict, ImuVerdict::kAfterGap);
  EXPECT_NEAR(gap.interval.duration_s, 0.1, 1e-9);
  EXPECT_NEAR(gap.gap_s, 0.08, 1e-9);
  // the gap does not become the usual interval
  EXPECT_EQ(other.check(sampleAt(0.2)).verdict, ImuVerdict::kAfterGap);
}

TEST(ImuScreen, ResetForgets) {
  ImuScreen screen = running();
  screen.reset();
  EXPECT_EQ(screen.newestStamp(), 0);
  EXPECT_EQ(screen.check(sampleAt(-500.0)).verdict, ImuVerdict::kAccepted);
  EXPECT_EQ(screen.check(sampleAt(-499.0)).verdict, ImuVerdict::kAccepted);  // any first interval is the usual one
}

TEST(ImuScreen, EveryRefusalHasItsWords) {
  for (const ImuVerdict verdict :
       {ImuVerdict::kNotFinite, ImuVerdict::kOutOfRange, ImuVerdict::kStuck, ImuVerdict::kNotNewer}) {
    EXPECT_FALSE(isAccepted(verdict));
    EXPECT_STRNE(complaintOf(verdict), "");
  }
  EXPECT_STRNE(complaintOf(ImuVerdict::kTimeWentBack), "");
  for (const ImuVerdict verdict : {ImuVerdict::kAccepted, ImuVerdict::kAfterGap}) {
    EXPECT_TRUE(isAccepted(verdict));
    EXPECT_STREQ(complaintOf(verdict), "");
  }
}

/// Neither triad has repeated itself before.
TEST(ImuScreen, AfterAResetNoAxisIsStuck) {
  ImuScreen screen(params());
  for (int run = 0; run < 2; ++run) {
    for (int i = 1; i < params().stuck_samples; ++i) {
      ImuSample sample = sampleAt(100.0 * run + 0.02 * i);
      sample.f_ib_b = {0.25, 1e-3 * i, -9.8};
      sample.omega_ib_b = {1e-5 * i, 0.125, 1e-5 * i};
      EXPECT_EQ(screen.check(sample).verdict, ImuVerdict::kAccepted) << run << " " << i;
    }
    screen.reset();
  }
}

}  // namespace
}  // namespace slipnav::test
