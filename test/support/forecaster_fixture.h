#pragma once
/// A drive east on a road for tests of the forecaster.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "config/config.h"
#include "core/forecast/forecaster.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {

inline constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
inline constexpr double kWheelSpeed_mps = 0.8;

/// A drive east on a road, with wheel samples at 10 Hz.
class ForecasterTest : public ::testing::Test {
 protected:
  /// As after a stop, 10 m from where it seems.
  ForecasterTest() {
    P_.diagonal().segment<3>(kAttitude).setConstant(1e-8);
    P_.diagonal().segment<3>(kVelocity).setConstant(1e-6);
    P_.diagonal().segment<3>(kPosition).setConstant(100.0);
    P_.diagonal().segment<3>(kAccelBias).setConstant(1e-8);
    P_.diagonal().segment<3>(kGyroBias).setConstant(1e-13);
    P_.diagonal().tail<kErrorStates - kNavStates>().setConstant(1e-6);
  }

  Forecaster make(const ForecastParams& params = {}) const {
    return {Planet::byName("earth"), Config().navigation().filter, params};
  }

  Estimate estimate(int sample, double slip, bool stationary = false) const {
    Estimate e;
    e.nav.stamp = kStart + fromSeconds(0.1 * sample);
    e.nav.q_b_to_n = Quaternion(Eigen::AngleAxisd(0.5 * kPi, Vector3::UnitZ()));
    const double speed_mps = stationary ? 0.0 : kWheelSpeed_mps * (1.0 - slip);
    e.nav.v_eb_n = Vector3(0.0, speed_mps, 0.0);
    e.has_wheels = true;
    e.stationary = stationary;
    e.wheel_speed_used = !stationary;
    e.wheels.stamp = e.nav.stamp;
    e.wheels.motion.forward_mps = stationary ? 0.0 : kWheelSpeed_mps;
    e.motion = {0.1, Vector3(speed_mps, 0.0, 0.0), Vector3::Zero()};
    e.noise_factors = factors_;
    return e;
  }

  double slipAt(int sample, double size) const {
    return base_slip_ + size * std::sin(0.9 * sample) * std::cos(0.31 * sample);
  }

  /// Stands, then drives; the last forecast.
  std::optional<Forecast> drive(Forecaster& forecaster, int samples, double slip_size) {
    std::optional<Forecast> last;
    forecaster.push(estimate(0, 0.0, true), P_);
    for (int i = 1; i <= samples; ++i) {
      if (std::optional<Forecast> forecast = forecaster.push(estimate(i, slipAt(i, slip_size)), P_)) {
        last = std::move(forecast);
        ++forecasts_;
      }
    }
    return last;
  }

  ErrorCovariance P_ = ErrorCovariance::Zero();
  NoiseFactors factors_;
  double base_slip_ = 0.05;
  int forecasts_ = 0;
};

}  // namespace slipnav::test
