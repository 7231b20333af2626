#include "core/stopping/forecast_gate.h"

namespace slipnav {
namespace {

constexpr std::size_t kMaxForecasts = 100;  // of another session, whose estimates will never come

}  // namespace

void ForecastGate::push(const RoverObservation& observation, double now_s) {
  if (observation.stamp <= newest_ - kRestartBackstep) {
    *this = ForecastGate(patience_s_);
  }
  newest_ = observation.stamp;
  held_.push_back({observation, now_s});
}

void ForecastGate::push(const StopForecast& forecast) {
  forecasts_.push_back(forecast);
  if (forecasts_.size() > kMaxForecasts) {
    forecasts_.pop_front();
  }
}

void ForecastGate::dealtWith(Nanoseconds stamp) {
  dealt_with_ = stamp;
  silent_ = false;
}

bool ForecastGate::mayGo(const Held& held, double now_s) {
  if (!held.observation.has_wheels || held.observation.stamp <= dealt_with_) {
    return true;
  }
  silent_ = silent_ || now_s - held.time_s >= patience_s_;
  return silent_;
}

void ForecastGate::release(double now_s, const ObservationSink& observations, const ForecastSink& forecasts) {
  releaseForecasts(forecasts);
  while (!held_.empty() && mayGo(held_.front(), now_s)) {
    const RoverObservation observation = held_.front().observation;
    held_.pop_front();
    released_ = observation.stamp;
    observations(observation);
    releaseForecasts(forecasts);
  }
}

void ForecastGate::releaseForecasts(const ForecastSink& forecasts) {
  while (!forecasts_.empty() && forecasts_.front().stamp <= released_) {
    forecasts(forecasts_.front());
    forecasts_.pop_front();
  }
}

}  // namespace slipnav
