/// The error-free IMU and the true motion agree: integrating the one gives the other.
///
/// The integration here is done in inertial axes, where there is no Coriolis term and no transport rate, so that it has
/// no formula in common with the simulator (which averages in axes that turn with the planet).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/driver.h"
#include "simulation/simulator.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav::sim {
namespace {

Geodetic startOf(const SimulatorParams& params) {
  return {degToRad(params.start_latitude_deg), degToRad(params.start_longitude_deg), params.start_height_m};
}

/// Strapdown integration in axes that do not rotate and coincide with the start's east-north-up at time zero.
class InertialIntegrator {
 public:
  InertialIntegrator(const Planet& planet, const Geodetic& start, const Matrix3& C_b_to_enu, const Vector3& lever_b)
      : planet_(planet), frame_(planet, start), attitude_(C_b_to_enu) {
    omega_ie_ = frame_.C_n_to_enu(start) * planet.omega_ie_n(start.latitude_rad);
    // the start seen from the planet's center, in the meridian plane
    const double normal_m = planet.transverseRadius(start.latitude_rad);
    const double f = planet.flattening();
    const double squash = (1.0 - f) * (1.0 - f);
    const double sine = std::sin(start.latitude_rad);
    const double cosine = std::cos(start.latitude_rad);
    const double equatorial_m = (normal_m + start.height_m) * cosine;
    const double polar_m = (squash * normal_m + start.height_m) * sine;
    start_from_center_ = Vector3(0.0, -equatorial_m * sine + polar_m * cosine, equatorial_m * cosine + polar_m * sine);
    position_ = start_from_center_ + C_b_to_enu * lever_b;
    velocity_ = omega_ie_.cross(position_);
  }

  void add(const ImuSample& imu, double dt_s) {
    const Vector3 angle = dt_s * imu.omega_ib_b;
    const Vector3 velocity_b = dt_s * imu.f_ib_b;
    // Savage (1998): rotation of the axes within the interval, sculling and coning from the interval before
    const Vector3 specific = velocity_b + 0.5 * angle.cross(velocity_b) + angle.cross(angle.cross(velocity_b)) / 6.0 +
                             (last_angle_.cross(velocity_b) + last_velocity_b_.cross(angle)) / 12.0;
    const Vector3 turn = angle + last_angle_.cross(angle) / 12.0;
    const Vector3 thrust = attitude_ * specific;
    const Vector3 last_velocity = velocity_;
    const Vector3 ahead = position_ + 0.5 * dt_s * velocity_;
    velocity_ += thrust + dt_s * gravitation(ahead, time_s_ + 0.5 * dt_s);
    position_ += 0.5 * dt_s * (last_velocity + velocity_);
    attitude_ = attitude_ * quaternionFromRotationVector(turn).toRotationMatrix();
    last_angle_ = angle;
    last_velocity_b_ = velocity_b;
    time_s_ += dt_s;
  }

  Vector3 positionEnu() const { return toPlanet(time_s_) * position_ - start_from_center_; }
  Matrix3 C_b_to_enu() const { return toPlanet(time_s_) * attitude_; }

 private:
  Matrix3 toPlanet(double time_s) const { return quaternionFromRotationVector(-time_s * omega_ie_).toRotationMatrix(); }

  /// Gravity without the centrifugal part.
  Vector3 gravitation(const Vector3& position, double time_s) const {
    const Matrix3 C_i_to_enu = toPlanet(time_s);
    const Vector3 from_center = C_i_to_enu * position;
    const Geodetic place = frame_.toGeodetic(from_center - start_from_center_);
    const Vector3 gravity = frame_.C_n_to_enu(place) * planet_.gravity_n(place);
    return C_i_to_enu.transpose() * (gravity + omega_ie_.cross(omega_ie_.cross(from_center)));
  }

