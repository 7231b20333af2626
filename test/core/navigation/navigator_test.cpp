/// The filter's answer depends on stamps, not on the order of arrival; and it survives whatever the sensors do.

#include "core/navigation/navigator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "recorded_drive.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

const Config& config() {
  static const Config config = driveConfig(12.0);
  return config;
}

const RecordedDrive& drive() {
  static const RecordedDrive drive = recordDrive(config());
  return drive;
}

const EstimateLog& sequentialRun() {
  static const EstimateLog log = runNavigator(config(), drive().initial, drive().samples);
  return log;
}

enum class Lag { kConstant, kRandomInOrder, kRandom };

/// Wheels arrive up to `lag_s` later than their stamps say, and overtake each other only with Lag::kRandom.
std::vector<DriveSample> withLateWheels(double lag_s, Lag kind,
                                        const std::vector<DriveSample>& samples = drive().samples) {
  sim::RandomStream random(1, "lag");
  std::vector<std::pair<Nanoseconds, DriveSample>> arrivals;
  Nanoseconds newest_wheels = 0;
  for (const DriveSample& sample : samples) {
    const double lag = sample.is_imu ? 0.0 : lag_s * (kind == Lag::kConstant ? 1.0 : random.uniform());
    Nanoseconds arrival = sample.stamp() + fromSeconds(lag);
    if (!sample.is_imu && kind != Lag::kRandom) {
      newest_wheels = arrival = std::max(arrival, newest_wheels);
    }
    arrivals.emplace_back(arrival, sample);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<DriveSample> result;
  result.reserve(arrivals.size());
  for (const auto& [arrival, sample] : arrivals) {
    result.push_back(sample);
  }
  return result;
}

/// Wheel samples that are regular but for one of nine, which is early.
std::vector<DriveSample> withEarlyStamps(double early_s) {
  std::vector<DriveSample> samples = drive().samples;
  int count = 0;
  for (DriveSample& sample : samples) {
    if (!sample.is_imu && ++count % 9 == 0) {
      sample.wheels.stamp -= fromSeconds(early_s);
    }
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const DriveSample& a, const DriveSample& b) { return a.stamp() < b.stamp(); });
  return samples;
}

bool isFiniteEstimate(const LoggedEstimate& logged) { return isFinite(logged.estimate.nav) && logged.P.allFinite(); }

TEST(Navigator, TheDriveUsesEveryKindOfMeasurement) {
  const bool stood = std::any_of(sequentialRun().begin(), sequentialRun().end(),
                                 [](const LoggedEstimate& l) { return l.estimate.stationary; });
  const bool moved = std::any_of(sequentialRun().begin(), sequentialRun().end(),
                                 [](const LoggedEstimate& l) { return l.estimate.wheels.motion.forward_mps > 0.5; });
  EXPECT_TRUE(stood);
  EXPECT_TRUE(moved);
  EXPECT_GT(sequentialRun().size(), 1000U);
  EXPECT_TRUE(std::all_of(sequentialRun().begin(), sequentialRun().end(), isFiniteEstimate));
}

TEST(Navigator, LateWheelsMakeNoDifference) {
  for (const double lag_s : {0.05, 0.5, 0.95}) {
    EXPECT_TRUE(
        sameEstimates(runNavigator(config(), drive().initial, withLateWheels(lag_s, Lag::kConstant)), sequentialRun()))
        << lag_s;
  }
}

TEST(Navigator, RandomInterleavingMakesNoDifference) {
  EXPECT_TRUE(sameEstimates(runNavigator(config(), drive().initial, withLateWheels(0.9, Lag::kRandomInOrder)),
                            sequentialRun()));
}

TEST(Navigator, WheelsThatOvertakeEachOtherMakeNoDifference) {
  EXPECT_TRUE(
      sameEstimates(runNavigator(config(), drive().initial, withLateWheels(0.5, Lag::kRandom)), sequentialRun()));
  EXPECT_TRUE(
      sameEstimates(runNavigator(config(), drive().initial, withLateWheels(0.9, Lag::kRandom)), sequentialRun()));
}

/// Samples that come before they are due are used as well, and when they arrive makes no difference either.
TEST(Navigator, WheelsBeforeTheyAreDueGiveTheSameHoweverLate) {
  const std::vector<DriveSample> samples = withEarlyStamps(0.05);
  const EstimateLog log = runNavigator(config(), drive().initial, samples);
  EXPECT_TRUE(
      sameEstimates(runNavigator(config(), drive().initial, withLateWheels(0.9, Lag::kRandomInOrder, samples)), log));
  const auto usesWheels = [](const LoggedEstimate& logged) { return logged.estimate.has_wheels; };
  const auto used = std::count_if(log.begin(), log.end(), usesWheels);
  const auto regularly = std::count_if(sequentialRun().begin(), sequentialRun().end(), usesWheels);
  EXPECT_GT(used, regularly * 99 / 100);
}

