/// Every measurement model: residual zero at the truth, and H against numerical derivatives through subtractError().

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "random_states.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/models/nonholonomic.h"
#include "slipnav/core/ekf/models/wheel_odometry.h"
#include "slipnav/core/ekf/models/zero_motion.h"
#include "wheel_speed.h"

namespace slipnav::test {
namespace {

/// What a model is linearized about, and what the IMU said.
struct Point {
  NavigationState nav;
  VehicleState vehicle;
  Vector3 measured_rate_b = Vector3::Zero();
  Vector3 measured_force_b = Vector3::Zero();
  Vector3 lever_b = Vector3::Zero();
};

const Planet& earth() {
  static const Planet planet = Planet::byName("earth");
  return planet;
}

Point randomPoint(sim::RandomStream& random) {
  return {randomState(random, 1.0), randomVehicle(random), 0.3 * random.normal3(),
          Vector3(0.0, 0.0, -9.8) + random.normal3(), random.normal3()};
}

BodyMotion motionOf(const Point& p) {
  const Vector3 omega_ib_b = p.measured_rate_b - p.nav.gyro_bias_b;
  const Vector3 omega_ie_b = p.nav.q_b_to_n.conjugate() * earth().omega_ie_n(p.nav.position.latitude_rad);
  return {0.1, bodyVelocity(p.nav, omega_ib_b - omega_ie_b, p.lever_b), omega_ib_b};
}

VelocityJacobian velocityJacobian(const Point& p) { return bodyVelocityJacobian(p.nav, p.lever_b); }

using Model = std::function<Measurement(const Point&)>;

/// Central differences of the residual: ∂(measured − predicted)/∂(error) = −H.
Eigen::MatrixXd numericJacobian(const Model& model, const Point& point) {
  const Measurement measurement = model(point);
  const int rows = static_cast<int>(measurement.residual.size());
  EXPECT_EQ(measurement.H.rows(), rows);
  EXPECT_EQ(measurement.variance.size(), rows);
  Eigen::MatrixXd H(rows, static_cast<int>(kErrorStates));
  for (int k = 0; k < kErrorStates; ++k) {
    const double size = k >= kPosition && k < kPosition + 3 ? 1.0 : 1e-4;
    const auto residualAt = [&](double error) -> Eigen::VectorXd {
      Point p = point;
      subtractError(earth(), unitError(k, -error), p.nav);
      subtractError(unitError(k, -error), p.vehicle);
      return model(p).residual;
    };
    H.col(k) = -(residualAt(size) - residualAt(-size)) / (2.0 * size);
  }
  return H;
}

/// @param seen error states that the model has to depend on: their columns are not zero
void expectJacobian(const std::string& name, const Model& model, const std::vector<int>& seen) {
  sim::RandomStream random(1, name);
  for (int i = 0; i < 20; ++i) {
    const Point point = randomPoint(random);
    const Eigen::MatrixXd numeric = numericJacobian(model, point);
    const Eigen::MatrixXd H = model(point).H;
    // the planet's rotation in the lever-arm velocity, ω_ie l ≈ 1e-4 m/s per radian, is neglected in H
    EXPECT_LT((H - numeric).cwiseAbs().maxCoeff(), 1e-3) << name << "\n" << H << "\nnumerically\n" << numeric;
    for (const int index : seen) {
      EXPECT_GT(numeric.col(index).cwiseAbs().maxCoeff(), 0.01) << name << ", state " << index;
    }
  }
}

TEST(MeasurementJacobian, ForwardSpeed) {
  const Model model = [](const Point& p) {
    return steadyWheelSpeed({}, 0.9, motionOf(p), p.nav, p.vehicle, p.lever_b);
  };
  expectJacobian("forward speed", model, {kWheelScale, kSlowSlip, kFastSlip});
  sim::RandomStream random(2, "columns");
  const Eigen::MatrixXd H = model(randomPoint(random)).H;
  EXPECT_GT(H.middleCols<3>(kAttitude).norm(), 0.1);
  EXPECT_GT(H.middleCols<3>(kVelocity).norm(), 0.5);
  EXPECT_GT(H.middleCols<3>(kGyroBias).norm(), 0.1);
}

TEST(MeasurementJacobian, YawRate) {
  const Model model = [](const Point& p) { return yawRateMeasurement({}, 0.2, 0.1, motionOf(p)); };
  expectJacobian("yaw rate", model, {kGyroBias + 2});
}

TEST(MeasurementJacobian, Lateral) {
  const Model model = [](const Point& p) {
    return lateralMeasurement({}, motionOf(p), velocityJacobian(p), p.vehicle, 1.0);
  };
  expectJacobian("lateral", model, {});
  sim::RandomStream random(2, "columns");
  const Point point = randomPoint(random);
  const double v_x = motionOf(point).v_eb_b.x();
  EXPECT_DOUBLE_EQ(model(point).H(0, kMountYaw), v_x);
  EXPECT_DOUBLE_EQ(model(point).H(0, kSideSlip), -v_x);
}

TEST(MeasurementJacobian, Vertical) {
  const Model model = [](const Point& p) {
    return verticalMeasurement({}, motionOf(p), velocityJacobian(p), p.vehicle, 1.0);
  };
  expectJacobian("vertical", model, {});
  sim::RandomStream random(2, "columns");
  const Point point = randomPoint(random);
  EXPECT_DOUBLE_EQ(model(point).H(0, kMountPitch), -motionOf(point).v_eb_b.x());
}

TEST(MeasurementJacobian, ConstraintThatDoesNotSeeTheAttitudeHasNoColumnsOfIt) {
  VelocityJacobian H_v;
  for (int column = 0; column < kErrorStates; ++column) {
    H_v.col(column).setConstant(1.0 + column);
  }
  NonholonomicParams params;
  EXPECT_EQ(constraintJacobian(params, H_v), H_v);
  params.see_attitude = false;
  const VelocityJacobian H = constraintJacobian(params, H_v);
  EXPECT_TRUE(H.middleCols<3>(kAttitude).isZero(0.0));
  EXPECT_EQ(H.rightCols<kErrorStates - 3>(), H_v.rightCols<kErrorStates - 3>());
}

TEST(MeasurementJacobian, ZeroVelocity) {
  const Model model = [](const Point& p) { return zeroVelocityMeasurement(1e-6, p.nav); };
  expectJacobian("zero velocity", model, {kVelocity, kVelocity + 1, kVelocity + 2});
}

TEST(MeasurementJacobian, ZeroAngularRate) {
  const Model model = [](const Point& p) {
    return zeroAngularRateMeasurement({}, 1e-9, motionOf(p), p.nav, earth().omega_ie_n(p.nav.position.latitude_rad));
  };
  expectJacobian("zero rate", model, {kGyroBias, kGyroBias + 1, kGyroBias + 2});
}

/// The planet's rate is small: its part of H is looked at by itself, with a planet that turns a thousand times faster.
TEST(MeasurementJacobian, ZeroAngularRateByAttitude) {
  const Model model = [](const Point& p) {
    return zeroAngularRateMeasurement({}, 1e-9, motionOf(p), p.nav, Vector3(0.05, 0.0, -0.07));
  };
  expectJacobian("zero rate of a fast planet", model, {});
  sim::RandomStream random(2, "columns");
  EXPECT_GT(model(randomPoint(random)).H.middleCols<3>(kAttitude).norm(), 0.05);
}

TEST(MeasurementJacobian, PositionFix) {
  sim::RandomStream random(4, "fix");
  for (int i = 0; i < 10; ++i) {
    const Point point = randomPoint(random);
    PositionFix fix;
    fix.stamp = point.nav.stamp;
    fix.position = point.nav.position;
    const Model at_fix = [&fix](const Point& p) { return positionMeasurement(earth(), fix, p.nav, p.lever_b); };
    const Eigen::MatrixXd numeric = numericJacobian(at_fix, point);
    EXPECT_LT((at_fix(point).H - numeric).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_GT(numeric.middleCols<3>(kAttitude).norm(), 0.1);
    EXPECT_NEAR(numeric.middleCols<3>(kPosition).norm(), std::sqrt(3.0), 1e-3);
  }
}

TEST(MeasurementJacobian, VelocityFix) {
  VelocityFix fix;
  const auto model = [&fix](const Point& p) {
    return velocityMeasurement(earth(), fix, p.nav, p.measured_force_b - p.nav.accel_bias_b,
                               p.measured_rate_b - p.nav.gyro_bias_b, p.lever_b);
  };
  sim::RandomStream random(4, "velocity");
  for (int i = 0; i < 10; ++i) {
    const Point point = randomPoint(random);
    fix.stamp = point.nav.stamp - fromSeconds(0.05);
    const Eigen::MatrixXd numeric = numericJacobian(model, point);
    EXPECT_LT((model(point).H - numeric).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_GT(numeric.middleCols<3>(kAttitude).norm(), 0.1);
    EXPECT_NEAR(numeric.middleCols<3>(kVelocity).norm(), std::sqrt(3.0), 1e-6);
    EXPECT_NEAR(numeric.middleCols<3>(kAccelBias).norm(), 0.05 * std::sqrt(3.0), 1e-6);
    EXPECT_GT(numeric.middleCols<3>(kGyroBias).norm(), 0.1);
  }
}

TEST(MeasurementResidual, IsZeroAtTheTruth) {
  sim::RandomStream random(5, "truth");
  for (int i = 0; i < 20; ++i) {
    Point p = randomPoint(random);
    // a vehicle that slips, crabs and has its IMU crooked, and whose constraints hold exactly
    const double v_x = 0.7;
    const Vector3 v_b(v_x, (p.vehicle.side_slip - p.vehicle.mount_yaw_rad) * v_x, p.vehicle.mount_pitch_rad * v_x);
    const BodyMotion motion{0.1, v_b, p.measured_rate_b - p.nav.gyro_bias_b};
    const double slip = p.vehicle.wheel_scale + p.vehicle.slow_slip + p.vehicle.fast_slip;
    EXPECT_NEAR(steadyWheelSpeed({}, v_x / (1.0 - slip), motion, p.nav, p.vehicle, p.lever_b).residual(0), 0.0, 1e-15);
    EXPECT_NEAR(lateralMeasurement({}, motion, velocityJacobian(p), p.vehicle, 1.0).residual(0), 0.0, 1e-15);
    EXPECT_NEAR(verticalMeasurement({}, motion, velocityJacobian(p), p.vehicle, 1.0).residual(0), 0.0, 1e-15);
    EXPECT_NEAR(yawRateMeasurement({}, motion.omega_ib_b.z(), 0.1, motion).residual(0), 0.0, 1e-15);

    p.nav.v_eb_n.setZero();
    EXPECT_EQ(zeroVelocityMeasurement(1e-6, p.nav).residual.norm(), 0.0);
    const Vector3 omega_ie_n = earth().omega_ie_n(p.nav.position.latitude_rad);
    const BodyMotion rest{0.1, Vector3::Zero(), p.nav.q_b_to_n.conjugate() * omega_ie_n};
    EXPECT_NEAR(zeroAngularRateMeasurement({}, 1e-9, rest, p.nav, omega_ie_n).residual.norm(), 0.0, 1e-18);
  }
}

}  // namespace
}  // namespace slipnav::test
