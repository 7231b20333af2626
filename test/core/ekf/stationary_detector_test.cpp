#include "slipnav/core/ekf/stationary_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/square.h"
#include "simulation/random.h"
#include "slipnav/core/ekf/engine/filter_data.h"

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
                          params().accel_std_mps2 / 3.0 * random_.normal3() + Vector3(accel_x(t_s), 0.0, 0.0);
      const Vector3 omega_b =
          degToRad(params().gyro_std_deg_per_s) / 3.0 * random_.normal3() + Vector3(0.0, 0.0, rate_z(t_s));
      detector_.addImu(fromSeconds(1000.0 + t_s), f_b, omega_b);
      if (index_ % kImuPerWheels == 0) {
        detector_.addWheels(fromSeconds(1000.0 + t_s), wheels(t_s));
        verdict_ = detector_.judge(kGravity);
        stationary_count_ += verdict_ ? 1 : 0;
      }
    }
  }
  void rest(double duration_s) { run(duration_s, kNone, kNone, kNone); }

  const Signal kNone = [](double) { return 0.0; };
  StationaryDetector detector_{params(), ImuFloor{}};
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

/// The noise of a rest about its own mean, whatever the biases.
TEST_F(StationaryDetectorTest, WindowTellsMeanAndScatter) {
  rest(10.0);
  const StationaryDetector::Window window = detector_.window();
  EXPECT_TRUE(window.filled);
  EXPECT_NEAR(std::sqrt(window.accel_variance), params().accel_std_mps2 / 3.0, 0.006);
  EXPECT_NEAR(std::sqrt(window.gyro_variance), degToRad(params().gyro_std_deg_per_s) / 3.0, degToRad(0.04));
  EXPECT_NEAR(window.f_ib_b.norm(), kGravity, 0.03);
  EXPECT_NEAR(window.period_s, kImuPeriod_s, 0.002);
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
  EXPECT_FALSE(detector_.window().filled);
  rest(0.2);
  EXPECT_FALSE(detector_.window().filled);
  rest(0.2);
  EXPECT_TRUE(detector_.window().filled);
  detector_.reset();
  EXPECT_FALSE(detector_.window().filled);
  EXPECT_FALSE(detector_.judge(kGravity));
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
  StationaryDetector detector(longest, ImuFloor{});
  for (int i = 0; i < 2500; ++i) {  // 1 kHz: the ring holds the whole window
    detector.addImu(fromSeconds(10.0 + 1e-3 * i), Vector3(0.0, 0.0, -kGravity), Vector3::Zero());
  }
  EXPECT_TRUE(detector.window().filled);
  EXPECT_NEAR(detector.window().accel_variance, 0.0, 1e-12);
}

/// Accelerometers that are half a percent off, but no more.
TEST_F(StationaryDetectorTest, AForceThatIsNearlyGravityIsRest) {
  run(
      2.0, [](double) { return 0.4; }, kNone, kNone);  // 0.03 m/s² more than gravity
  EXPECT_TRUE(verdict_);
  run(
      2.0, [](double) { return 0.9; }, kNone, kNone);  // 0.09 m/s²
  EXPECT_FALSE(verdict_);
}

/// A gyro bias that the data sheet allows for is no turn.
TEST_F(StationaryDetectorTest, ABiasIsNoMotion) {
  ImuFloor floor;
  floor.gyro_bias_std = degToRad(1.0);
  detector_ = StationaryDetector(params(), floor);
  run(
      2.0, kNone, [](double) { return degToRad(3.0); }, kNone);
  EXPECT_TRUE(verdict_);
  run(
      2.0, kNone, [](double) { return degToRad(8.0); }, kNone);
  EXPECT_FALSE(verdict_);
}

/// With an engine that shakes the rover at rest: beyond the parameters, but far calmer than driving.
TEST_F(StationaryDetectorTest, RestWithARunningEngineIsFoundAgain) {
  const Signal engine = [](double t_s) { return 0.25 * std::sin(150.0 * t_s); };
  const Signal rough = [](double t_s) { return 3.0 * std::sin(40.0 * t_s); };
  const Signal turning = [](double t_s) { return 0.3 * std::sin(30.0 * t_s); };
  run(5.0, engine, kNone, kNone);
  EXPECT_TRUE(verdict_);
  run(10.0, rough, turning, [](double) { return 0.5; });
  EXPECT_FALSE(verdict_);
  run(2.0, engine, kNone, kNone);
  EXPECT_TRUE(verdict_);
  run(2.0, rough, turning, kNone);  // encoders dead, rover moving
  EXPECT_FALSE(verdict_);
}

