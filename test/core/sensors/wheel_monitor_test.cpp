#include "slipnav/core/sensors/wheel_monitor.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr double kYawRate_radps = 0.4;
constexpr Nanoseconds kInterval = 100'000'000;

enum Wheel : std::size_t { kFrontLeft, kFrontRight, kBackLeft, kBackRight };

class WheelMonitorTest : public ::testing::Test {
 protected:
  /// Speeds of a vehicle that turns to the right at `forward_mps`.
  std::array<double, kMaxWheels> speeds(double forward_mps) const {
    std::array<double, kMaxWheels> speed = {};
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      speed[i] = forward_mps + kYawRate_radps * wheels_[i].y_m;
    }
    return speed;
  }

  void add(const std::array<double, kMaxWheels>& speed, int times) {
    for (int i = 0; i < times; ++i) {
      monitor_.add(stamp_ += kInterval, speed, kYawRate_radps);
    }
  }

  const std::vector<WheelParams> wheels_ = pathfinderWheels();
  Nanoseconds stamp_ = 1'000'000'000;
  WheelMonitor monitor_{WheelMonitorParams{}, wheels_};
};

TEST_F(WheelMonitorTest, WheelsOfAVehicleThatTurnsAgree) {
  add(speeds(0.8), 50);
  EXPECT_EQ(monitor_.faultyCount(), 0U);
  EXPECT_NEAR(monitor_.soundSpeed(), 0.8, 1e-12);
}

TEST_F(WheelMonitorTest, ADeadEncoderIsFoundAndLeftOut) {
  std::array<double, kMaxWheels> speed = speeds(0.8);
  speed[kBackLeft] = 0.0;
  add(speed, 10);
  EXPECT_EQ(monitor_.faultyCount(), 0U);  // may be slip
  add(speed, 2);
  EXPECT_EQ(monitor_.faultyCount(), 1U);
  EXPECT_TRUE(monitor_.isFaulty(kBackLeft));
  EXPECT_TRUE(monitor_.isUsable());
  EXPECT_NEAR(monitor_.soundSpeed(), 0.8, 1e-12);
}

TEST_F(WheelMonitorTest, AWheelInTheAirIsFoundAndComesBack) {
  std::array<double, kMaxWheels> speed = speeds(0.8);
  speed[kFrontRight] = 1.6;
  add(speed, 20);
  EXPECT_TRUE(monitor_.isFaulty(kFrontRight));
  add(speeds(0.8), 10);
  EXPECT_TRUE(monitor_.isFaulty(kFrontRight));
  add(speeds(0.8), 2);
  EXPECT_EQ(monitor_.faultyCount(), 0U);
}

TEST_F(WheelMonitorTest, ShortSlipIsNoFault) {
  std::array<double, kMaxWheels> slipping = speeds(0.8);
  slipping[kFrontLeft] = 2.0;
  for (int i = 0; i < 10; ++i) {
    add(slipping, 8);
    add(speeds(0.8), 2);
  }
  EXPECT_EQ(monitor_.faultyCount(), 0U);
}

TEST_F(WheelMonitorTest, LeftAndRightMixedUpMakeAllOfThemUnusable) {
  const double fast_yaw_rate_radps = 2.0;
  std::array<double, kMaxWheels> speed = {};
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    speed[i] = 0.1 - fast_yaw_rate_radps * wheels_[i].y_m;
  }
  for (int i = 0; i < 20; ++i) {
    monitor_.add(stamp_ += kInterval, speed, fast_yaw_rate_radps);
  }
  EXPECT_EQ(monitor_.faultyCount(), 4U);
  EXPECT_FALSE(monitor_.isUsable());
}

TEST_F(WheelMonitorTest, ResetForgets) {
  std::array<double, kMaxWheels> speed = speeds(0.8);
  speed[kBackLeft] = 0.0;
  add(speed, 20);
  monitor_.reset();
  EXPECT_EQ(monitor_.faultyCount(), 0U);
}

}  // namespace
}  // namespace slipnav
