#include "evaluation/forecast_recorder.h"

#include <chrono>
#include <cmath>

namespace slipnav {
namespace {

constexpr double kRowInterval_s = 1.0;
constexpr double kTolerance_s = 1e-6;

/// Whether a time of the horizon is a whole second.
bool isRow(double time_s) { return std::abs(std::remainder(time_s, kRowInterval_s)) < kTolerance_s; }

}  // namespace

ForecastRecorder::ForecastRecorder(const Config& config)
    : forecaster_(makeForecastMethod(Planet::byName(config.planet), config.navigation().filter, config.forecast)),
      sigma_points_(config.forecast.sigma_points) {}

void ForecastRecorder::clear() {
  forecaster_->reset();
  errors_.clear();
  slips_.clear();
  times_ms_.clear();
}

void ForecastRecorder::push(const Estimate& estimate, const ErrorCovariance& P, const Sink& sink) {
  const auto begin = std::chrono::steady_clock::now();
  const std::optional<Forecast> forecast = forecaster_->push(estimate, P);
  if (!forecast) {
    return;
  }
  times_ms_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  keep(*forecast);
  if (sink) {
    sink(forecast->error);
  }
}

void ForecastRecorder::keep(const Forecast& forecast) {
  const ErrorOutlook& error = forecast.error;
  const std::optional<double> time_to_stop_s =
      std::isfinite(error.time_to_stop_s) ? std::optional(error.time_to_stop_s) : std::nullopt;
  for (std::size_t i = 0; i < error.times_s.size(); ++i) {
    if (isRow(error.times_s[i])) {
      errors_.push_back({error.stamp, error.times_s[i], error.horizontal_bound_m[i], time_to_stop_s});
    }
  }
  for (Eigen::Index i = 0; i < forecast.slip.times_s.size(); ++i) {
    if (isRow(forecast.slip.times_s(i))) {
      const double mean = forecast.slip.mean(i);
      const double stddev = forecast.slip.stddev(i);
      slips_.push_back({error.stamp, forecast.slip.times_s(i), mean, stddev,
                        sigma_points_.points(forecast.outlook.speed_mps, mean, stddev)});
    }
  }
}

}  // namespace slipnav
