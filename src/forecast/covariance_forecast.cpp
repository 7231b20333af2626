#include "slipnav/forecast/covariance_forecast.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "slipnav/math/square.h"

namespace slipnav {
namespace {

/// A share of zero would be an infinite variance.
constexpr double kLeastShare = 1e-6;

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

void setGaussMarkov(int state, double std, double time_s, double step_s, ErrorTransition& transition) {
  transition.decay(state - 9) = std::exp(-step_s / time_s);
  transition.noise(state) = square(std) * (1.0 - std::exp(-2.0 * step_s / time_s));
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

GroundOutlook CovarianceForecast::assumption() const {
  GroundOutlook outlook;
  outlook.drift_std = setup_.vehicle.slow_slip_std;
  outlook.change_std = setup_.vehicle.fast_slip_std;
  outlook.change_time_s = setup_.vehicle.fast_slip_time_s;
  outlook.wheel_noise_variance = square(setup_.wheel.speed_std_mps);
  outlook.side_slip_std_rad = degToRad(setup_.vehicle.side_slip_std_deg);
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
  ErrorTransition t =
      dynamics_.transition(step.state, step.state, step.state.q_b_to_n.conjugate() * f_ib_n, Vector3::Zero(), step_s_);
  t.noise(kSlowSlip) *= step.slip_factor;
  t.noise(kFastSlip) *= step.slip_factor;
  t.noise(kSideSlip) *= step.side_slip_factor;
  return t;
}

ErrorTransition CovarianceForecast::onGround(ErrorTransition transition, const GroundOutlook& outlook) const {
  setGaussMarkov(kSlowSlip, outlook.drift_std, setup_.vehicle.slow_slip_time_s, step_s_, transition);
  setGaussMarkov(kFastSlip, outlook.change_std, outlook.change_time_s, step_s_, transition);
  setGaussMarkov(kSideSlip, std::tan(outlook.side_slip_std_rad), setup_.vehicle.side_slip_time_s, step_s_, transition);
  return transition;
}

CovarianceForecast::Odometry CovarianceForecast::odometry(const DriveStep& step, const GroundOutlook& outlook) const {
  const VelocityJacobian H_v = bodyVelocityJacobian(step.state, setup_.lever_imu_to_reference_b);
  BodyMotion motion;
  motion.duration_s = step_s_;
  motion.v_eb_b = Vector3(step.speed_mps, 0.0, 0.0);
  const Measurement forward = forwardSpeedMeasurement(setup_.wheel, step.wheel_speed_mps, step.wheel_speed_mps, motion,
                                                      H_v, {}, 0.0, step.slip_factor);
  const Measurement lateral = lateralMeasurement(setup_.nonholonomic, motion, H_v, {}, step.side_slip_factor);
  const Measurement vertical = verticalMeasurement(setup_.nonholonomic, motion, H_v, {});
  const double wheel_samples = std::max(step.wheel_share, kLeastShare) * samples_per_step_;
  const double vertical_samples =
      step_s_ / std::max(setup_.nonholonomic.vertical_interval_s, step_s_ / samples_per_step_);
  Odometry odometry;
  odometry.H.resize(3, kErrorStates);
  odometry.H << forward.H, lateral.H, vertical.H;
  odometry.claimed = Vector3(forward.variance(0) / wheel_samples, lateral.variance(0) / samples_per_step_,
                             vertical.variance(0) / vertical_samples);
  odometry.real = odometry.claimed;
  odometry.real(0) = outlook.wheel_noise_variance / wheel_samples;
  return odometry;
}

void CovarianceForecast::advance(const DriveStep& step, const GroundOutlook& outlook, ErrorCovariance& claim,
                                 ErrorCovariance& reality) const {
  const ErrorTransition by_filter = transition(step);
  ErrorDynamics::propagate(by_filter, claim);
  ErrorDynamics::propagate(onGround(by_filter, outlook), reality);
  const Odometry wheels = odometry(step, outlook);
  Measurement measurement(3);
  measurement.H = wheels.H;
  measurement.variance = wheels.claimed;
  if (const std::optional<KalmanGain> K = updateCovariance(measurement, claim)) {
    updateWith(*K, wheels.H, wheels.real, reality);
  }
}

void CovarianceForecast::follow(const DriveStep& step, const ErrorCovariance& P, const GroundOutlook& outlook) {
  advance(step, outlook, claim_, reality_);
  claim_ = P;
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
