#include "slipnav/core/ekf/adaptation/imu_noise_meter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.h"

namespace slipnav::test {
namespace {

constexpr double kPeriod_s = 0.02;

TEST(ImuNoiseMeter, FindsTheDensityOfWhiteNoiseBelowASmoothMotion) {
  for (const double std : {0.001, 0.4}) {
    ImuNoiseMeter meter;
    sim::RandomStream random(1, "noise");
    double sum = 0.0;
    int n = 0;
    for (int i = 0; i < 5000; ++i) {
      const double t_s = kPeriod_s * i;
      const Vector3 smooth(3.0 * std::sin(0.5 * t_s), 1.0, -9.8);
      meter.add(smooth + std * random.normal3(), 0.1 * std * random.normal3(), kPeriod_s);
      if (i > 500) {
        sum += meter.density().accel.mean();
        ++n;
      }
    }
    const double expected = std * std * kPeriod_s;
    EXPECT_GT(sum / n, 0.5 * expected);  // the smallest of four estimates lies below their mean
    EXPECT_LT(sum / n, 1.1 * expected);
  }
}

/// What shakes about a place: white noise of a velocity, whose increments the accelerometer senses.
TEST(ImuNoiseMeter, BoundedShakingIsLessThanItsSamplesSay) {
  ImuNoiseMeter meter;
  sim::RandomStream random(1, "noise");
  Vector3 before = Vector3::Zero();
  double sample_variance = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 velocity = 0.005 * random.normal3();
    const Vector3 f = (velocity - before) / kPeriod_s;
    sample_variance += f.squaredNorm() / 3.0 / 2000.0;
    before = velocity;
    meter.add(f, Vector3::Zero(), kPeriod_s);
  }
  EXPECT_LT(meter.density().accel.mean(), 0.4 * sample_variance * kPeriod_s);
}

TEST(ImuNoiseMeter, ShakingCountsAtOnce) {
  ImuNoiseMeter meter;
  sim::RandomStream random(1, "noise");
  const auto shake = [&](double std, double duration_s) {
    for (int i = 0; i < static_cast<int>(duration_s / kPeriod_s); ++i) {
      meter.add(std * random.normal3(), Vector3::Zero(), kPeriod_s);
    }
  };
  shake(0.001, 60.0);
  shake(0.4, 0.8);
  EXPECT_GT(meter.density().accel.mean(), 0.4 * 0.4 * 0.4 * kPeriod_s);
}

/// What shook seconds ago shakes no more: a share of 1/e remains after four.
TEST(ImuNoiseMeter, ForgetsOverSeconds) {
  ImuNoiseMeter meter;
  sim::RandomStream random(1, "noise");
  const auto run = [&](double std, double duration_s) {
    for (int i = 0; i < static_cast<int>(duration_s / kPeriod_s); ++i) {
      meter.add(std * random.normal3(), Vector3::Zero(), kPeriod_s);
    }
    return meter.density().accel.mean();
  };
  const double shaking = run(0.4, 20.0);
  const double after = run(0.0, 4.0);
  EXPECT_GT(after, 0.28 * shaking);
  EXPECT_LT(after, 0.48 * shaking);
}

/// Bounded shaking shows in long means only: one that a gap cuts in two belongs to neither of its sides.
TEST(ImuNoiseMeter, AMeanEndsAtAGap) {
  const auto density = [](int gap) {
    ImuNoiseMeter meter;
    sim::RandomStream random(1, "noise");
    Vector3 before = Vector3::Zero();
    for (int i = 0; i < 2000; ++i) {
      if (i == gap) {
        meter.interrupt();
      }
      const Vector3 velocity = 0.005 * random.normal3();
      meter.add((velocity - before) / kPeriod_s - 9.8 * Vector3::UnitZ(), Vector3::Zero(), kPeriod_s);
      before = velocity;
    }
    return meter.density().accel.z();
  };
  EXPECT_LT(density(1903), 2.0 * density(-1));
}

TEST(ImuNoiseMeter, AGapIsNoNoise) {
  ImuNoiseMeter meter;
  sim::RandomStream random(1, "noise");
  for (int i = 0; i < 1000; ++i) {
    if (i == 500) {
      meter.interrupt();
    }
    const Vector3 offset = i < 500 ? Vector3::Zero() : Vector3(5.0, 0.0, 0.0);
    meter.add(offset + 0.001 * random.normal3(), Vector3::Zero(), kPeriod_s);
  }
  EXPECT_LT(meter.density().accel.x(), 1e-7);
}

/// One sample of an eighth of a second that is off by one, after six that are not: the third difference is 1, the
/// density 1/8 / 20, over half a second a quarter of it; three and a half differences of it may be off by √(4.62/4).
TEST(ImuNoiseMeter, SaysWhatItMeasuresOnceHalfASecondIsKnown) {
  ImuNoiseMeter meter;
  for (int i = 0; i < 6; ++i) {
    meter.add(Vector3::Zero(), Vector3::Zero(), 0.125);
    EXPECT_EQ(meter.density().accel.x(), 0.0);
  }
  meter.add(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.0, 2.0), 0.125);
  const double expected = (1.0 + std::sqrt(4.62 / 4.0)) * 0.125 / 20.0 / 4.0;
  EXPECT_NEAR(meter.density().accel.x(), expected, 1e-12);
  EXPECT_NEAR(meter.density().gyro.z(), 4.0 * expected, 1e-12);
  EXPECT_EQ(meter.density().accel.y(), 0.0);
}

/// Of the samples before, nothing is in a mean or a difference.
TEST(ImuNoiseMeter, AfterAGapItBeginsAsAtFirst) {
  ImuNoiseMeter interrupted;
  ImuNoiseMeter fresh;
  for (int i = 0; i < 3; ++i) {
    interrupted.add(Vector3(7.0 * i, 3.0, 1.0), Vector3(1.0, 2.0, 5.0 * i), 0.5);
  }
  interrupted.interrupt();
  sim::RandomStream random(1, "noise");
  for (int i = 0; i < 200; ++i) {
    const Vector3 force = random.normal3();
    const Vector3 rate = random.normal3();
    interrupted.add(force, rate, kPeriod_s);
    fresh.add(force, rate, kPeriod_s);
    ASSERT_EQ(interrupted.density().accel, fresh.density().accel) << i;
    ASSERT_EQ(interrupted.density().gyro, fresh.density().gyro) << i;
  }
  EXPECT_GT(fresh.density().accel.minCoeff(), 0.0);
}

}  // namespace
}  // namespace slipnav::test
