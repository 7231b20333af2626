#include "core/forecast/covariance_forecast.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// A share of zero would be an infinite variance.
constexpr double kLeastShare = 1e-6;

/// No step adds this much to a variance, unless the filter has inflated it.
constexpr double kOpened = 1.5;

/// Variance of the velocity in direction `along_n`.
double varianceAlong(const Vector3& along_n, const ErrorCovariance& P) {
  return along_n.dot(P.block<3, 3>(kVelocity, kVelocity) * along_n);
}

double horizontalStd(const ErrorCovariance& P) {
  return std::sqrt(std::max(P(kPosition, kPosition) + P(kPosition + 1, kPosition + 1), 0.0));  // NaN stays NaN
}

/// P after a measurement with a gain that is not P's own.
void updateWith(const KalmanGain& K, const Measurement::Jacobian& H, const Measurement::Vector& variance,
                ErrorCovariance& P) {
  const KalmanGain PHt = covarianceWithPrediction(H, P);
  InnovationCovariance S = H.lazyProduct(PHt);
  S.diagonal() += variance;
  addJosephTerms(K, PHt, S, P);
}

}  // namespace

CovarianceForecast::CovarianceForecast(const Planet& planet, const FilterSetup& setup, double step_s,
                                       double wheel_interval_s)
    : planet_(planet),
      setup_(setup),
      dynamics_(planet, setup.imu, setup.vehicle),
      step_s_(step_s),
      samples_per_step_(std::max(1.0, step_s / wheel_interval_s)) {
  if (!(step_s > 0.0) || !(wheel_interval_s > 0.0)) {
    throw std::invalid_argument("covariance forecast: step and wheel interval must be above zero");
  }
}

GroundOutlook CovarianceForecast::assumption(const NoiseFactors& factors) const {
  GroundOutlook outlook;
  outlook.drift_std = setup_.vehicle.slow_slip_std * std::sqrt(factors.slow_slip);
  outlook.change_std = setup_.vehicle.fast_slip_std * std::sqrt(factors.fast_slip);
  outlook.wheel_noise_variance = square(setup_.wheel.speed_std_mps) * factors.wheel;
  outlook.side_slip_std_rad = degToRad(setup_.vehicle.side_slip_std_deg) * std::sqrt(factors.side_slip);
  return outlook;
}

void CovarianceForecast::restart(const ErrorCovariance& P, bool growth) {
  claim_ = P;
  reality_ = P;
  if (growth) {
    reality_.middleRows<3>(kPosition).setZero();
    reality_.middleCols<3>(kPosition).setZero();
  }
}

ErrorTransition CovarianceForecast::transition(const DriveStep& step) const {
  const Vector3 f_ib_n = step.acceleration_n - planet_.gravity_n(step.state.position);
  ErrorTransition t = dynamics_.transition(step.state, step.state, step.state.q_b_to_n.conjugate() * f_ib_n,
                                           Vector3::Zero(), Vector3::Zero(), step_s_);
  GroundStep ground = dynamics_.ground();
  ground.way_m = std::abs(step.wheel_speed_mps) * step_s_;
  ground.slow_slip_variance *= step.noise_factors.slow_slip;
  ground.fast_slip_variance *= step.noise_factors.fast_slip;
  ground.side_slip_variance *= step.noise_factors.side_slip;
  dynamics_.rollOver(ground, t);
  return t;
}

ErrorTransition CovarianceForecast::onGround(ErrorTransition transition, const DriveStep& step,
                                             const GroundOutlook& outlook) const {
  GroundStep ground;
  ground.way_m = std::abs(step.wheel_speed_mps) * step_s_;
  ground.slow_slip_variance = square(outlook.drift_std);
  ground.fast_slip_variance = square(outlook.change_std);
  ground.side_slip_variance = square(std::tan(outlook.side_slip_std_rad));
  dynamics_.rollOver(ground, transition);
  if (outlook.change_time_s) {
    const double decay = std::exp(-step_s_ / *outlook.change_time_s);
    transition.decay(kFastSlip - 9) = decay;
    transition.noise(kFastSlip) = 2.0 * ground.fast_slip_variance * (1.0 - decay * decay) / (1.0 + decay * decay);
  }
  return transition;
}