  Planet planet_;
  LocalFrame frame_;
  Matrix3 attitude_;
  Vector3 omega_ie_, start_from_center_, position_, velocity_;
  Vector3 last_angle_ = Vector3::Zero();
  Vector3 last_velocity_b_ = Vector3::Zero();
  double time_s_ = 0.0;
};

struct Mismatch {
  double position_m = 0.0;
  double attitude_rad = 0.0;
  double duration_s = 0.0;
};

Matrix3 trueAttitude(const LocalFrame& frame, const TruthState& truth) {
  return frame.C_n_to_enu(truth.position) * truth.q_b_to_n.toRotationMatrix();
}

/// Largest difference over a whole drive between the truth and its own IMU, integrated.
Mismatch largestMismatch(const SimulatorParams& params, const std::string& planet_name) {
  const Planet planet = Planet::byName(planet_name);
  RoverSimulator rover(params, planet);
  Driver driver(params);
  const LocalFrame frame(planet, startOf(params));
  const Vector3 lever_b(params.imu.lever_arm_x_m, params.imu.lever_arm_y_m, params.imu.lever_arm_z_m);
  InertialIntegrator integrator(planet, startOf(params), trueAttitude(frame, rover.truth()), lever_b);
  Mismatch largest;
  Nanoseconds last = rover.truth().stamp;
  while (!driver.finished()) {
    const ImuSample imu = rover.step(driver.command(rover.truth())).imu;
    integrator.add(imu, toSeconds(imu.stamp - last));
    last = imu.stamp;
    const Matrix3 C_b_to_enu = trueAttitude(frame, rover.truth());
    const Vector3 sensor = rover.truth().position_enu_m + C_b_to_enu * lever_b;
    largest.position_m = std::max(largest.position_m, (integrator.positionEnu() - sensor).norm());
    const Quaternion turn(Matrix3(integrator.C_b_to_enu().transpose() * C_b_to_enu));
    largest.attitude_rad = std::max(largest.attitude_rad, rotationVectorFromQuaternion(turn).norm());
  }
  largest.duration_s = toSeconds(last) - params.start_time_s;
  return largest;
}

SimulatorParams errorFree(const std::string& terrain, double distance_m) {
  SimulatorParams params;
  params.terrain = terrain;
  params.imu.error_free = true;
  params.drive.distance_m = distance_m;
  return params;
}

TEST(SimInertialTruth, IntegratesToTheTrueMotionOverFifteenMinutesOfRocking) {
  const Mismatch mismatch = largestMismatch(errorFree("rocking", 680.0), "earth");
  EXPECT_GT(mismatch.duration_s, 895.0);
  EXPECT_LT(mismatch.position_m, 0.1);
  EXPECT_LT(mismatch.attitude_rad, 2e-7);
}

TEST(SimInertialTruth, IntegratesToTheTrueMotionOnRoughGround) {
  const Mismatch mismatch = largestMismatch(errorFree("rough", 150.0), "earth");
  EXPECT_LT(mismatch.position_m, 0.02);
  EXPECT_LT(mismatch.attitude_rad, 3e-6);
}

TEST(SimInertialTruth, HoldsForASensorAwayFromTheCenter) {
  SimulatorParams params = errorFree("rough", 100.0);
  params.imu.lever_arm_x_m = 0.4;
  params.imu.lever_arm_y_m = -0.3;
  params.imu.lever_arm_z_m = -0.5;
  EXPECT_LT(largestMismatch(params, "earth").position_m, 0.05);
}

TEST(SimInertialTruth, HoldsOnMarsAndOnTheMoon) {
  EXPECT_LT(largestMismatch(errorFree("rough", 100.0), "mars").position_m, 0.02);
  EXPECT_LT(largestMismatch(errorFree("rough", 100.0), "moon").position_m, 0.02);
}

TEST(SimInertialTruth, HoldsWithJitteredSamplingInstants) {
  SimulatorParams params = errorFree("rough", 60.0);
  params.imu.stamp_jitter_s = 0.003;
  EXPECT_LT(largestMismatch(params, "earth").position_m, 0.02);
}

TEST(SimInertialTruth, VibrationIsMotionAndPartOfTheTruth) {
  SimulatorParams params;
  params.drive.distance_m = 60.0;
  params.imu.gyro_noise_deg_per_sqrt_h = params.imu.accel_noise_mps_per_sqrt_h = 0.0;
  params.imu.gyro_turn_on_bias_deg_per_h = params.imu.accel_turn_on_bias_mg = 0.0;
  params.imu.gyro_in_run_bias_deg_per_h = params.imu.accel_in_run_bias_ug = 0.0;
  params.imu.scale_factor_ppm = 0.0;
  const Mismatch mismatch = largestMismatch(params, "earth");
  EXPECT_LT(mismatch.position_m, 0.15);    // the last interval's vibration is in velocity, but not in position
  EXPECT_LT(mismatch.attitude_rad, 5e-6);  // its standard deviation is 1.4e-4 rad
}

TEST(SimInertialTruth, AtRestIsGravityAndPlanetRotationOnly) {
  SimulatorParams params = errorFree("rough", 10.0);
  params.imu.lever_arm_x_m = 0.5;
  const Planet planet = Planet::byName("earth");
  RoverSimulator rover(params, planet);
  const TruthState start = rover.truth();
  const Matrix3 C_n_to_b = start.q_b_to_n.toRotationMatrix().transpose();
  for (int i = 0; i < 100; ++i) {
    const ImuSample imu = rover.step({}).imu;
    EXPECT_LT((imu.f_ib_b + C_n_to_b * planet.gravity_n(start.position)).norm(), 1e-6);
    EXPECT_LT((imu.omega_ib_b - C_n_to_b * planet.omega_ie_n(start.position.latitude_rad)).norm(), 1e-12);
  }
}

TEST(SimInertialTruth, MisalignedSensorMeasuresInItsOwnAxes) {
  SimulatorParams params = errorFree("rough", 10.0);
  RoverSimulator aligned(params, Planet::byName("earth"));
  params.imu.misalignment_roll_deg = 1.0;
  params.imu.misalignment_yaw_deg = -2.0;
  RoverSimulator misaligned(params, Planet::byName("earth"));
  const Matrix3 C_b_to_s = q_b_to_n_fromEuler(degToRad(1.0), 0.0, degToRad(-2.0)).toRotationMatrix().transpose();
  for (int i = 0; i < 200; ++i) {
    const ImuSample straight = aligned.step({0.8, 0.1}).imu;
    const ImuSample turned = misaligned.step({0.8, 0.1}).imu;
    EXPECT_LT((turned.f_ib_b - C_b_to_s * straight.f_ib_b).norm(), 1e-12);
    EXPECT_LT((turned.omega_ib_b - C_b_to_s * straight.omega_ib_b).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace slipnav::sim
