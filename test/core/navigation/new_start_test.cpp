/// Every start of an estimator is like its first, whatever it has been through before.

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/navigation/estimator.h"
#include "core/navigation/mechanizer.h"
#include "recorded_drive.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kFixInterval = kSecond / 5;

Config config() {
  Config config = driveConfig(8.0);
  config.gnss.use = "always";
  return config;
}

/// What an estimator says, and how much of it after each sample.
struct Said {
  EstimateLog log;
  std::vector<std::size_t> counts;
};

/// An estimator that starts again and again, each time with a mechanization of its own and poor satellite fixes.
class Starts {
 public:
  Said run(const InitialState& initial, const std::vector<DriveSample>& samples) {
    const NavigationSetup setup = config().navigation();
    Mechanizer mechanizer(Planet::byName("earth"), setup.imu_input);
    const Start start{estimator_.start() + 1, mechanizer.session(), initial};
    mechanizer.take(start);
    estimator_.take(start);
    Said said;
    const auto sink = [&said](const Estimate& e, const ErrorCovariance& P) { said.log.push_back({e, P}); };
    PositionFix fix{initial.nav.stamp, initial.nav.position, Vector3::Constant(100.0)};
    for (const DriveSample& sample : samples) {
      if (sample.stamp() >= fix.stamp + kFixInterval) {
        fix.stamp = sample.stamp();
        estimator_.push(AntennaFix(fix));
      }
      sample.is_imu ? void(mechanizer.push(sample.imu)) : void(estimator_.push(sample.wheels));
      std::optional<Reply> reply;
      do {
        if (reply) {
          mechanizer.take(*reply);
        }
        mechanizer.run([&](const InsStep& step) { estimator_.push(mechanizer.start(), step); });
        reply = estimator_.advance(sink);
      } while (reply);
      said.counts.push_back(said.log.size());
    }
    return said;
  }

  const FilterEngine& engine() const { return estimator_.engine(); }

 private:
  Estimator estimator_{Planet::byName("earth"), config().navigation().filter};
};

/// The same drive at another time.
RecordedDrive later(RecordedDrive drive, Nanoseconds shift) {
  drive.initial.nav.stamp += shift;
  for (DriveSample& sample : drive.samples) {
    sample.imu.stamp += shift;
    sample.wheels.stamp += shift;
  }
  return drive;
}

/// A drive with a dead wheel and others that outrun the rover, of which no end is seen.
std::vector<DriveSample> troubled(const RecordedDrive& drive) {
  std::vector<DriveSample> samples(drive.samples.begin(),
                                   drive.samples.begin() + static_cast<std::ptrdiff_t>(drive.samples.size() / 2));
  const Nanoseconds trouble = samples.back().stamp() - 2 * kSecond;
  for (DriveSample& sample : samples) {
    if (!sample.is_imu && sample.stamp() > trouble) {
      sample.wheels.circumferential_mps[2] = 0.0;
      sample.wheels.motion.forward_mps *= 1.8;
      sample.wheels.largest_speed_mps *= 1.8;
    }
  }
  return samples;
}

TEST(NewStart, IsLikeTheFirst) {
  const RecordedDrive before = recordDrive(config());
  const RecordedDrive drive = later(before, 1000 * kSecond);
  Starts fresh;
  Starts experienced;
  experienced.run(before.initial, troubled(before));
  const Said expected = fresh.run(drive.initial, drive.samples);
  const Said said = experienced.run(drive.initial, drive.samples);
  EXPECT_EQ(said.counts, expected.counts);
  ASSERT_EQ(said.log.size(), expected.log.size());
  EXPECT_TRUE(sameEstimates(said.log, expected.log));
  for (std::size_t i = 0; i < said.log.size(); ++i) {
    const Estimate& a = said.log[i].estimate;
    const Estimate& b = expected.log[i].estimate;
    ASSERT_EQ(a.stuck, b.stuck) << i;
    ASSERT_EQ(a.has_wheels, b.has_wheels) << i;
    ASSERT_EQ(a.wheel_speed_used, b.wheel_speed_used) << i;
    ASSERT_EQ(a.wheels.stamp, b.wheels.stamp) << i;
    ASSERT_EQ(a.noise_factors.wheel, b.noise_factors.wheel) << i;
  }
}

/// A start becomes known long after its stamp.
TEST(NewStart, FixesOfTheDriveSoFarAreUsed) {
  const InitialState initial = recordDrive(config()).initial;
  const NavigationState& begin = initial.nav;
  Estimator estimator(Planet::byName("earth"), config().navigation().filter);
  for (int i = 1; i <= 5000; ++i) {
    EXPECT_TRUE(estimator.push(AntennaFix(PositionFix{begin.stamp + i, begin.position, Vector3::Ones()})));
  }
  estimator.take(Start{1, 0, initial});
  InsStep step;
  step.start = begin.stamp;
  step.state = begin;
  step.state.stamp += kSecond / 50;
  EXPECT_EQ(estimator.push(1, step), StepVerdict::kTaken);
  estimator.assumeCompleteUpTo(step.state.stamp);
  estimator.advance([](const Estimate&, const ErrorCovariance&) {});
  EXPECT_EQ(estimator.engine().status(kFixPosition).measured(), 4096U);
}

}  // namespace
}  // namespace slipnav::test
