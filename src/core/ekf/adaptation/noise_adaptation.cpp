#include "slipnav/core/ekf/adaptation/noise_adaptation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.h"
#include "core/ekf/possible_slip.h"

namespace slipnav {
namespace {

/// A random walk over two adjoining intervals T changes the mean from one to the next by the variance ⅔ N² T.
constexpr double kMeanToMean = 2.0 / 3.0;
constexpr double kDominant = 0.5;
/// Ground may change at any time: even the smoothest road is assumed to have this much.
constexpr double kLeastSlowSlip = 0.004;
/// IMU vibration acts as white noise below this time and as a bias beyond: after this long a walk of the bias has moved
/// the velocity as much as the noise has.
constexpr double kWhiteFor_s = 20.0;
/// This fraction of the data-sheet bias is not constant in motion, and new about every second; as much is another one
/// in motion than at rest.
constexpr double kUnsteadyBias = 0.1;
constexpr double kUnsteadyFor_s = 1.0;

/// Fast slip and the sway and heave of the body are never less than configured: a stretch of smooth ground says nothing
/// about the next, and the filter would become overconfident in its attitude through its model of the body.
double atLeastConfigured(double factor) { return std::max(1.0, factor); }

/// Only an innovation dominated by persistent slip, as when the rover stops, says anything about it.
double shareOfPersistentSlip(const Innovation1& innovation) {
  return innovation.by_persistent_slip > kDominant * innovation.variance ? innovation.by_persistent_slip : 0.0;
}

}  // namespace

NoiseAdaptation::NoiseAdaptation(const NoiseScaleParams& params, const ImuNoiseParams& imu, double slope_slip)
    : params_(params), floor_(imuFloor(imu)), slope_slip_(slope_slip), scales_(params), doubt_(params.imu_factor_std) {}

void NoiseAdaptation::reset() {
  scales_ = NoiseScales(params_);
  meter_.reset();
  doubt_ = ImuDoubt(params_.imu_factor_std);
  sideways_ = off_ground_ = SuccessiveDifference();
  forward_ = Since{};
  constraints_ = Since{};
  way_m_ = 0.0;
}

NoiseFactors NoiseAdaptation::factors() const {
  NoiseFactors f;
  f.wheel = scales_.factor(kWheelNoise);
  f.fast_slip = atLeastConfigured(scales_.factor(kFastSlipNoise));
  f.slow_slip = scales_.factor(kSlowSlipNoise);
  f.lateral = atLeastConfigured(scales_.factor(kLateralNoise));
  f.side_slip = f.fast_slip * scales_.factor(kSideSlipNoise);
  f.vertical = atLeastConfigured(scales_.factor(kVerticalNoise));
  return f;
}

double NoiseAdaptation::biasShiftVariance() const { return square(kUnsteadyBias * floor_.accel_bias_std); }

double NoiseAdaptation::gyroDensity() const { return std::max(floor_.gyro_density, meter_.density().gyro.mean()); }

void NoiseAdaptation::add(const ErrorTransition& transition, const Vector3& vibration_b, Since& since) {
  since.fast_slip += transition.noise(kFastSlip);
  since.vibration_b += vibration_b;
}

void NoiseAdaptation::addNoise(const ErrorDynamics& dynamics, const InsStep& step, const NavigationState& state,
                               double slow_slip, double way_m, ErrorTransition& transition) {
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
  ground.fast_slip_variance *= factor.fast_slip;
  ground.slow_slip_variance =
      ground.slow_slip_variance * factor.slow_slip + square(slope_slip_ * C_b_to_n(2, 0)) + square(kLeastSlowSlip);
  // Ground on which the wheels lose a third of their travel is not ground with a few percent of slip.
  ground.slow_slip_variance = std::max(ground.slow_slip_variance, square(std::max(slow_slip, kMostNegativeSlip)));
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
  if (way_m > 0.0 && step.gap_s <= 0.0) {  // motion in a gap is accounted for at its end
    addDoubt(shaking, squared, duration_s, transition);
  }
  way_m_ += way_m;
}

/// IMU noise in motion beyond what its data sheet and its samples show.
/// @param squared C_b_to_n with its elements squared
void NoiseAdaptation::addDoubt(const ImuNoiseDensity& shaking, const Matrix3& squared, double duration_s,
                               ErrorTransition& transition) const {
  if (params_.imu_factor_std <= 1.0) {
    return;
  }
  const double excess = doubt_.excess();
  const Vector3 gyro = excess * shaking.gyro.cwiseMax(floor_.gyro_density);
  Vector3 accel = excess * shaking.accel.cwiseMax(floor_.accel_density);
  transition.noise.segment<3>(kAccelBias) += 3.0 * duration_s / square(kWhiteFor_s) * accel;
  accel.array() += square(kUnsteadyBias * floor_.accel_bias_std) * kUnsteadyFor_s;
  transition.noise.segment<3>(kVelocity) += duration_s * squared * accel;
  transition.noise.segment<3>(kAttitude) += duration_s * squared * gyro;
}

void NoiseAdaptation::learnForward(const WheelOdometryParams& params, const WheelInterval& wheels,
                                   const Innovation1& innovation) {
  const NoiseFactors factor = factors();
  const double fast = square(wheels.slipping_speed_mps) * forward_.fast_slip + newSlipVariance(params, wheels, factor);
  NoiseVector shares = NoiseVector::Zero();
  shares(kWheelNoise) = wheelNoiseVariance(params, wheels.duration_s, factor);
  shares(kFastSlipNoise) = fast * scales_.factor(kFastSlipNoise) / factor.fast_slip;
  shares(kSlowSlipNoise) = shareOfPersistentSlip(innovation);
  shares(kVibrationNoise) = kMeanToMean * forward_.vibration_b.x();
  scales_.learn(shares, square(innovation.residual), innovation.variance - (fast - shares(kFastSlipNoise)));
  scales_.fade(std::exchange(way_m_, 0.0));
  forward_ = Since{};
}

void NoiseAdaptation::learnLateral(double own_variance, const Innovation1& innovation, const Vector3& aside_n) {
  doubt_.compare(kSideways, innovation.residual / std::sqrt(innovation.variance), aside_n);
  NoiseVector shares = NoiseVector::Zero();
  shares(kSideSlipNoise) = shareOfPersistentSlip(innovation);
  shares(kVibrationNoise) = kMeanToMean * constraints_.vibration_b.y();
  learnConstraint(kLateralNoise, own_variance, innovation, sideways_.squared(innovation.residual, aside_n), shares);
}

void NoiseAdaptation::learnVertical(double own_variance, const Innovation1& innovation) {
  doubt_.compare(kOffGround, innovation.residual / std::sqrt(innovation.variance), Vector3::UnitZ());
  NoiseVector shares = NoiseVector::Zero();
  shares(kVibrationNoise) = kMeanToMean * constraints_.vibration_b.z();
  learnConstraint(kVerticalNoise, own_variance, innovation, off_ground_.squared(innovation.residual, Vector3::UnitZ()),
                  shares);
}

/// @param squared difference to the previous innovation, negative if there is none
void NoiseAdaptation::learnConstraint(NoiseKind kind, double own_variance, const Innovation1& innovation,
                                      double squared, NoiseVector shares) {
  if (squared < 0.0) {
    return;
  }
  const double learned = scales_.factor(kind);
  shares(kind) = own_variance * learned / atLeastConfigured(learned);
  scales_.learn(shares, squared, innovation.variance - (own_variance - shares(kind)));
}

void NoiseAdaptation::constraintsUsed() { constraints_ = Since{}; }

double explainedBy(int state, const Measurement::Jacobian& H, const ErrorCovariance& P) {
  const double covariance = (H * P.col(state))(0, 0);
  return P(state, state) > 0.0 ? square(covariance) / P(state, state) : 0.0;
}

}  // namespace slipnav
