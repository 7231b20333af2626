#include "core/forecast/forecaster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// Points of the horizon at which the predicted slip's correlation is sampled.
constexpr int kCorrelationPoints = 61;

/// Between the times at which the predicted slip is looked at.
constexpr double kPredictionStep_s = 1.0;

/// Slower than this the rover does not drive: any slip is hidden by its velocity error.
constexpr double kStandstill_mps = 1e-6;

/// Faster than this the rover turns; what a gyro shows at rest is less.
constexpr double kTurning_radps = 0.01;

SlipPrediction constantSlip(const Eigen::VectorXd& times_s, double stddev) {
  const auto count = times_s.size();
  return {times_s, Eigen::VectorXd::Zero(count), Eigen::VectorXd::Constant(count, stddev)};
}

bool isFinite(const Forecast& forecast) {
  const std::vector<double>& bound_m = forecast.error.horizontal_bound_m;
  return forecast.slip.mean.allFinite() && forecast.slip.stddev.allFinite() &&
         std::all_of(bound_m.begin(), bound_m.end(), [](double m) { return std::isfinite(m); });
}

}  // namespace

Forecaster::Forecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params)
    : setup_(setup),
      params_(params),
      recent_(params, !setup.filter.uses("wheel")),
      model_(params.slip),
      sigma_points_(params.sigma_points),
      covariance_(planet, setup, params.step_s, params.wheel_interval_s),
      outlook_(covariance_.assumption()) {}

void Forecaster::retune(const FilterSetup& setup, const ForecastParams& params) {
  setup_ = setup;
  params_ = params;
  recent_.retune(params, !setup.filter.uses("wheel"));
  covariance_.retune(setup);
}

void Forecaster::reset() {
  model_.reset();
  outlook_ = covariance_.assumption();
  recent_.reset();
  open_step_ = OpenStep{};
  stopped_ = 0;
  shown_variance_ = 0.0;
  last_slot_ = 0;
  problem_.clear();
}

std::optional<Forecast> Forecaster::push(const Estimate& estimate, const ErrorCovariance& P) {
  if (std::exchange(newest_, estimate.nav.stamp) >= estimate.nav.stamp) {
    reset();  // the recording restarted
  }
  if (!isUsable(estimate, P, problem_)) {
    return std::nullopt;
  }
  follow(estimate, P);
  if (!isMoving(estimate)) {
    return std::nullopt;
  }
  recent_.add(estimate);
  watchSlip(estimate);
  const bool knows_speed = recent_.intervals() >= static_cast<std::size_t>(params_.slip.min_samples);
  return isDue(estimate.nav.stamp) && knows_speed ? make(estimate) : std::nullopt;
}

/// A rover at rest that the filter has not recognized yet says nothing about how it will drive.
bool Forecaster::isMoving(const Estimate& estimate) const {
  return !estimate.stationary && (std::abs(estimate.wheels.motion.forward_mps) > setup_.stationary.wheel_speed_mps ||
                                  std::abs(estimate.omega_ib_b.z()) > kTurning_radps);
}

void Forecaster::follow(const Estimate& estimate, const ErrorCovariance& P) {
  const Nanoseconds now = estimate.nav.stamp;
  if (open_step_.begin == 0 || estimate.stationary) {
    covariance_.restart(P, params_.bound == "growth");
    open_step_ = {now, estimate.nav.v_eb_n, 0.0, 0.0};
    stopped_ = now;
    shown_variance_ = 0.0;
    return;
  }
  open_step_.samples += 1.0;
  open_step_.used += estimate.wheel_speed_used ? 1.0 : 0.0;
  const double duration_s = toSeconds(now - open_step_.begin);
  if (duration_s < params_.step_s - 0.5 * params_.wheel_interval_s) {
    return;
  }
  DriveStep step;
  step.state = estimate.nav;
  step.acceleration_n = (estimate.nav.v_eb_n - open_step_.v_eb_n) / duration_s;
  step.speed_mps = estimate.motion.v_eb_b.x();
  step.wheel_speed_mps = estimate.wheels.motion.forward_mps;
  step.wheel_share = open_step_.used / open_step_.samples;
  step.noise_factors = estimate.noise_factors;
  covariance_.follow(step, P, outlook_);
  open_step_ = {now, estimate.nav.v_eb_n, 0.0, 0.0};
}

