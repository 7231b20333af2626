#include "slipnav/core/ekf/models/motion_average.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

InsStep stepOf(Nanoseconds start_ms, Nanoseconds end_ms, double rate) {
  InsStep step;
  step.start = start_ms * kMillisecond;
  step.state.stamp = end_ms * kMillisecond;
  step.omega_ib_b = Vector3(0.0, 0.0, rate);
  return step;
}

TEST(MotionAverage, WeighsStepsByTheirShareOfTheInterval) {
  MotionAverage average;
  average.restart(110 * kMillisecond);
  EXPECT_EQ(average.start(), 110 * kMillisecond);
  const Nanoseconds end = 165 * kMillisecond;
  // 10 ms of the first step, all of the second, 25 ms of the third
  average.add(stepOf(100, 120, 1.0), Vector3(1.0, 0.0, 0.0), average.start(), end);
  average.add(stepOf(120, 140, 2.0), Vector3(2.0, 0.0, 0.0), average.start(), end);
  average.add(stepOf(140, 180, 4.0), Vector3(4.0, 0.0, 0.0), average.start(), end);
  const BodyMotion mean = average.mean().value();
  EXPECT_NEAR(mean.duration_s, 0.055, 1e-12);
  EXPECT_NEAR(mean.v_eb_b.x(), (10.0 * 1.0 + 20.0 * 2.0 + 25.0 * 4.0) / 55.0, 1e-12);
  EXPECT_NEAR(mean.omega_ib_b.z(), (10.0 * 1.0 + 20.0 * 2.0 + 25.0 * 4.0) / 55.0, 1e-12);
}

TEST(MotionAverage, NothingOutsideTheInterval) {
  MotionAverage average;
  average.restart(100 * kMillisecond);
  average.add(stepOf(60, 100, 1.0), Vector3::Ones(), average.start(), 200 * kMillisecond);
  average.add(stepOf(200, 220, 1.0), Vector3::Ones(), average.start(), 200 * kMillisecond);
  EXPECT_FALSE(average.mean());
}

TEST(MotionAverage, RestartForgets) {
  MotionAverage average;
  average.restart(100 * kMillisecond);
  average.add(stepOf(100, 120, 5.0), Vector3::Ones(), average.start(), 120 * kMillisecond);
  average.restart(120 * kMillisecond);
  EXPECT_FALSE(average.mean());
  average.add(stepOf(120, 140, 1.0), Vector3::Zero(), average.start(), 140 * kMillisecond);
  EXPECT_DOUBLE_EQ(average.mean()->omega_ib_b.z(), 1.0);
}

}  // namespace
}  // namespace slipnav::test
