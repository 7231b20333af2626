#include "slipnav/filter/noise_adaptation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slipnav/math/square.h"

namespace slipnav {
namespace {

/// A random walk over two adjoining intervals T changes the mean from one to the next by the variance ⅔ N² T.
constexpr double kMeanToMean = 2.0 / 3.0;
constexpr double kDominant = 0.5;
/// Ground may change at any time: of the quietest road no less is assumed.
constexpr double kLeastFastSlip = 0.002;
constexpr double kLeastSlowSlip = 0.004;

/// Only an innovation that persistent slip dominates, as when the rover stops, says something about it.
double shareOfPersistentSlip(const Innovation1& innovation) {
  return innovation.by_persistent_slip > kDominant * innovation.variance ? innovation.by_persistent_slip : 0.0;
}

}  // namespace

NoiseAdaptation::NoiseAdaptation(const NoiseScaleParams& params, const ImuNoiseParams& imu, double slope_slip)
    : params_(params), floor_(imuFloor(imu)), slope_slip_(slope_slip), scales_(params) {}

void NoiseAdaptation::reset() {
  scales_ = NoiseScales(params_);
  meter_.reset();
  forward_ = Since{};
  constraints_ = Since{};
  way_m_ = 0.0;
}

NoiseFactors NoiseAdaptation::factors() const {
  NoiseFactors f;
  f.wheel = scales_.factor(kWheelNoise);
  f.fast_slip = scales_.factor(kFastSlipNoise);
  f.slow_slip = scales_.factor(kSlowSlipNoise);
  f.lateral = scales_.factor(kLateralNoise);
  f.side_slip = f.fast_slip * scales_.factor(kSideSlipNoise);
  f.vertical = scales_.factor(kVerticalNoise);
  return f;
}

double NoiseAdaptation::gyroDensity() const { return std::max(floor_.gyro_density, meter_.density().gyro.mean()); }

void NoiseAdaptation::add(const ErrorTransition& transition, const Vector3& vibration_b, Since& since) {
  since.fast_slip += transition.noise(kFastSlip);
  since.vibration_b += vibration_b;
}

void NoiseAdaptation::addNoise(const ErrorDynamics& dynamics, const InsStep& step, const NavigationState& state,
                               double way_m, ErrorTransition& transition) {
  const double duration_s = toSeconds(step.state.stamp - step.start);
  if (step.gap_s > 0.0) {
    meter_.interrupt();
  } else {
    meter_.add(step.f_ib_b, step.omega_ib_b, duration_s);
  }
  const Matrix3 C_b_to_n = state.q_b_to_n.toRotationMatrix();
  const NoiseFactors factor = factors();
  GroundStep& ground = ground_;
  ground = dynamics.ground();
  ground.way_m = way_m;
  ground.fast_slip_variance = ground.fast_slip_variance * factor.fast_slip + square(kLeastFastSlip);
  ground.slow_slip_variance =
      ground.slow_slip_variance * factor.slow_slip + square(slope_slip_ * C_b_to_n(2, 0)) + square(kLeastSlowSlip);
  ground.side_slip_variance = ground.side_slip_variance * factor.side_slip + square(slope_slip_ * C_b_to_n(2, 1));
  dynamics.rollOver(ground, transition);

  const ImuNoiseDensity shaking = meter_.density();
  const double white = scales_.factor(kVibrationNoise);
  const Vector3 accel = white * duration_s * (shaking.accel.array() - floor_.accel_density).cwiseMax(0.0).matrix();
  const Vector3 gyro = white * duration_s * (shaking.gyro.array() - floor_.gyro_density).cwiseMax(0.0).matrix();
  const Matrix3 squared = C_b_to_n.cwiseAbs2();
  transition.noise.segment<3>(kVelocity) += squared * accel;
  transition.noise.segment<3>(kAttitude) += squared * gyro;
  add(transition, accel, forward_);
  add(transition, accel, constraints_);
  way_m_ += way_m;
}

void NoiseAdaptation::learnForward(const WheelOdometryParams& params, const WheelInterval& wheels,
                                   const Innovation1& innovation) {
  const NoiseFactors factor = factors();
  const double slipping2 = square(wheels.slipping_speed_mps);
  NoiseVector shares = NoiseVector::Zero();
  shares(kWheelNoise) = wheelNoiseVariance(params, wheels.duration_s, factor);
  shares(kFastSlipNoise) = slipping2 * forward_.fast_slip + newSlipVariance(params, wheels, factor);
  shares(kSlowSlipNoise) = shareOfPersistentSlip(innovation);
  shares(kVibrationNoise) = kMeanToMean * forward_.vibration_b.x();
  scales_.learn(shares, innovation.squared, innovation.variance);
  scales_.fade(std::exchange(way_m_, 0.0));
  forward_ = Since{};
}

void NoiseAdaptation::learnLateral(double own_variance, const Innovation1& innovation) {
  NoiseVector shares = NoiseVector::Zero();
  shares(kLateralNoise) = own_variance;
  shares(kSideSlipNoise) = shareOfPersistentSlip(innovation);
  shares(kVibrationNoise) = kMeanToMean * constraints_.vibration_b.y();
  scales_.learn(shares, innovation.squared, innovation.variance);
}

void NoiseAdaptation::learnVertical(double own_variance, const Innovation1& innovation) {
  NoiseVector shares = NoiseVector::Zero();
  shares(kVerticalNoise) = own_variance;
  shares(kVibrationNoise) = kMeanToMean * constraints_.vibration_b.z();
  scales_.learn(shares, innovation.squared, innovation.variance);
}

void NoiseAdaptation::constraintsUsed() { constraints_ = Since{}; }

double explainedBy(int state, const Measurement::Jacobian& H, const ErrorCovariance& P) {
  const double covariance = (H * P.col(state))(0, 0);
  return P(state, state) > 0.0 ? square(covariance) / P(state, state) : 0.0;
}

}  // namespace slipnav
