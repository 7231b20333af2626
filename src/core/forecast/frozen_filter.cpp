#include "core/forecast/frozen_filter.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

constexpr int kOdometryRows = 4;

ErrorTransition imuStep(const ErrorDynamics& dynamics, const Estimate& estimate, double imu_step_s) {
  ErrorTransition t = dynamics.transition(estimate.nav, estimate.nav, estimate.f_ib_b, estimate.omega_ib_b,
                                          Vector3::Zero(), imu_step_s);
  GroundStep ground = dynamics.ground();
  ground.way_m = std::abs(estimate.wheels.motion.forward_mps) * imu_step_s;
  ground.slow_slip_variance *= estimate.noise_factors.slow_slip;
  ground.fast_slip_variance *= estimate.noise_factors.fast_slip;
  ground.side_slip_variance *= estimate.noise_factors.side_slip;
  dynamics.rollOver(ground, t);
  return t;
}

}  // namespace

FrozenFilter freeze(const ErrorDynamics& dynamics, const FilterSetup& setup, const Estimate& estimate,
                    double imu_step_s) {
  const VelocityJacobian H_v = bodyVelocityJacobian(estimate.nav, setup.lever_imu_to_reference_b);
  const double u = estimate.wheels.motion.forward_mps;
  const WheelInterval interval{u, u, kImuStepsPerUpdate * imu_step_s};
  const BodyMotion& motion = estimate.motion;
  FrozenFilter frozen;
  frozen.transition = imuStep(dynamics, estimate, imu_step_s);
  frozen.H.resize(kOdometryRows, kErrorStates);
  frozen.H << forwardSpeedMeasurement(setup.wheel, interval, motion, H_v, estimate.vehicle, 0.0, {}).H,
      yawRateMeasurement(setup.wheel, motion.omega_ib_b.z(), 0.0, motion).H,
      lateralMeasurement(setup.nonholonomic, motion, H_v, estimate.vehicle, 1.0).H,
      verticalMeasurement(setup.nonholonomic, motion, H_v, estimate.vehicle, 1.0).H;
  return frozen;
}

Measurement::Vector paperVariance(double wheel_speed_variance) {
  Measurement::Vector variance(kOdometryRows);
  variance << wheel_speed_variance, wheel_speed_variance, wheel_speed_variance, 1.0;
  return variance;
}

std::vector<double> horizontalStdAhead(const FrozenFilter& frozen, ErrorCovariance P,
                                       const std::vector<Measurement::Vector>& variances) {
  Measurement odometry(kOdometryRows);
  odometry.H = frozen.H;
  std::vector<double> std_m;
  std_m.reserve(variances.size());
  for (const Measurement::Vector& variance : variances) {
    for (int step = 0; step < kImuStepsPerUpdate; ++step) {
      ErrorDynamics::propagate(frozen.transition, P);
    }
    odometry.variance = variance;
    updateCovariance(odometry, P);
    std_m.push_back(std::sqrt(std::max(P.diagonal().segment<2>(kPosition).sum(), 0.0)));  // NaN stays NaN
  }
  return std_m;
}

}  // namespace slipnav
