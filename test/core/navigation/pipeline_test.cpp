#include "slipnav/core/navigation/pipeline.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "recorded_drive.h"

namespace slipnav::test {
namespace {

/// A pipeline that starts from a given heading, leveled at rest.
class PipelineTest : public ::testing::Test {
 protected:
  static Config config() {
    Config config = driveConfig(6.0);
    config.initialization.source = "given";
    config.initialization.leveling_window_s = 3.0;
    return config;
  }

  void feed(Nanoseconds shift = 0) {
    for (DriveSample sample : drive_.samples) {
      if (sample.is_imu) {
        sample.imu.stamp += shift;
        pipeline_.push(sample.imu);
      } else {
        sample.wheels.stamp += shift;
        pipeline_.push(sample.wheels);
      }
    }
  }

  const RecordedDrive drive_ = recordDrive(config());
  std::vector<NavigationState> estimates_;
  Pipeline pipeline_{Planet::byName("earth"), config().navigation(),
                     [this](const Estimate& e, const ErrorCovariance&) { estimates_.push_back(e.nav); }};
};

TEST_F(PipelineTest, StartsAndEstimates) {
  EXPECT_FALSE(pipeline_.initial());
  feed();
  ASSERT_TRUE(pipeline_.initial());
  EXPECT_GT(estimates_.size(), 500U);
  EXPECT_EQ(pipeline_.counts().rejected, 0U);
  EXPECT_EQ(pipeline_.counts().restarts, 0U);
  EXPECT_EQ(pipeline_.counts().imu + pipeline_.counts().wheels, drive_.samples.size());
  // samples from before the initialization ended are used: estimates begin right after the initial state
  EXPECT_EQ(estimates_.front().stamp, pipeline_.initial()->nav.stamp + 20'000'000);
}

TEST_F(PipelineTest, BadSamplesAreCountedAndDoNoHarm) {
  feed();
  const std::size_t before = estimates_.size();
  ImuSample imu;
  imu.stamp = drive_.samples.back().stamp() + 20'000'000;
  imu.f_ib_b.x() = std::numeric_limits<double>::quiet_NaN();
  pipeline_.push(imu);
  WheelMotion wheels;
  wheels.stamp = imu.stamp;
  wheels.motion.forward_mps = std::numeric_limits<double>::infinity();
  pipeline_.push(wheels);
  EXPECT_EQ(pipeline_.counts().rejected, 2U);
  EXPECT_EQ(estimates_.size(), before);
}

TEST_F(PipelineTest, BeginsAnewWhenTheClockGoesBack) {
  feed();
  const std::vector<NavigationState> first = estimates_;
  estimates_.clear();
  feed(-fromSeconds(1000.0));
  EXPECT_EQ(pipeline_.counts().restarts, 1U);
  ASSERT_GT(estimates_.size(), 500U);
  // the same drive, earlier: the same estimate at its end
  EXPECT_EQ(estimates_.back().stamp, first.back().stamp - fromSeconds(1000.0));
  EXPECT_TRUE(estimates_.back().v_eb_n == first.back().v_eb_n);
}

/// A listener changes nothing, and keeps listening when the clock has gone back.
TEST_F(PipelineTest, InnovationsAreToldAcrossRestarts) {
  feed();
  const std::vector<NavigationState> silent = estimates_;
  estimates_.clear();
  std::vector<Nanoseconds> stamps;
  pipeline_.onInnovation([&stamps](const Innovation& innovation) { stamps.push_back(innovation.stamp); });
  feed(-fromSeconds(1000.0));
  EXPECT_EQ(pipeline_.counts().restarts, 1U);
  EXPECT_GT(stamps.size(), 100U);
  ASSERT_EQ(estimates_.size(), silent.size());
  EXPECT_EQ(estimates_.back().v_eb_n, silent.back().v_eb_n);
}

/// Stamps of a busy host: the estimate is that of even ones, and the scatter has a name and a size.
TEST_F(PipelineTest, StampsThatScatterDoNoHarm) {
  feed();
  const NavigationState even = estimates_.back();
  std::vector<NavigationState> scattered;
  Pipeline pipeline(Planet::byName("earth"), config().navigation(),
                    [&scattered](const Estimate& e, const ErrorCovariance&) { scattered.push_back(e.nav); });
  int number = 0;
  for (DriveSample sample : drive_.samples) {
    if (sample.is_imu) {
      const bool late = ++number > 100 && number % 5 == 0;
      sample.imu.stamp += late ? fromSeconds(0.018) : 0;
      pipeline.push(sample.imu);
    } else {
      pipeline.push(sample.wheels);
    }
  }
  EXPECT_EQ(pipeline.counts().gaps, 0U);
  EXPECT_EQ(pipeline.counts().rejected, 0U);
  EXPECT_NEAR(static_cast<double>(scattered.size()), static_cast<double>(estimates_.size()), 2.0);
  const Planet earth = Planet::byName("earth");
  EXPECT_LT(positionDifference(earth, scattered.back().position, even.position).norm(), 0.02);
  const Alarms& alarms = pipeline.health().alarms();
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_EQ(alarms.begin()->first, "IMU stamps scatter by 9 ms");
}

TEST_F(PipelineTest, GapsAreCounted) {
  Pipeline pipeline(Planet::byName("earth"), config().navigation(), [](const Estimate&, const ErrorCovariance&) {});
  std::size_t i = 0;
  for (const DriveSample& sample : drive_.samples) {
    if (sample.is_imu && (++i < 300 || i > 320)) {
      pipeline.push(sample.imu);
    }
  }
  EXPECT_EQ(pipeline.counts().gaps, 1U);
}

}  // namespace
}  // namespace slipnav::test
