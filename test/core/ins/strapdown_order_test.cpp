/// How fast the mechanization's errors vanish with the interval, and what sampling does to them.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analytic_motion.h"
#include "simulation/random.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav::test {
namespace {

AnalyticMotion atRest(const AttitudeFunction& attitude) {
  return {Planet::byName("earth"), attitude, constant(0.7), constant(0.1), constant(200.0)};
}

/// Rocks, turns and shakes in all six degrees of freedom, harder than a rover does.
AnalyticMotion roughRide() {
  const double R = 6.37e6;
  return {Planet::byName("earth"),
          eulerAttitude({0.02, 0.0, 0.15, 2.1, 0.3}, {-0.03, 0.0, 0.12, 2.9, 1.1}, {0.4, 0.05, 0.4, 0.7, 0.0}),
          {0.7, 0.8 / R, 0.3 / R, 1.3, 0.5},
          {0.1, -0.5 / R, 0.4 / R, 1.7, 0.2},
          {200.0, 0.02, 0.1, 2.3, 0.9}};
}

ErrorVector errorAfter(const AnalyticMotion& motion, double duration_s, double rate_hz) {
  return errorBetween(motion.planet(), mechanize(motion, duration_s, rate_hz), motion.state(duration_s));
}

/// Exponent k of an error that behaves like T^k, from one halving of T.
double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// Classical coning at 1 Hz. With mean rates alone as rotation vector the attitude drifts at ½ε²ω(1 − sin(ωT)/ωT),
/// second order in T; a first-order attitude update is no better. The correction for coning from the interval before
/// leaves fourth order.
TEST(StrapdownOrder, ConingDriftIsOfFourthOrder) {
  const double angle_rad = 0.1;
  const double frequency_radps = 2.0 * kPi;
  const AnalyticMotion motion = atRest(coningAttitude(angle_rad, frequency_radps));
  const double duration_s = 60.0;
  const double drift_20 = errorAfter(motion, duration_s, 20.0).segment<3>(kAttitude).norm();
  const double drift_40 = errorAfter(motion, duration_s, 40.0).segment<3>(kAttitude).norm();
  const double drift_80 = errorAfter(motion, duration_s, 80.0).segment<3>(kAttitude).norm();
  EXPECT_GT(order(drift_20, drift_40), 3.7);
  EXPECT_GT(order(drift_40, drift_80), 3.7);
  const double turn = frequency_radps / 20.0;
  const double uncorrected = 0.5 * angle_rad * angle_rad * frequency_radps * (1.0 - std::sin(turn) / turn) * duration_s;
  EXPECT_LT(drift_20, 0.1 * uncorrected);
}

/// Rotation about one axis in phase with acceleration along another: rectified to a constant acceleration of ½εAω²
/// along the third axis, to be sensed as zero.
TEST(StrapdownOrder, ScullingDriftIsOfFourthOrder) {
  const double frequency_radps = 2.0 * kPi;
  const double amplitude_m = 0.05;
  const AnalyticMotion motion(Planet::byName("earth"),
                              eulerAttitude(constant(0.0), {0.0, 0.0, 0.1, frequency_radps, 0.0}, constant(0.0)),
                              {0.7, 0.0, amplitude_m / 6.37e6, frequency_radps, 0.0}, constant(0.1), constant(200.0));
  const double duration_s = 20.0;
  const auto drift = [&](double rate_hz) { return std::abs(errorAfter(motion, duration_s, rate_hz)(kVelocity + 2)); };
  EXPECT_GT(order(drift(20.0), drift(40.0)), 3.7);
  EXPECT_GT(order(drift(40.0), drift(80.0)), 3.7);
  EXPECT_LT(drift(20.0), 1e-3 * 0.5 * 0.1 * amplitude_m * frequency_radps * frequency_radps * duration_s);
}

/// All of it together converges at least as T², and is good to centimeters in a minute at the lowest rate allowed.
TEST(StrapdownOrder, RoughRideConvergesFrom20To1000Hz) {
  const AnalyticMotion motion = roughRide();
  const double duration_s = 60.0;
  const auto position = [&](double rate_hz) {
    return errorAfter(motion, duration_s, rate_hz).segment<3>(kPosition).norm();
  };
  const double at_20 = position(20.0);
  const double at_40 = position(40.0);
  EXPECT_LT(at_20, 0.5);
  EXPECT_GT(order(at_20, at_40), 1.8);
  EXPECT_LT(position(1000.0), 1e-4);
}

/// The stamps tell the true interval: sampling instants that scatter by a quarter of the interval do no harm.
TEST(StrapdownOrder, JitterDoesNoHarm) {
  const AnalyticMotion motion = roughRide();
  sim::RandomStream random(1, "jitter");
  const double duration_s = 60.0;
  const double rate_hz = 50.0;
  std::vector<double> ends_s;
  for (int i = 1; i < static_cast<int>(duration_s * rate_hz); ++i) {
    ends_s.push_back((static_cast<double>(i) + random.uniform(-0.25, 0.25)) / rate_hz);
  }
  ends_s.push_back(duration_s);
  const NavigationState end = mechanize(motion, ends_s, -1.0 / rate_hz);
  const ErrorVector jittered = errorBetween(motion.planet(), end, motion.state(duration_s));
  const ErrorVector regular = errorAfter(motion, duration_s, rate_hz);
  EXPECT_LT(jittered.segment<3>(kPosition).norm(), 3.0 * regular.segment<3>(kPosition).norm());
  EXPECT_LT(jittered.segment<3>(kAttitude).norm(), 3.0 * regular.segment<3>(kAttitude).norm());
}

/// One interval, with the interval before it of another length: the correction for coning and sculling has to weigh it,
/// or the error of the step falls back to third order.
TEST(StrapdownOrder, IntervalsMayDifferInLength) {
  const AnalyticMotion motion = roughRide();
  const Strapdown strapdown(motion.planet());
  for (const double ratio : {0.5, 2.0}) {
    const auto attitudeError = [&](double T) {
      const NavigationState end =
          strapdown.propagate(motion.state(1.0), motion.imu(1.0 - ratio * T, 1.0), motion.imu(1.0, 1.0 + T), 0);
      return errorBetween(motion.planet(), end, motion.state(1.0 + T)).segment<3>(kAttitude).norm();
    };
    EXPECT_GT(order(attitudeError(0.1), attitudeError(0.05)), 3.5) << ratio;
  }
}

}  // namespace
}  // namespace slipnav::test