/// Slip that comes and goes again may have stayed: a filter that believes its wheels makes it a velocity error, which
/// shows at the next stop at the earliest. So the largest slip since the last one is remembered, over a way on which
/// the mean of varying slip is no larger than usual persistent slip, less what varying slip and velocity error explain.
void Forecaster::watchSlip(const Estimate& estimate) {
  const GroundOutlook filter = covariance_.assumption(estimate.noise_factors);
  const double usual = square(filter.drift_std);
  const double way_m = 2.0 * setup_.vehicle.fast_slip_length_m * square(filter.change_std) / usual;
  if (const std::optional<double> mean = recent_.meanSlip(way_m, stopped_)) {
    const double speed_mps = std::max(std::abs(estimate.motion.v_eb_b.x()), kStandstill_mps);
    const double hidden = covariance_.forwardVariance(estimate.nav) / square(speed_mps);
    const double shown = square(*mean) - usual - hidden;
    if (shown > shown_variance_) {
      shown_variance_ = shown;
      covariance_.persist(shown);
    }
  }
}

bool Forecaster::isDue(Nanoseconds stamp) {
  const Nanoseconds slot = stamp / fromSeconds(params_.interval_s);
  const bool due = slot != last_slot_;
  last_slot_ = slot;
  return due;
}

std::optional<Forecast> Forecaster::make(const Estimate& estimate) {
  Forecast forecast;
  forecast.fit = model_.fit(recent_.slip());
  learnGround(estimate, forecast);
  forecast.outlook = outlook_;
  forecast.error.stamp = estimate.nav.stamp;
  forecast.error.threshold_m = params_.threshold_m;
  boundError(covariance_.ahead(wayAhead(estimate), outlook_), forecast.error);
  forecast.error.stop_distance_m = std::abs(outlook_.speed_mps) * forecast.error.time_to_stop_s;
  problem_ = isFinite(forecast) ? "" : "the forecast is not finite";
  return problem_.empty() ? std::optional(std::move(forecast)) : std::nullopt;
}

/// Without a window the filter's own expectation is the forecast.
void Forecaster::learnGround(const Estimate& estimate, Forecast& forecast) {
  outlook_ = covariance_.assumption(estimate.noise_factors);
  outlook_.speed_mps = outlook_.wheel_speed_mps = recent_.cruisingSpeed();
  outlook_.wheel_share = recent_.wheelShare();
  if (isAccepted(forecast.fit.status)) {
    predictSlip(estimate.nav.stamp, forecast);
    learnSlip(forecast);
    weighAgainstFilter(estimate);
  } else {
    forecast.slip = constantSlip(timesAhead(), std::hypot(outlook_.drift_std, outlook_.change_std));
  }
}

/// Every whole second of the horizon, which has at least one.
Eigen::VectorXd Forecaster::timesAhead() const {
  const double count = std::max(1.0, std::floor(params_.horizon_s / kPredictionStep_s));
  return Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(count), kPredictionStep_s, count * kPredictionStep_s);
}

void Forecaster::predictSlip(Nanoseconds now, Forecast& forecast) const {
  const double now_s = toSeconds(now - recent_.origin());
  const Eigen::VectorXd ahead_s = timesAhead();
  forecast.slip = model_.predict(ahead_s.array() + now_s);
  forecast.slip.times_s = ahead_s;
  forecast.correlation = summarizeCorrelation(model_, now_s, params_.horizon_s, kCorrelationPoints);
}