/// Nobody waits for a wheel sample that is not yet due.
TEST(Navigator, EstimatesComeWithTheImuSample) {
  const NavigationSetup setup = config().navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive().initial);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  const Nanoseconds learned = drive().initial.nav.stamp + fromSeconds(1.0);
  int at_once = 0;
  int samples = 0;
  for (const DriveSample& sample : withLateWheels(0.01, Lag::kConstant)) {
    if (!sample.is_imu) {
      navigator.push(sample.wheels, ignore);
      continue;
    }
    Nanoseconds newest = 0;
    navigator.push(sample.imu, [&](const Estimate& estimate, const ErrorCovariance&) { newest = estimate.nav.stamp; });
    if (sample.stamp() > learned) {
      ++samples;
      at_once += newest == sample.stamp() ? 1 : 0;
    }
  }
  EXPECT_GT(at_once, samples * 3 / 4);  // four samples of five: with the fifth, wheels are due
}

TEST(Navigator, EarlyWheelsMakeNoDifference) {
  EXPECT_TRUE(sameEstimates(runNavigator(config(), drive().initial, withLateWheels(-0.9, Lag::kRandomInOrder)),
                            sequentialRun()));
}

TEST(Navigator, ComparisonSeesTheLastBit) {
  std::vector<DriveSample> changed = drive().samples;
  const auto wheels = std::find_if(changed.begin() + static_cast<std::ptrdiff_t>(changed.size() / 2), changed.end(),
                                   [](const DriveSample& s) { return !s.is_imu; });
  wheels->wheels.motion.forward_mps += 1e-9;
  EXPECT_FALSE(sameEstimates(runNavigator(config(), drive().initial, changed), sequentialRun()));
}

TEST(Navigator, WheelsLaterThanTheWaitAreRefused) {
  const NavigationSetup setup = config().navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive().initial);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  const double lag_s = setup.filter.filter.max_wait_s + 0.5;
  const Nanoseconds end = drive().samples.back().stamp() - fromSeconds(lag_s);
  int refused = 0;
  for (const DriveSample& sample : withLateWheels(lag_s, Lag::kConstant)) {
    if (sample.is_imu) {
      navigator.push(sample.imu, ignore);
    } else if (sample.stamp() > drive().initial.nav.stamp && sample.stamp() < end) {
      ASSERT_FALSE(navigator.push(sample.wheels, ignore));
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Navigator, BadWheelsAreRefused) {
  const NavigationSetup setup = config().navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive().initial);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  WheelMotion wheels;
  wheels.stamp = drive().initial.nav.stamp + fromSeconds(0.1);
  WheelMotion bad = wheels;
  bad.motion.forward_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(navigator.push(bad, ignore));
  bad = wheels;
  bad.motion.yaw_rate_radps = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(navigator.push(bad, ignore));
  EXPECT_TRUE(navigator.push(wheels, ignore));
  EXPECT_FALSE(navigator.push(wheels, ignore));  // repeated
  bad = wheels;
  bad.stamp = drive().initial.nav.stamp - 1;
  EXPECT_FALSE(navigator.push(bad, ignore));  // before the start
}

TEST(Navigator, RepeatedSamplesMakeNoDifference) {
  std::vector<DriveSample> twice;
  for (const DriveSample& sample : drive().samples) {
    twice.insert(twice.end(), 2, sample);
  }
  EXPECT_TRUE(sameEstimates(runNavigator(config(), drive().initial, twice), sequentialRun()));
}

/// Without wheels the estimate continues, with growing uncertainty.
TEST(Navigator, GoesOnThroughAWheelOutage) {
  const Nanoseconds start = drive().initial.nav.stamp;
  std::vector<DriveSample> samples;
  for (const DriveSample& sample : drive().samples) {
    const double t_s = toSeconds(sample.stamp() - start);
    if (sample.is_imu || t_s < 10.0 || t_s > 18.0) {
      samples.push_back(sample);
    }
  }
  const EstimateLog log = runNavigator(config(), drive().initial, samples);
  ASSERT_EQ(log.size(), sequentialRun().size());
  EXPECT_TRUE(std::all_of(log.begin(), log.end(), isFiniteEstimate));
  const auto sigmaAt = [&](double t_s) {
    const auto it = std::find_if(log.begin(), log.end(), [&](const LoggedEstimate& l) {
      return toSeconds(l.estimate.nav.stamp - start) >= t_s;
    });
    return std::sqrt(it->P(kPosition, kPosition));
  };
  EXPECT_GT(sigmaAt(17.9), 2.0 * sigmaAt(10.0));
  EXPECT_GT(sigmaAt(14.0), sigmaAt(12.0));
  for (const LoggedEstimate& logged : log) {
    const double t_s = toSeconds(logged.estimate.nav.stamp - start);
    EXPECT_FALSE(logged.estimate.stationary && t_s > 11.5 && t_s < 18.0);
  }
}