CovarianceForecast::Odometry CovarianceForecast::odometry(const DriveStep& step, const GroundOutlook& outlook) const {
  const VelocityJacobian H_v = bodyVelocityJacobian(step.state, setup_.lever_imu_to_reference_b);
  BodyMotion motion;
  motion.v_eb_b = Vector3(step.speed_mps, 0.0, 0.0);
  const NoiseFactors& factors = step.noise_factors;
  const WheelInterval interval{step.wheel_speed_mps, step.wheel_speed_mps, step_s_ / samples_per_step_};
  const Measurement forward = forwardSpeedMeasurement(setup_.wheel, interval, motion, H_v, {}, 0.0, factors);
  const Measurement lateral = lateralMeasurement(setup_.nonholonomic, motion, H_v, {}, factors.lateral);
  const Measurement vertical = verticalMeasurement(setup_.nonholonomic, motion, H_v, {}, factors.vertical);
  const double wheel_samples = std::max(step.wheel_share, kLeastShare) * samples_per_step_;
  const double information = constraintInformation(setup_.nonholonomic, std::abs(step.speed_mps) * step_s_);
  Odometry odometry;
  odometry.H.resize(3, kErrorStates);
  odometry.H << forward.H, lateral.H, vertical.H;
  odometry.claimed = Vector3(forward.variance(0) / wheel_samples, lateral.variance(0) / information,
                             vertical.variance(0) / information);
  odometry.real = odometry.claimed;
  odometry.real(0) = outlook.wheel_noise_variance / wheel_samples;
  return odometry;
}

void CovarianceForecast::advance(const DriveStep& step, const GroundOutlook& outlook, ErrorCovariance& claim,
                                 ErrorCovariance& reality) const {
  const ErrorTransition by_filter = transition(step);
  ErrorDynamics::propagate(by_filter, claim);
  ErrorDynamics::propagate(onGround(by_filter, step, outlook), reality);
  const Odometry wheels = odometry(step, outlook);
  Measurement measurement(3);
  measurement.H = wheels.H;
  measurement.variance = wheels.claimed;
  if (const std::optional<UpdateGain> used = updateCovariance(measurement, claim)) {
    updateWith(used->K, wheels.H, wheels.real, reality);
  }
}

void CovarianceForecast::follow(const DriveStep& step, const ErrorCovariance& P, const GroundOutlook& outlook) {
  advance(step, outlook, claim_, reality_);
  openAsTheFilter(step.state, P);
  claim_ = P;
}

void CovarianceForecast::openAsTheFilter(const NavigationState& state, const ErrorCovariance& P) {
  for (const int slip : {kSlowSlip, kFastSlip}) {
    if (P(slip, slip) > kOpened * claim_(slip, slip)) {
      reality_(slip, slip) += P(slip, slip) - claim_(slip, slip);
    }
  }
  const Vector3 ahead_n = state.q_b_to_n * Vector3::UnitX();
  const double expected = varianceAlong(ahead_n, claim_);
  const double found = varianceAlong(ahead_n, P);
  if (found > kOpened * expected) {
    reality_.block<3, 3>(kVelocity, kVelocity) += (found - expected) * ahead_n * ahead_n.transpose();
  }
}

double CovarianceForecast::forwardVariance(const NavigationState& state) const {
  return varianceAlong(state.q_b_to_n * Vector3::UnitX(), claim_);
}

std::vector<double> CovarianceForecast::ahead(const std::vector<DriveStep>& steps, const GroundOutlook& outlook) const {
  ErrorCovariance claim = claim_;
  ErrorCovariance reality = reality_;
  std::vector<double> std_m;
  std_m.reserve(steps.size());
  for (const DriveStep& step : steps) {
    advance(step, outlook, claim, reality);
    std_m.push_back(horizontalStd(reality));
  }
  return std_m;
}

}  // namespace slipnav
