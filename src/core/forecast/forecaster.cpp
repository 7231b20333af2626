#include "core/forecast/forecaster.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"
#include "core/slip/slip_ratio.h"
#include "core/slip/vehicle_slip.h"

namespace slipnav {
namespace {

/// Points of the horizon at which the predicted slip's correlation is sampled.
constexpr int kCorrelationPoints = 61;

/// Of its length, over which side slip is averaged.
constexpr double kSideSlipShare = 0.5;

/// Below this share of the highest speed the rover is starting or stopping.
constexpr double kCruisingShare = 0.7;

/// Position in 0 … count − 1 that moves back and forth.
std::size_t toAndFro(std::size_t i, std::size_t count) {
  const std::size_t period = std::max<std::size_t>(1, 2 * (count - 1));
  const std::size_t phase = i % period;
  return phase < count ? phase : period - phase;
}

bool isFinite(const Estimate& estimate, const ErrorCovariance& P) {
  return isFinite(estimate.nav) && estimate.motion.v_eb_b.allFinite() &&
         std::isfinite(estimate.wheels.motion.forward_mps) && P.allFinite();
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
      model_(params.slip),
      sigma_points_(params.sigma_points),
      covariance_(planet, setup, params.step_s, params.wheel_interval_s),
      outlook_(covariance_.assumption()) {}

void Forecaster::retune(const FilterSetup& setup, const ForecastParams& params) {
  setup_ = setup;
  params_ = params;
  covariance_.retune(setup);
}

void Forecaster::reset() {
  model_.reset();
  outlook_ = covariance_.assumption();
  drive_.clear();
  open_step_ = OpenStep{};
  newest_ = 0;
  last_slot_ = 0;
  problem_.clear();
}

std::optional<Forecast> Forecaster::push(const Estimate& estimate, const ErrorCovariance& P) {
  if (estimate.nav.stamp <= newest_) {
    reset();  // the recording restarted
  }
  newest_ = estimate.nav.stamp;
  if (!estimate.has_wheels) {
    return std::nullopt;
  }
  if (!isFinite(estimate, P)) {
    problem_ = "the estimate is not finite";
    return std::nullopt;
  }
  follow(estimate, P);
  return collect(estimate) && isDue(estimate.nav.stamp) ? make(estimate) : std::nullopt;
}

void Forecaster::follow(const Estimate& estimate, const ErrorCovariance& P) {
  const Nanoseconds now = estimate.nav.stamp;
  if (open_step_.begin == 0 || estimate.stationary) {
    covariance_.restart(P, params_.bound == "growth");
    open_step_ = {now, estimate.nav.v_eb_n, 0.0, 0.0};
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

bool Forecaster::collect(const Estimate& estimate) {
  const double v_x = estimate.motion.v_eb_b.x();
  const std::optional<double> slip =
      estimate.stationary ? std::nullopt : slipRatio(v_x, estimate.wheels.motion.forward_mps, kMinSpeedForSlip_mps);
  if (!slip || std::abs(*slip) >= 1.0) {
    return false;
  }
  drive_.push_back({estimate.nav.stamp, *slip, v_x, slipAngle(estimate.motion.v_eb_b, estimate.vehicle),
                    estimate.wheel_speed_used, estimate.nav.q_b_to_n});
  // This many intervals of driving, regardless of the stops between them.
  const auto most = static_cast<std::size_t>(std::lround(params_.window_s / params_.wheel_interval_s));
  while (drive_.size() > most || toSeconds(drive_.back().stamp - drive_.front().stamp) > params_.max_age_s) {
    drive_.pop_front();
  }
  return true;
}

bool Forecaster::isDue(Nanoseconds stamp) {
  const Nanoseconds slot = stamp / fromSeconds(params_.interval_s);
  const bool due = slot != last_slot_;
  last_slot_ = slot;
  return due;
}

SlipSamples Forecaster::window() const {
  // The filter does not navigate by what it treats as the slip impulse of a wheel that has lost grip.
  const bool all = !setup_.filter.uses("wheel");
  SlipSamples samples;
  for (const Drive& drive : drive_) {
    if (all || drive.wheel_speed_used) {
      samples.times_s.push_back(toSeconds(drive.stamp - drive_.front().stamp));
      samples.slips.push_back(drive.slip);
    }
  }
  return samples;
}

std::optional<Forecast> Forecaster::make(const Estimate& estimate) {
  Forecast forecast;
  forecast.fit = model_.fit(window());
  if (!isAccepted(forecast.fit.status)) {
    problem_ = toString(forecast.fit.status);
    return std::nullopt;
  }
  problem_.clear();
  const double now_s = toSeconds(drive_.back().stamp - drive_.front().stamp);
  const auto count = static_cast<Eigen::Index>(std::lround(params_.horizon_s / params_.wheel_interval_s));
  forecast.slip =
      model_.predict(Eigen::VectorXd::LinSpaced(count, now_s + params_.wheel_interval_s, now_s + params_.horizon_s));
  forecast.slip.times_s.array() -= now_s;
  forecast.correlation = summarizeCorrelation(model_, now_s, params_.horizon_s, kCorrelationPoints);
  learnGround(forecast);
  weighAgainstFilter(estimate);
  forecast.outlook = outlook_;
  forecast.error.stamp = estimate.nav.stamp;
  forecast.error.threshold_m = params_.threshold_m;
  boundError(covariance_.ahead(wayAhead(estimate), outlook_), forecast.error);
  forecast.error.stop_distance_m = std::abs(outlook_.speed_mps) * forecast.error.time_to_stop_s;
  if (!isFinite(forecast)) {
    problem_ = "the forecast is not finite";
    return std::nullopt;
  }
  return forecast;
}

/// Mean of the newest speeds, without starts and stops: the path ahead is assumed to be driven at the same speed.
double Forecaster::cruisingSpeed() const {
  const auto slower = [](const Drive& a, const Drive& b) { return std::abs(a.speed_mps) < std::abs(b.speed_mps); };
  const double fastest_mps = std::abs(std::max_element(drive_.begin(), drive_.end(), slower)->speed_mps);
  const double most = std::max(1.0, params_.speed_window_s / params_.wheel_interval_s);
  double sum_mps = 0.0;
  double count = 0.0;
  for (auto drive = drive_.rbegin(); drive != drive_.rend() && count < most; ++drive) {
    if (std::abs(drive->speed_mps) >= kCruisingShare * fastest_mps) {
      sum_mps += drive->speed_mps;
      count += 1.0;
    }
  }
  return sum_mps / count;
}

void Forecaster::learnSpeedAndSideSlip() {
  double used = 0.0;
  for (const Drive& drive : drive_) {
    used += drive.wheel_speed_used ? 1.0 : 0.0;
  }
  outlook_.speed_mps = cruisingSpeed();
  outlook_.wheel_share = used / static_cast<double>(drive_.size());
  outlook_.side_slip_std_rad = sideSlipSpread();
}

/// Scatter of the side slip that lasts. From one interval to the next a body sways without moving the vehicle, so means
/// over a part of the side slip's own length are compared.
double Forecaster::sideSlipSpread() const {
  const double length_m = kSideSlipShare * setup_.vehicle.side_slip_length_m;
  double sum = 0.0;
  double sum2 = 0.0;
  double means = 0.0;
  double way_m = 0.0;
  double angle_m = 0.0;
  for (const Drive& drive : drive_) {
    const double step_m = std::abs(drive.speed_mps) * params_.wheel_interval_s;
    way_m += step_m;
    angle_m += step_m * drive.side_slip_rad;
    if (way_m >= length_m) {
      sum += angle_m / way_m;
      sum2 += square(angle_m / way_m);
      means += 1.0;
      way_m = angle_m = 0.0;
    }
  }
  if (means < 2.0) {
    return degToRad(setup_.vehicle.side_slip_std_deg);
  }
  return std::sqrt(std::max(0.0, (sum2 - sum * sum / means) / (means - 1.0)));
}

void Forecaster::learnGround(const Forecast& forecast) {
  learnSpeedAndSideSlip();
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
  outlook_.wheel_noise_variance = square(setup_.wheel.speed_std_mps) + square(wheel.sensitivity_mps * noise_std);
}

/// The slip in the window is what the filter estimates, and includes its velocity error. So varying slip is at most
/// what the filter has learned about wheels and ground from its innovations; persistent slip counts as less than that
/// only as far as the velocity error cannot hide it, and as more wherever it shows.
void Forecaster::weighAgainstFilter(const Estimate& estimate) {
  const GroundOutlook filter = covariance_.assumption(estimate.noise_factors);
  outlook_.change_std = std::min(outlook_.change_std, filter.change_std);
  outlook_.wheel_noise_variance = std::min(outlook_.wheel_noise_variance, filter.wheel_noise_variance);
  const double speed_mps = std::max(std::abs(outlook_.speed_mps), kMinSpeedForSlip_mps);
  const double hidden = covariance_.forwardVariance(estimate.nav) / square(speed_mps);
  const double seen = square(outlook_.drift_std);
  const double usual = square(filter.drift_std);
  outlook_.drift_std = std::sqrt(std::max(seen, std::min(usual, seen + hidden)));
}

std::vector<DriveStep> Forecaster::wayAhead(const Estimate& estimate) const {
  const auto count = static_cast<std::size_t>(std::lround(params_.horizon_s / params_.step_s));
  const auto stride = static_cast<std::size_t>(std::max(1L, std::lround(params_.step_s / params_.wheel_interval_s)));
  std::vector<DriveStep> steps(count);
  Vector3 v_before_n = open_step_.v_eb_n;  // where the covariance is; the path from there to driving counts as well
  for (std::size_t i = 0; i < count; ++i) {
    DriveStep& step = steps[i];
    step.state = estimate.nav;
    step.state.q_b_to_n = drive_[drive_.size() - 1 - toAndFro((i + 1) * stride, drive_.size())].q_b_to_n;
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
