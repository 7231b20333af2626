#include "slipnav/slip/stationary_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "slipnav/filter/filter_data.h"
#include "slipnav/sim/random.h"

namespace slipnav::test {
namespace {

constexpr double kGravity = 9.8;
constexpr double kImuPeriod_s = 0.02;
constexpr int kImuPerWheels = 5;

StationaryParams params() {
  StationaryParams params;
  params.window_s = 0.3;
  params.hold_off_s = 0.5;
  params.wheel_speed_mps = 0.001;
  params.accel_std_mps2 = 0.05;
  params.gyro_std_deg_per_s = 0.3;
  params.shoe_threshold = 9.0;
  return params;
}

/// Feeds a detector with samples of its own noise and whatever motion a test adds, at 50 Hz and 10 Hz.
class StationaryDetectorTest : public ::testing::Test {
 protected:
  using Signal = std::function<double(double t_s)>;

  /// @param accel_x added to the specific force; @param rate_z to the angular rate; @param wheels largest speed
  void run(double duration_s, const Signal& accel_x, const Signal& rate_z, const Signal& wheels) {
    const auto count = static_cast<int>(std::lround(duration_s / kImuPeriod_s));
    for (int i = 0; i < count; ++i) {
      const double t_s = static_cast<double>(++index_) * kImuPeriod_s;
      const Vector3 f_b = Vector3(0.5, -0.3, -std::sqrt(kGravity * kGravity - 0.34)) +
                          params().accel_std_mps2 * random_.normal3() + Vector3(accel_x(t_s), 0.0, 0.0);
      const Vector3 omega_b =
          degToRad(params().gyro_std_deg_per_s) * random_.normal3() + Vector3(0.0, 0.0, rate_z(t_s));
      detector_.addImu(fromSeconds(1000.0 + t_s), f_b, omega_b);
      if (index_ % kImuPerWheels == 0) {
        detector_.addWheels(fromSeconds(1000.0 + t_s), wheels(t_s));
        verdict_ = detector_.isStationary(kGravity);
        stationary_count_ += verdict_ ? 1 : 0;
      }
    }
  }
  void rest(double duration_s) { run(duration_s, kNone, kNone, kNone); }

  const Signal kNone = [](double) { return 0.0; };
  StationaryDetector detector_{params()};
  sim::RandomStream random_{1, "detector"};
  int index_ = 0;
  bool verdict_ = false;
  int stationary_count_ = 0;
};

TEST_F(StationaryDetectorTest, RestIsFound) {
  rest(2.0);
  EXPECT_TRUE(verdict_);
  EXPECT_TRUE(detector_.wheelsAtRest());
}

/// Skog et al.: six squared deviations a sample, less what the mean direction takes up.
TEST_F(StationaryDetectorTest, StatisticOfItsOwnNoiseIsAboutSix) {
  rest(1.0);
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    rest(0.3);
    sum += detector_.shoeStatistic(kGravity);
  }
  EXPECT_NEAR(sum / 200.0, 6.0, 0.3);
}

TEST_F(StationaryDetectorTest, TurningWheelsAreNoRest) {
  rest(2.0);
  run(0.1, kNone, kNone, [](double) { return 0.0011; });
  EXPECT_FALSE(verdict_);
  EXPECT_FALSE(detector_.wheelsAtRest());
}

TEST_F(StationaryDetectorTest, ASlideOnStoppedWheelsIsNoRest) {
  rest(2.0);
  run(
      0.5, [](double t_s) { return 0.3 * std::sin(20.0 * t_s); }, kNone, kNone);
  EXPECT_FALSE(verdict_);
  EXPECT_TRUE(detector_.wheelsAtRest());
}

TEST_F(StationaryDetectorTest, ATurnOnStoppedWheelsIsNoRest) {
  rest(2.0);
  run(
      0.5, kNone, [](double) { return degToRad(2.0); }, kNone);
  EXPECT_FALSE(verdict_);
  rest(1.0);
  EXPECT_TRUE(verdict_);
}

TEST_F(StationaryDetectorTest, AForceThatIsNotGravityIsNoRest) {
  rest(2.0);
  run(
      0.5, [](double) { return 5.0; }, kNone, kNone);  // steady, but of the wrong size
  EXPECT_FALSE(verdict_);
}

TEST_F(StationaryDetectorTest, WindowHasToBeFilled) {
  EXPECT_TRUE(std::isinf(detector_.shoeStatistic(kGravity)));
  rest(0.2);
  EXPECT_TRUE(std::isinf(detector_.shoeStatistic(kGravity)));
  rest(0.2);
  EXPECT_FALSE(std::isinf(detector_.shoeStatistic(kGravity)));
  detector_.reset();
  EXPECT_TRUE(std::isinf(detector_.shoeStatistic(kGravity)));
  EXPECT_FALSE(detector_.isStationary(kGravity));
}

TEST_F(StationaryDetectorTest, WheelsHaveToHaveRestedForTheHoldOff) {
  run(2.0, kNone, kNone, [](double) { return 0.5; });
  EXPECT_EQ(stationary_count_, 0);
  rest(0.5);  // first sample of rest at 0.1 s
  EXPECT_FALSE(verdict_);
  rest(0.1);
  EXPECT_TRUE(verdict_);
}

TEST_F(StationaryDetectorTest, AFastImuStillFillsTheWindow) {
  StationaryParams longest = params();
  longest.window_s = 2.0;
  StationaryDetector detector(longest);
  for (int i = 0; i < 2500; ++i) {  // 1 kHz: the ring holds the whole window
    detector.addImu(fromSeconds(10.0 + 1e-3 * i), Vector3(0.0, 0.0, -kGravity), Vector3::Zero());
  }
  EXPECT_NEAR(detector.shoeStatistic(kGravity), 0.0, 1e-6);
}

/// One encoder that is stuck at zero does not fake a stop: the fastest wheel counts.
TEST_F(StationaryDetectorTest, AStuckEncoderDoesNotFakeAStop) {
  WheelSample sample;
  sample.count = 4;
  sample.rate_radps = {0.0, 0.5, 0.5, 0.5};
  const double largest = toWheelMotion(WheelGeometry(pathfinderWheels(), 1.0), sample).largest_speed_mps;
  run(3.0, kNone, kNone, [largest](double) { return largest; });
  EXPECT_EQ(stationary_count_, 0);
}

TEST_F(StationaryDetectorTest, OtherLimitsHoldAtOnceForTheSamplesSoFar) {
  rest(2.0);
  ASSERT_TRUE(verdict_);
  StationaryParams strict = params();
  strict.shoe_threshold = 1.0;
  detector_.retune(strict);
  EXPECT_FALSE(detector_.isStationary(kGravity));
  detector_.retune(params());
  EXPECT_TRUE(detector_.isStationary(kGravity));
}

}  // namespace
}  // namespace slipnav::test