/// Before the rover has driven, rest may scatter more; a restart makes it so again.
TEST_F(StationaryDetectorTest, AfterAResetTheRoverHasNotDriven) {
  const Signal engine = [](double t_s) { return 0.25 * std::sin(150.0 * t_s); };
  run(0.5, engine, kNone, [](double) { return 0.5; });
  run(2.0, engine, kNone, kNone);
  EXPECT_FALSE(verdict_);
  detector_.reset();
  run(2.0, engine, kNone, kNone);
  EXPECT_TRUE(verdict_);
}

/// Neither what it took for rest nor what it took for driving is left.
TEST_F(StationaryDetectorTest, AResetDetectorIsLikeANewOne) {
  const Signal rough = [](double t_s) { return 3.0 * std::sin(40.0 * t_s); };
  const Signal turning = [](double t_s) { return 0.3 * std::sin(30.0 * t_s); };
  const Signal half = [](double) { return 0.5; };
  const auto verdicts = [&] {
    random_ = sim::RandomStream(2, "detector");
    index_ = 10'000;
    std::vector<bool> verdicts;
    for (int i = 0; i < 60; ++i) {
      const bool drives = i < 15;
      drives ? run(0.1, rough, turning, half) : rest(0.1);
      verdicts.insert(verdicts.end(), {verdict_, detector_.isCalmerThanDriving(false)});
    }
    return verdicts;
  };
  const std::vector<bool> expected = verdicts();
  detector_.reset();
  EXPECT_EQ(verdicts(), expected);
  EXPECT_EQ(std::count(expected.begin(), expected.begin() + 30, true), 0) << "a drive";
  EXPECT_TRUE(expected.back()) << "and a rest";
}

/// One sample of wheels that turn is not enough to compare with, however long the IMU has been heard before.
TEST_F(StationaryDetectorTest, AfterAResetOneSampleIsNoExperience) {
  detector_.reset();
  for (int i = 0; i < 50; ++i) {
    const double shaking = i % 2 == 0 ? 3.0 : -3.0;
    detector_.addImu(fromSeconds(900.0 + kImuPeriod_s * i), Vector3(shaking, 0.0, -kGravity),
                     Vector3(0.0, shaking, 0.0));
  }
  detector_.addWheels(fromSeconds(901.0), 0.5);
  EXPECT_FALSE(detector_.judge(kGravity));
  rest(1.0);
  EXPECT_FALSE(detector_.isCalmerThanDriving(false));
}

/// What the data sheet says that the IMU scatters by at its rate is no motion, whatever the limits are.
TEST_F(StationaryDetectorTest, TheNoiseOfThisImuIsNoMotion) {
  const Signal force = [this](double) { return 0.2 * random_.normal(); };
  const Signal rate = [this](double) { return degToRad(0.8) * random_.normal(); };
  ImuFloor floor;
  floor.accel_bias_std = 0.1;
  floor.gyro_bias_std = degToRad(0.3);
  const auto drive_and_rest = [&] {
    detector_ = StationaryDetector(params(), floor);
    run(0.5, force, rate, [](double) { return 0.5; });
    run(2.0, force, rate, kNone);
    return verdict_;
  };
  EXPECT_FALSE(drive_and_rest());
  floor.accel_density = square(0.15) * kImuPeriod_s;
  floor.gyro_density = square(degToRad(0.6)) * kImuPeriod_s;
  EXPECT_TRUE(drive_and_rest());
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
  strict.hold_off_s = 60.0;
  detector_.retune(strict);
  EXPECT_FALSE(detector_.judge(kGravity));
  detector_.retune(params());
  EXPECT_TRUE(detector_.judge(kGravity));
}

/// Of an IMU so fast that its samples of a window are more than are kept, those that are kept are the window.
TEST_F(StationaryDetectorTest, AWindowIsFilledByTheLastTwoThousandSamples) {
  for (int i = 0; i < 2047; ++i) {
    detector_.addImu(fromSeconds(10.0 + 1e-5 * i), Vector3(0.0, 0.0, -kGravity), Vector3::Zero());
  }
  EXPECT_FALSE(detector_.window().filled);
  detector_.addImu(fromSeconds(10.1), Vector3(0.0, 0.0, -kGravity), Vector3::Zero());
  EXPECT_TRUE(detector_.window().filled);
  EXPECT_NEAR(detector_.window().period_s, params().window_s / 2048.0, 1e-12);
}

}  // namespace
}  // namespace slipnav::test