/// A gap in the IMU makes the estimate unsure by what the vehicle may have done in it.
TEST(Navigator, AGapInTheImuInflatesTheCovariance) {
  const Nanoseconds start = drive().initial.nav.stamp;
  Config free_inertial = config();
  free_inertial.filter.updates = {};
  free_inertial.filter.gap_rate_std_deg_per_s = 8.0;
  free_inertial.filter.gap_accel_std_mps2 = 0.4;
  std::vector<DriveSample> samples;
  for (const DriveSample& sample : drive().samples) {
    const double t_s = toSeconds(sample.stamp() - start);
    if (sample.is_imu && (t_s < 10.0 || t_s >= 10.5)) {
      samples.push_back(sample);
    }
  }
  const EstimateLog log = runNavigator(free_inertial, drive().initial, samples);
  const auto after = std::find_if(
      log.begin(), log.end(), [&](const LoggedEstimate& l) { return toSeconds(l.estimate.nav.stamp - start) >= 10.4; });
  ASSERT_NE(after, log.end());
  const double gap_s = toSeconds(after->estimate.nav.stamp - std::prev(after)->estimate.nav.stamp) - 0.02;
  EXPECT_GT(gap_s, 0.4);
  const auto growth = [&](int index) { return std::sqrt(after->P(index, index) - std::prev(after)->P(index, index)); };
  EXPECT_NEAR(growth(kAttitude + 2), degToRad(8.0) * gap_s, 0.02 * degToRad(8.0) * gap_s);
  EXPECT_GT(growth(kVelocity + 2), 0.4 * gap_s);
  EXPECT_GT(growth(kPosition), 0.5 * 0.4 * gap_s * gap_s);
}

/// What lies before a wheel sample is certain as soon as the sample is there.
TEST(Navigator, AGapWithManyWheelSamplesInItDoesNoHarm) {
  const Nanoseconds begin = drive().samples.back().stamp() - fromSeconds(12.0);
  const Nanoseconds end = begin + fromSeconds(3.0);
  std::vector<DriveSample> samples;
  std::copy_if(drive().samples.begin(), drive().samples.end(), std::back_inserter(samples),
               [=](const DriveSample& s) { return !s.is_imu || s.stamp() <= begin || s.stamp() > end; });
  const EstimateLog log = runNavigator(config(), drive().initial, samples);
  const LoggedEstimate& with_gap = log.back();
  const LoggedEstimate& without = sequentialRun().back();
  ASSERT_EQ(with_gap.estimate.nav.stamp, without.estimate.nav.stamp);
  const ErrorVector error = errorBetween(Planet::byName("earth"), with_gap.estimate.nav, without.estimate.nav);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(error(kPosition + i)), 3.0 * std::sqrt(with_gap.P(kPosition + i, kPosition + i)));
  }
  EXPECT_LT(error.segment<3>(kPosition).norm(), 5.0);
}

TEST(Navigator, DoesNotWaitLongerThanForTheNextWheels) {
  const NavigationSetup setup = config().navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive().initial);
  Nanoseconds told = 0;
  const auto sink = [&told](const Estimate& e, const ErrorCovariance&) { told = e.nav.stamp; };
  const double learning_s = 2.0;  // of the usual interval between wheel samples
  Nanoseconds newest_imu = 0;
  int compared = 0;
  for (const DriveSample& sample : drive().samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, sink);
      newest_imu = sample.stamp();
    } else if (navigator.push(sample.wheels, sink) &&
               sample.stamp() > drive().initial.nav.stamp + fromSeconds(learning_s)) {
      ASSERT_EQ(told, newest_imu);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Navigator, FreeInertialDoesNotWaitForWheels) {
  Config free_inertial = config();
  free_inertial.filter.updates = {};
  const NavigationSetup setup = free_inertial.navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive().initial);
  Nanoseconds told = 0;
  for (const DriveSample& sample : drive().samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, [&told](const Estimate& e, const ErrorCovariance&) { told = e.nav.stamp; });
      ASSERT_TRUE(told == sample.stamp() || sample.stamp() <= drive().initial.nav.stamp);
    }
  }
}

/// As when a computer has begun without a clock, and is told the year.
TEST(Navigator, GoesOnAfterTheClockWasSetByYears) {
  constexpr double kYears_s = 30.0 * 365.0 * 86400.0;
  const Nanoseconds set_at = drive().initial.nav.stamp + fromSeconds(10.0);
  std::vector<DriveSample> samples = drive().samples;
  for (DriveSample& sample : samples) {
    if (sample.stamp() > set_at) {
      (sample.is_imu ? sample.imu.stamp : sample.wheels.stamp) += fromSeconds(kYears_s);
    }
  }
  const EstimateLog log = runNavigator(config(), drive().initial, samples);
  ASSERT_GT(log.size() + 2, sequentialRun().size());
  EXPECT_TRUE(std::all_of(log.begin(), log.end(), isFiniteEstimate));
  const LoggedEstimate& last = log.back();
  const ErrorVector error =
      errorBetween(Planet::byName("earth"), last.estimate.nav, sequentialRun().back().estimate.nav);
  EXPECT_LT(error.segment<2>(kPosition).norm(), 3.0 * std::sqrt(last.P(kPosition, kPosition)));
  EXPECT_LT(error.segment<2>(kPosition).norm(), 30.0);
}

}  // namespace
}  // namespace slipnav::test
