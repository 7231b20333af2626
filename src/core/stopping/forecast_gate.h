#pragma once
/// Puts estimates and forecasts in the order in which they belong: a forecast comes after the estimate
/// it was made with, and before the next one.

#include <deque>
#include <functional>

#include "core/ordering/patience_limits.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// Estimates and forecasts reach the supervisor by different routes. This holds back an estimate whose step contains
/// the end of a wheel interval, and all later ones, until the forecaster, which takes only those, has processed it. A
/// silent forecaster is waited for once, for a moment of real time, and then not again until it is heard.
class ForecastGate {
 public:
  explicit ForecastGate(double patience_s = kPatience_s) : patience_s_(patience_s) {}

  /// @param now_s any monotonic clock. A stamp that goes back by a second or more restarts the gate.
  void push(const RoverObservation& observation, double now_s);
  void push(const StopForecast& forecast);
  /// The forecaster has processed the estimates up to `stamp`, and published the results.
  void dealtWith(Nanoseconds stamp);

  using ObservationSink = std::function<void(const RoverObservation&)>;
  using ForecastSink = std::function<void(const StopForecast&)>;
  /// Releases what has become certain, in order.
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
  Nanoseconds newest_ = 0;    ///< newest received estimate
  Nanoseconds released_ = 0;  ///< newest released estimate
  Nanoseconds dealt_with_ = 0;
  bool silent_ = true;
};

}  // namespace slipnav
