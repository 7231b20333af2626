#include "core/forecast/paper_forecaster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/slip/vehicle_slip.h"

namespace slipnav {
namespace {

/// A countdown that expired this long ago without a standstill was ignored [s].
constexpr double kUnheeded_s = 6.0;

}  // namespace

PaperForecaster::PaperForecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params)
    : setup_(setup),
      params_(params),
      dynamics_(planet, setup.imu, setup.vehicle),
      model_(params.slip),
      sigma_points_(params.sigma_points) {}

void PaperForecaster::retune(const FilterSetup& setup, const ForecastParams& params) {
  setup_ = setup;
  params_ = params;
}

void PaperForecaster::reset() {
  model_.reset();
  window_ = Window{};
  kept_until_ = 0;
  problem_.clear();
}

std::optional<Forecast> PaperForecaster::push(const Estimate& estimate, const ErrorCovariance& P) {
  if (std::exchange(newest_, estimate.nav.stamp) >= estimate.nav.stamp) {
    reset();  // the recording restarted
  }
  if (!isUsable(estimate, P, problem_)) {
    return std::nullopt;
  }
  if (estimate.stationary) {
    window_ = Window{};
    kept_until_ = 0;
    return std::nullopt;
  }
  if (newest_ < kept_until_) {
    return std::nullopt;
  }
  collect(estimate);
  return isFull() ? make(estimate, P) : std::nullopt;
}

void PaperForecaster::collect(const Estimate& estimate) {
  const double v_x = estimate.motion.v_eb_b.x();
  const std::optional<double> slip = meanSlip(estimate);
  if (!slip) {
    return;
  }
  if (window_.begin == 0) {
    window_.begin = newest_;
  }
  window_.driven_s += estimate.motion.duration_s;
  window_.driven_m += std::abs(v_x) * estimate.motion.duration_s;
  if (std::abs(*slip) < 1.0) {
    window_.slip.times_s.push_back(toSeconds(newest_ - window_.begin));
    window_.slip.slips.push_back(*slip);
    window_.speed_sum_mps += v_x;
  }
}

bool PaperForecaster::isFull() const {
  return window_.driven_s >= params_.window_s - 0.5 * params_.wheel_interval_s || window_.driven_m >= params_.window_m;
}

std::optional<Forecast> PaperForecaster::make(const Estimate& estimate, const ErrorCovariance& P) {
  Forecast forecast;
  forecast.fit = model_.fit(window_.slip);
  if (isAccepted(forecast.fit.status)) {
    problem_.clear();
    predictSlip(forecast);
    boundError(estimate, P, forecast);
  } else {
    problem_ = toString(forecast.fit.status);
  }
  window_ = Window{};
  const std::vector<double>& bound_m = forecast.error.horizontal_bound_m;
  if (problem_.empty() && !std::all_of(bound_m.begin(), bound_m.end(), [](double m) { return std::isfinite(m); })) {
    problem_ = "the forecast is not finite";
  }
  if (!problem_.empty()) {
    return std::nullopt;
  }
  if (forecast.error.kept_s > 0.0) {
    kept_until_ = newest_ + fromSeconds(forecast.error.kept_s + kUnheeded_s);
  }
  return forecast;
}

void PaperForecaster::predictSlip(Forecast& forecast) {
  const auto updates = static_cast<Eigen::Index>(std::lround(params_.horizon_s / params_.wheel_interval_s));
  const Eigen::VectorXd ahead_s =
      params_.wheel_interval_s * Eigen::VectorXd::LinSpaced(updates, 1.0, static_cast<double>(updates));
  forecast.slip = model_.predict(ahead_s.array() + toSeconds(newest_ - window_.begin));
  forecast.slip.times_s = ahead_s;
  forecast.outlook.speed_mps = window_.speed_sum_mps / static_cast<double>(window_.slip.slips.size());
}

void PaperForecaster::boundError(const Estimate& estimate, const ErrorCovariance& P, Forecast& forecast) const {
  const double speed_mps = std::abs(forecast.outlook.speed_mps);
  std::vector<Measurement::Vector> variances;
  for (Eigen::Index i = 0; i < forecast.slip.mean.size(); ++i) {
    variances.push_back(
        paperVariance(sigma_points_.predict(speed_mps, forecast.slip.mean(i), forecast.slip.stddev(i)).variance));
  }
  const FrozenFilter frozen = freeze(dynamics_, setup_, estimate, params_.wheel_interval_s / kImuStepsPerUpdate);
  ErrorOutlook& error = forecast.error;
  error.stamp = estimate.nav.stamp;
  error.threshold_m = params_.threshold_m;
  for (const double std_m : horizontalStdAhead(frozen, P, variances)) {
    error.times_s.push_back(params_.wheel_interval_s * static_cast<double>(error.times_s.size() + 1));
    error.horizontal_bound_m.push_back(params_.sigmas * std_m);
    if (error.horizontal_bound_m.back() > params_.threshold_m && std::isinf(error.time_to_stop_s)) {
      error.time_to_stop_s = error.kept_s = error.times_s.back();
    }
  }
  error.stop_distance_m = speed_mps * error.time_to_stop_s;
}

}  // namespace slipnav
