#pragma once
/// Brings estimates and forecasts into the order in which they belong together: a forecast comes after the estimate
/// that it was made with, and before the next one.

#include <deque>
#include <functional>

#include "core/ordering/patience_limits.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// Estimates and forecasts come to the supervisor on different ways. This holds an estimate in whose step a wheel
/// interval ended back until the forecaster, which takes only those, has dealt with it, and all after it. A forecaster
/// that is silent is waited for once, for a moment of real time; it is not waited for again until it speaks.
class ForecastGate {
 public:
  explicit ForecastGate(double patience_s = kPatience_s) : patience_s_(patience_s) {}

  /// @param now_s any clock that only runs forward. One whose stamp goes back by a second or more begins anew.
  void push(const RoverObservation& observation, double now_s);
  void push(const StopForecast& forecast);
  /// The forecaster has dealt with the estimates up to `stamp`, and published what it made of them.
  void dealtWith(Nanoseconds stamp);

  using ObservationSink = std::function<void(const RoverObservation&)>;
  using ForecastSink = std::function<void(const StopForecast&)>;
  /// Lets go what has become certain, in order.
  void release(double now_s, const ObservationSink& observations, const ForecastSink& forecasts);

  bool forecasterIsSilent() const { return silent_; }

 private:
  struct Held {
    RoverObservation observation;
    double time_s;
  };

  bool mayGo(const Held& held, double now_s);
  void releaseForecasts(const ForecastSink& forecasts);

  double patience_s_;
  std::deque<Held> held_;
  std::deque<StopForecast> forecasts_;
  Nanoseconds newest_ = 0;    ///< estimate that came
  Nanoseconds released_ = 0;  ///< estimate that was let go
  Nanoseconds dealt_with_ = 0;
  bool silent_ = true;
};

}  // namespace slipnav
