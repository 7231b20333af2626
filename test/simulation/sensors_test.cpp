#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/sensor_models.h"
#include "simulation/simulator.h"
#include "simulation/vibration.h"

namespace slipnav::sim {
namespace {

const InertialMean kAtRest{Vector3(0.0, 0.0, -9.8), Vector3::Zero()};

ImuParams noiseOnly() {
  ImuParams params;
  params.gyro_turn_on_bias_deg_per_h = 0.0;
  params.accel_turn_on_bias_mg = 0.0;
  params.gyro_in_run_bias_deg_per_h = 0.0;
  params.accel_in_run_bias_ug = 0.0;
  params.scale_factor_ppm = 0.0;
  return params;
}

/// Spread of averages over `block` samples: white noise of density N gives N/√(block·dt).
double allanDeviation(const std::vector<double>& x, std::size_t block) {
  double sum = 0.0;
  double last = 0.0;
  std::size_t blocks = 0;
  for (std::size_t begin = 0; begin + block <= x.size(); begin += block, ++blocks) {
    double mean = 0.0;
    for (std::size_t i = begin; i < begin + block; ++i) {
      mean += x[i] / static_cast<double>(block);
    }
    sum += blocks > 0 ? (mean - last) * (mean - last) : 0.0;
    last = mean;
  }
  return std::sqrt(0.5 * sum / static_cast<double>(blocks - 1));
}

TEST(SimImu, WhiteNoiseHasTheDataSheetDensityAtAnyRateAndAveragingTime) {
  const double gyro_density = degToRad(0.1) / 60.0;  // 0.1 °/√h in rad/√s
  const double accel_density = 0.008 / 60.0;         // 0.008 m/s/√h in m/s/√s
  for (const double rate_hz : {50.0, 250.0}) {
    ImuModel imu(noiseOnly(), 3);
    std::vector<double> gyro;
    std::vector<double> accel;
    for (int i = 0; i < 100000; ++i) {
      const ImuSample sample = imu.measure(kAtRest, i, 1.0 / rate_hz);
      gyro.push_back(sample.omega_ib_b.y());
      accel.push_back(sample.f_ib_b.x());
    }
    for (const std::size_t block : {1U, 50U}) {
      const double root_time = std::sqrt(static_cast<double>(block) / rate_hz);
      EXPECT_NEAR(allanDeviation(gyro, block) * root_time / gyro_density, 1.0, 0.08);
      EXPECT_NEAR(allanDeviation(accel, block) * root_time / accel_density, 1.0, 0.08);
    }
  }
}

TEST(SimImu, TurnOnBiasesHaveTheirSpreadOverSeedsAndAreInTheSamples) {
  ImuParams params = noiseOnly();
  params.gyro_turn_on_bias_deg_per_h = 30.0;
  params.accel_turn_on_bias_mg = 1.5;
  params.gyro_noise_deg_per_sqrt_h = 0.0;
  params.accel_noise_mps_per_sqrt_h = 0.0;
  double gyro2 = 0.0;
  double accel2 = 0.0;
  const int seeds = 2000;
  for (int seed = 0; seed < seeds; ++seed) {
    ImuModel imu(params, static_cast<std::uint64_t>(seed));
    const ImuSample sample = imu.measure(kAtRest, 0, 0.02);
    EXPECT_LT((sample.omega_ib_b - imu.gyroBias()).norm(), 1e-15);
    EXPECT_LT((sample.f_ib_b - kAtRest.f_ib_b - imu.accelBias()).norm(), 1e-12);
    gyro2 += imu.gyroBias().squaredNorm() / (3.0 * seeds);
    accel2 += imu.accelBias().squaredNorm() / (3.0 * seeds);
  }
  EXPECT_NEAR(radToDeg(std::sqrt(gyro2)) * 3600.0, 30.0, 1.5);
  EXPECT_NEAR(std::sqrt(accel2) / 9.80665e-3, 1.5, 0.075);
}

TEST(SimImu, InRunBiasIsAStationaryGaussMarkovProcess) {
  ImuParams params = noiseOnly();
  params.gyro_in_run_bias_deg_per_h = 10.0;
  params.bias_correlation_s = 100.0;
  const double sigma = degToRad(10.0) / 3600.0;
  double variance = 0.0;
  double lagged = 0.0;
  const int seeds = 3000;
  for (int seed = 0; seed < seeds; ++seed) {
    ImuModel imu(params, static_cast<std::uint64_t>(seed));
    const Vector3 first = imu.gyroBias();
    for (int i = 0; i < 10; ++i) {
      imu.measure(kAtRest, 0, 10.0);  // a time constant in ten steps
    }
    variance += imu.gyroBias().squaredNorm() / (3.0 * seeds);
    lagged += imu.gyroBias().dot(first) / (3.0 * seeds);
  }
  EXPECT_NEAR(variance / (sigma * sigma), 1.0, 0.08);
  EXPECT_NEAR(lagged / (sigma * sigma), std::exp(-1.0), 0.06);
}

TEST(SimVibration, ShakesInMotionTremblesAtRestAndDoesNotDrift) {
  const GroundParams ground = groundByName("gravel");
  Vibration at_rest(ground, 1.0, 50.0, 1);
  EXPECT_EQ(at_rest.shake(kAtRest, 0.02, 0.0).omega_ib_b, kAtRest.omega_ib_b);
  EXPECT_GT(at_rest.velocity().norm(), 1e-6);
  EXPECT_LT(at_rest.velocity().norm(), 1e-3);
  Vibration vibration(ground, 1.0, 50.0, 1);
  double force2 = 0.0;
  double rate2 = 0.0;
  Vector3 velocity = Vector3::Zero();
  Vector3 angle = Vector3::Zero();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const InertialMean sensed = vibration.shake({Vector3::Zero(), Vector3::Zero()}, 0.02, kVibrationSpeed_mps);
    force2 += sensed.f_ib_b.squaredNorm() / (3.0 * count);
    rate2 += sensed.omega_ib_b.squaredNorm() / (3.0 * count);
    velocity += 0.02 * sensed.f_ib_b;
    angle += 0.02 * sensed.omega_ib_b;
    EXPECT_LT((velocity - vibration.velocity()).norm(), 1e-12);
    EXPECT_LT((angle - vibration.angle()).norm(), 1e-12);
  }
  EXPECT_NEAR(std::sqrt(force2) / ground.vibration_mps2, 1.0, 0.03);
  EXPECT_NEAR(std::sqrt(rate2) / ground.vibration_radps, 1.0, 0.03);
}

TEST(SimImu, ErrorFreeLeavesTheMeansUntouched) {
  ImuParams params;
  params.error_free = true;
  ImuModel imu(params, 1);
  const InertialMean mean{Vector3(1.0, 2.0, -9.0), Vector3(0.1, 0.2, 0.3)};
  const ImuSample sample = imu.measure(mean, 5, 0.02);
  EXPECT_EQ(sample.f_ib_b, mean.f_ib_b);
  EXPECT_EQ(sample.omega_ib_b, mean.omega_ib_b);
  EXPECT_EQ(imu.gyroBias(), Vector3(Vector3::Zero()));
}

TEST(SimImu, JitteredStampsSpreadAboutTheRegularOnesAndNeverGoBack) {
  SimulatorParams params;
  params.imu.stamp_jitter_s = 0.002;
  RoverSimulator rover(params, Planet::byName("earth"));
  const Nanoseconds start = rover.truth().stamp;
  Nanoseconds last = start;
  double sum2 = 0.0;
  const int count = 3000;
  for (int i = 1; i <= count; ++i) {
    const Nanoseconds stamp = rover.step({}).imu.stamp;
    EXPECT_GT(stamp, last);
    last = stamp;
    sum2 += std::pow(toSeconds(stamp - start) - i * 0.02, 2);
  }
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.002, 0.0002);
}

