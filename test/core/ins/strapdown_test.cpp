/// Mechanization on motion that is known in closed form: rest, travel over the ellipsoid, rotation, free fall.

#include "slipnav/core/ins/strapdown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic_motion.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav::test {
namespace {

constexpr double kHour_s = 3600.0;

AttitudeFunction fixedAttitude() { return eulerAttitude(constant(0.05), constant(-0.1), constant(2.0)); }

struct Mismatch {
  double attitude_rad;
  double velocity_mps;
  double horizontal_m;
  double vertical_m;
};

Mismatch mismatch(const Planet& planet, const NavigationState& estimate, const NavigationState& truth) {
  const ErrorVector error = errorBetween(planet, estimate, truth);
  return {error.segment<3>(kAttitude).norm(), error.segment<3>(kVelocity).norm(), error.segment<2>(kPosition).norm(),
          std::abs(error(kPosition + 2))};
}

Mismatch mismatchAfter(const AnalyticMotion& motion, double duration_s, double rate_hz) {
  return mismatch(motion.planet(), mechanize(motion, duration_s, rate_hz), motion.state(duration_s));
}

/// An hour at rest. What a step neglects is of second order in the planet's rotation during it: g (ω_ie T)² ≈ 2e-11
/// m/s², a tenth of a millimeter in an hour; the vertical channel amplifies rounding by e^(t √(2g/R)) ≈ 700, and next
/// to the pole tan L = 570 turns it into heading.
TEST(Strapdown, StaysWhereItIsAtRest) {
  const Planet earth = Planet::byName("earth");
  const Strapdown strapdown(earth);
  for (const double latitude_deg : {0.0, 39.7, -55.0, 75.0, 89.9}) {
    const AnalyticMotion motion(earth, fixedAttitude(), constant(degToRad(latitude_deg)), constant(-1.4),
                                constant(250.0));
    const double T = 0.02;
    const ImuInterval imu = motion.imu(0.0, T);
    const NavigationState truth = motion.state(0.0);
    NavigationState state = truth;
    for (int i = 0; i < 180000; ++i) {
      state = strapdown.propagate(state, imu, imu, truth.stamp);
    }
    const Mismatch error = mismatch(earth, state, truth);
    EXPECT_LT(error.attitude_rad, latitude_deg > 89.0 ? 1e-8 : 1e-10) << latitude_deg;
    EXPECT_LT(error.velocity_mps, 5e-6) << latitude_deg;
    EXPECT_LT(error.horizontal_m, 1e-3) << latitude_deg;
    EXPECT_LT(error.vertical_m, 1e-3) << latitude_deg;
  }
}

/// Travel at a constant angular rate along a meridian and along a parallel: slow as a rover and fast as an aircraft.
TEST(Strapdown, FollowsAMeridian) {
  const Planet earth = Planet::byName("earth");
  for (const double latitude_rate : {1.3e-7, -3.0e-5}) {
    const AnalyticMotion motion(earth, fixedAttitude(), steady(degToRad(50.0), latitude_rate), constant(0.2),
                                constant(100.0));
    const Mismatch error = mismatchAfter(motion, kHour_s, 20.0);
    EXPECT_LT(error.attitude_rad, 1e-9);
    EXPECT_LT(error.velocity_mps, 1e-5);
    EXPECT_LT(error.horizontal_m, 1e-2);
    EXPECT_LT(error.vertical_m, 1e-2);
  }
}

TEST(Strapdown, FollowsAParallelAcrossTheDateLine) {
  const Planet earth = Planet::byName("earth");
  for (const double longitude_rate : {2.5e-7, 4.0e-5}) {
    const AnalyticMotion motion(earth, fixedAttitude(), constant(degToRad(60.0)), steady(3.1415, longitude_rate),
                                constant(100.0));
    ASSERT_LT(motion.state(kHour_s).position.longitude_rad, 0.0);
    const Mismatch error = mismatchAfter(motion, kHour_s, 20.0);
    EXPECT_LT(error.attitude_rad, 1e-9);
    EXPECT_LT(error.velocity_mps, 1e-5);
    EXPECT_LT(error.horizontal_m, 1e-2);
    EXPECT_LT(error.vertical_m, 1e-2);
  }
}

TEST(Strapdown, FollowsAClimb) {
  const Planet mars = Planet::byName("mars");
  const AnalyticMotion motion(mars, fixedAttitude(), steady(0.3, 1e-6), steady(1.0, -2e-6), steady(0.0, 3.0));
  const Mismatch error = mismatchAfter(motion, 600.0, 20.0);
  EXPECT_LT(error.attitude_rad, 1e-10);
  EXPECT_LT(error.velocity_mps, 1e-6);
  EXPECT_LT(error.horizontal_m, 1e-3);
  EXPECT_LT(error.vertical_m, 1e-3);
}

/// Ten minutes of spinning about one body axis: nothing is lost in the attitude.
TEST(Strapdown, SpinsAboutOneAxis) {
  const Planet earth = Planet::byName("earth");
  const AnalyticMotion motion(earth, eulerAttitude(constant(0.0), constant(0.0), steady(0.3, 1.0)),
                              constant(degToRad(45.0)), constant(0.0), constant(0.0));
  const Mismatch error = mismatchAfter(motion, 600.0, 50.0);
  EXPECT_LT(error.attitude_rad, 1e-8);
  EXPECT_LT(error.velocity_mps, 1e-4);
  EXPECT_LT(error.horizontal_m, 1e-2);
}

/// A body thrown up at v falls 4 ω cos L v³ / (3 g²) to the west of where it started (Coriolis; Marion and Thornton,
/// Classical Dynamics, 10.4): closed form, first order in ω, and free of the code's formulas.
TEST(Strapdown, ThrownUpFallsToTheWest) {
  const Planet earth = Planet::byName("earth");
  const Strapdown strapdown(earth);
  NavigationState state;
  state.position = {degToRad(45.0), 0.0, 0.0};
  const NavigationState start = state;
  const double up_mps = 50.0;
  state.v_eb_n = Vector3(0.0, 0.0, -up_mps);
  const double g = earth.gravity_n(state.position).z();
  const double flight_s = 2.0 * up_mps / g;
  const int steps = 2000;
  // a body that senses nothing, and does not turn in inertial space
  const ImuInterval nothing{Vector3::Zero(), Vector3::Zero(), flight_s / steps};
  for (int i = 0; i < steps; ++i) {
    state = strapdown.propagate(state, nothing, nothing, 0);
  }
  const Vector3 landed = positionDifference(earth, state.position, start.position);
  const double west_m =
      4.0 * earth.rotationRate() * std::cos(start.position.latitude_rad) * std::pow(up_mps, 3) / (3.0 * g * g);
  EXPECT_NEAR(landed.y(), -west_m, 1e-3 * west_m);
  EXPECT_NEAR(landed.x(), 0.0, 1e-3);
  // up to 127 m gravity is weaker by up to 4e-5 of it, and the body comes back a few milliseconds later
  EXPECT_NEAR(state.v_eb_n.z(), up_mps, 5e-3);
  EXPECT_NEAR(landed.z(), 0.0, 0.2);
  // the planet turns away below it: seen from the ground the body turns backwards
  const Vector3 turn = rotationVectorFromQuaternion(state.q_b_to_n);
  EXPECT_NEAR((turn + flight_s * earth.omega_ie_n(start.position.latitude_rad)).norm(), 0.0, 1e-6);
}

TEST(Strapdown, BiasesAreSubtracted) {
  const Planet earth = Planet::byName("earth");
  const AnalyticMotion motion(earth, fixedAttitude(), constant(0.7), constant(0.1), constant(0.0));
  const Strapdown strapdown(earth);
  NavigationState state = motion.state(0.0);
  state.accel_bias_b = Vector3(0.1, -0.2, 0.3);
  state.gyro_bias_b = Vector3(0.01, 0.02, -0.03);
  ImuInterval imu = motion.imu(0.0, 0.02);
  imu.f_ib_b += state.accel_bias_b;
  imu.omega_ib_b += state.gyro_bias_b;
  for (int i = 0; i < 3000; ++i) {
    state = strapdown.propagate(state, imu, imu, 17);
  }
  const Mismatch error = mismatch(earth, state, motion.state(0.0));
  EXPECT_LT(error.attitude_rad, 1e-11);
  EXPECT_LT(error.horizontal_m, 1e-5);
  EXPECT_LT(error.vertical_m, 1e-5);
  EXPECT_EQ(state.stamp, 17);
  EXPECT_EQ(state.accel_bias_b, Vector3(0.1, -0.2, 0.3));
  EXPECT_EQ(state.gyro_bias_b, Vector3(0.01, 0.02, -0.03));
}

/// A vehicle turns to and fro on the spot; its IMU is not where it is configured to be. The change of the mean rates
/// lags by half a step, which leaves ½ α T l = 2 mm/s.
TEST(Strapdown, OffsetOfTheImuIsRemoved) {
  const Planet earth = Planet::byName("earth");
  const Wave yaw{0.3, 0.0, 0.8, 1.5, 0.0};
  const AnalyticMotion motion(earth, eulerAttitude(constant(0.02), constant(-0.03), yaw), constant(0.7), constant(0.1),
                              constant(0.0));
  const Strapdown strapdown(earth);
  const double T = 0.01;
  const Vector3 offset_b(0.3, -0.2, 0.0);
  NavigationState state = motion.state(0.0);
  state.imu_offset_b = offset_b;
  NavigationState unaware = motion.state(0.0);
  double largest_mps = 0.0;
  double unaware_mps = 0.0;
  ImuInterval before;
  const auto rate_b = [&motion](double t_s) { return motion.imu(t_s - 1e-6, t_s + 1e-6).omega_ib_b; };
  before.omega_ib_b = rate_b(0.0);
  before.duration_s = T;
  for (int i = 0; i < 1500; ++i) {
    ImuInterval imu = motion.imu(T * i, T * (i + 1));
    imu.f_ib_b += (rate_b(T * (i + 1)) - rate_b(T * i)).cross(offset_b) / T +
                  imu.omega_ib_b.cross(imu.omega_ib_b.cross(offset_b));
    state = strapdown.propagate(state, before, imu, 0);
    unaware = strapdown.propagate(unaware, before, imu, 0);
    before = imu;
    largest_mps = std::max(largest_mps, state.v_eb_n.norm());
    unaware_mps = std::max(unaware_mps, unaware.v_eb_n.norm());
  }
  EXPECT_LT(largest_mps, 0.005);
  EXPECT_GT(unaware_mps, 0.3);
  EXPECT_EQ(state.imu_offset_b, offset_b);
}

TEST(Strapdown, FiniteMeansEveryNumberIsFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const NavigationState good;
  EXPECT_TRUE(isFinite(good));
  const auto with = [&good](auto&& change) {
    NavigationState bad = good;
    change(bad);
    return bad;
  };
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.q_b_to_n.x() = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.v_eb_n.z() = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.position.latitude_rad = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.position.longitude_rad = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.position.height_m = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.accel_bias_b.x() = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.gyro_bias_b.y() = nan; })));
  EXPECT_FALSE(isFinite(with([nan](NavigationState& s) { s.imu_offset_b.x() = nan; })));
}

}  // namespace
}  // namespace slipnav::test