void Forecaster::learnSlip(const Forecast& forecast) {
  const double speed_mps = std::abs(outlook_.speed_mps);
  const double mean_slip = forecast.slip.mean.mean();
  const double noise_std = std::sqrt(forecast.fit.hyperparameter("noise_variance"));
  const double slip_std = std::hypot(forecast.correlation.stddev, forecast.correlation.bias_stddev);
  const WheelSpeedPrediction wheel = sigma_points_.predict(speed_mps, mean_slip, std::hypot(slip_std, noise_std));
  outlook_.wheel_speed_mps = std::copysign(wheel.mean_mps, outlook_.speed_mps);
  // The filter's model is the slip ratio times the wheel speed; where the true map is steeper, the slip is scaled up.
  const double steepness = wheel.mean_mps > 0.0 ? wheel.sensitivity_mps / wheel.mean_mps : 1.0;
  // The next ground may slip less, or as much more: the uncertainty of the mean is at least its magnitude.
  outlook_.drift_std = steepness * std::max(forecast.correlation.bias_stddev, std::abs(mean_slip));
  outlook_.change_std = steepness * forecast.correlation.stddev;
  outlook_.change_time_s = std::max(forecast.correlation.time_constant_s, params_.wheel_interval_s);
  outlook_.wheel_noise_variance =
      square(setup_.wheel.speed_std_mps) + recent_.intervalsPerSlip() * square(wheel.sensitivity_mps * noise_std);
}

/// The slip in the window is what the filter estimates, and includes its velocity error. So varying slip is at most
/// what the filter has learned about wheels and ground from its innovations; persistent slip counts as less than that
/// only as far as the velocity error cannot hide it, and as more wherever it shows.
void Forecaster::weighAgainstFilter(const Estimate& estimate) {
  const GroundOutlook filter = covariance_.assumption(estimate.noise_factors);
  outlook_.change_std = std::min(outlook_.change_std, filter.change_std);
  outlook_.wheel_noise_variance = std::min(outlook_.wheel_noise_variance, filter.wheel_noise_variance);
  const double speed_mps = std::max(std::abs(outlook_.speed_mps), kStandstill_mps);
  const double hidden = covariance_.forwardVariance(estimate.nav) / square(speed_mps);
  const double seen = square(outlook_.drift_std);
  const double usual = square(filter.drift_std);
  outlook_.drift_std = std::sqrt(std::max({seen, shown_variance_, std::min(usual, seen + hidden)}));
}

std::vector<DriveStep> Forecaster::wayAhead(const Estimate& estimate) const {
  const auto count = static_cast<std::size_t>(std::lround(params_.horizon_s / params_.step_s));
  const auto stride = static_cast<std::size_t>(std::max(1L, std::lround(params_.step_s / params_.wheel_interval_s)));
  std::vector<DriveStep> steps(count);
  Vector3 v_before_n = open_step_.v_eb_n;  // where the covariance is; the path from there to driving counts as well
  for (std::size_t i = 0; i < count; ++i) {
    DriveStep& step = steps[i];
    step.state = estimate.nav;
    step.state.q_b_to_n = recent_.attitude((i + 1) * stride);
    step.state.v_eb_n = step.state.q_b_to_n * Vector3(outlook_.speed_mps, 0.0, 0.0);
    step.acceleration_n = (step.state.v_eb_n - v_before_n) / params_.step_s;
    step.speed_mps = outlook_.speed_mps;
    step.wheel_speed_mps = outlook_.wheel_speed_mps;
    step.wheel_share = outlook_.wheel_share;
    step.noise_factors = estimate.noise_factors;
    v_before_n = step.state.v_eb_n;
  }
  return steps;
}

void Forecaster::boundError(const std::vector<double>& std_m, ErrorOutlook& error) const {
  for (std::size_t i = 0; i < std_m.size(); ++i) {
    error.times_s.push_back(params_.step_s * static_cast<double>(i + 1));
    error.horizontal_bound_m.push_back(params_.sigmas * std_m[i]);
    if (error.horizontal_bound_m.back() >= params_.threshold_m && std::isinf(error.time_to_stop_s)) {
      error.time_to_stop_s = i == 0 ? 0.0 : error.times_s[i - 1];
    }
  }
}

}  // namespace slipnav