TEST(SimEncoder, CountsAreWholeAndRatesAreTheirDifferences) {
  EncoderParams params;
  params.counts_per_turn = 400.0;
  const double count_rad = 2.0 * kPi / params.counts_per_turn;
  EncoderModel encoder(params, 0, 9);
  EncoderAngles last = encoder.angles();
  for (int k = 1; k <= 200; ++k) {
    const double angle = 0.0313 * k;
    const WheelSample sample = encoder.measure({angle, -angle, 2.0 * angle, 0.0}, k * fromSeconds(0.1));
    EXPECT_EQ(sample.count, kWheelCount);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const double counts = encoder.angles()[i] / count_rad;
      EXPECT_NEAR(counts, std::round(counts), 1e-6);
      EXPECT_NEAR(sample.rate_radps[i], (encoder.angles()[i] - last[i]) / 0.1, 1e-9);
    }
    EXPECT_LE(std::abs(encoder.angles()[0] - angle), count_rad);
    EXPECT_LE(std::abs(encoder.angles()[1] + angle), count_rad);
    EXPECT_EQ(sample.rate_radps[3], 0.0);
    last = encoder.angles();
  }
}

TEST(SimEncoder, RateIsTheMeanOverTheTenthOfASecondBeforeTheStamp) {
  SimulatorParams params;
  params.terrain = "paved";
  params.vehicle.common_radius_error = 0.0;
  params.vehicle.wheel_radius_error = 0.0;
  RoverSimulator rover(params, Planet::byName("earth"));
  double sum = 0.0;
  double last = 0.0;
  int samples = 0;
  for (int i = 1; i <= 300; ++i) {
    const Measurements m = rover.step({0.8, 0.0});
    const double rate = rover.truth().wheel_rate_radps[2];
    sum += 0.5 * (last + rate) / 5.0;
    last = rate;
    ASSERT_EQ(m.wheel.has_value(), i % 5 == 0);
    if (m.wheel) {
      EXPECT_EQ(m.wheel->stamp, m.imu.stamp);
      EXPECT_NEAR(m.wheel->rate_radps[2], sum, 4e-3);  // a count is 1.3e-3 rad/s
      sum = 0.0;
      ++samples;
    }
  }
  EXPECT_EQ(samples, 60);
}

TEST(SimGnss, FixesScatterAboutTheAntenna) {
  SimulatorParams params;
  params.gps.antenna_x_m = 0.3;
  params.gps.antenna_z_m = -1.2;
  params.truth.horizontal_noise_m = 0.0;
  params.truth.vertical_noise_m = 0.0;
  const Planet planet = Planet::byName("earth");
  RoverSimulator rover(params, planet);
  const LocalFrame frame(planet, rover.truth().position);
  const Vector3 antenna_b(0.3, 0.0, -1.2);
  const Vector3 antenna_enu =
      frame.C_n_to_enu(rover.truth().position) * (rover.truth().q_b_to_n.toRotationMatrix() * antenna_b);
  Vector3 sum2 = Vector3::Zero();
  int count = 0;
  for (int i = 0; i < 20000; ++i) {
    const Measurements m = rover.step({});
    if (m.gps) {
      const Geodetic fix{degToRad(m.gps->latitude_deg), degToRad(m.gps->longitude_deg), m.gps->height_m};
      sum2 += (frame.toEnu(fix) - antenna_enu).cwiseAbs2();
      ++count;
      ASSERT_TRUE(m.truth.has_value());
      const Geodetic truth{degToRad(m.truth->latitude_deg), degToRad(m.truth->longitude_deg), m.truth->height_m};
      EXPECT_LT(frame.toEnu(truth).norm(), 1e-6);
    }
  }
  EXPECT_EQ(count, 4000);
  EXPECT_NEAR(std::sqrt(sum2.x() / count), 0.01, 0.0006);
  EXPECT_NEAR(std::sqrt(sum2.y() / count), 0.01, 0.0006);
  EXPECT_NEAR(std::sqrt(sum2.z() / count), 0.02, 0.0012);
}

TEST(SimSensors, KeepTheirOwnRatesBesideAnOddImuRate) {
  SimulatorParams params;
  params.imu.rate_hz = 37.0;
  RoverSimulator rover(params, Planet::byName("earth"));
  const Nanoseconds start = rover.truth().stamp;
  Nanoseconds last_imu = start;
  int wheels = 0;
  for (int i = 0; i < 370; ++i) {
    const Measurements m = rover.step({0.8, 0.0});
    if (m.wheel) {
      ++wheels;
      EXPECT_EQ(m.wheel->stamp, start + wheels * fromSeconds(0.1));
      EXPECT_GT(m.wheel->stamp, last_imu);
      EXPECT_LE(m.wheel->stamp, m.imu.stamp);
    }
    last_imu = m.imu.stamp;
  }
  EXPECT_EQ(wheels, 100);
}

TEST(SimParams, OutOfRangeAndTooFastSensorsAreNamed) {
  const auto complaint = [](const SimulatorParams& params) -> std::string {
    try {
      params.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  SimulatorParams params;
  EXPECT_EQ(complaint(params), "");
  params.imu.rate_hz = 5.0;
  EXPECT_NE(complaint(params).find("imu.rate_hz"), std::string::npos);
  params = SimulatorParams();
  params.truth.rate_hz = 40.0;
  EXPECT_NE(complaint(params).find("truth.rate_hz"), std::string::npos);
  params = SimulatorParams();
  params.terrain = "lava";
  EXPECT_NE(complaint(params).find("terrain"), std::string::npos);
}

}  // namespace
}  // namespace slipnav::sim
