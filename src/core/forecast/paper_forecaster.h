#pragma once
/// The paper's method (Kilic et al. 2021, section IV) as it is printed: collect slip for 15 s or 12 m of free driving,
/// forecast once, keep the countdown until the rover has stopped, collect again. See doc/paper_method.md.

#include <optional>
#include <string>
#include <vector>

#include "core/forecast/forecaster.h"
#include "core/forecast/frozen_filter.h"

namespace slipnav {

/// Takes every estimate, as Forecaster does, and makes one forecast for each window of driving.
class PaperForecaster {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  PaperForecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params);

  /// Takes each estimate of the filter in order, with its covariance. A standstill begins a new window, and so does a
  /// forecast that sees no stop, or a countdown that nobody has heeded.
  std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P);

  /// Takes over threshold, window, horizon and the filter's measurements from the next estimate on.
  void retune(const FilterSetup& setup, const ForecastParams& params);

  /// Forgets everything.
  void reset();

  /// Why the last forecast that was due could not be made; empty when it could.
  const std::string& problem() const { return problem_; }

 private:
  /// Free driving since the last stop or forecast.
  struct Window {
    Nanoseconds begin = 0;
    SlipSamples slip;  ///< times since the begin
    double driven_s = 0.0;
    double driven_m = 0.0;
    double speed_sum_mps = 0.0;  ///< over the slip samples
  };

  void collect(const Estimate& estimate);
  bool isFull() const;
  std::optional<Forecast> make(const Estimate& estimate, const ErrorCovariance& P);
  void predictSlip(Forecast& forecast);
  void boundError(const Estimate& estimate, const ErrorCovariance& P, Forecast& forecast) const;

  FilterSetup setup_;
  ForecastParams params_;
  ErrorDynamics dynamics_;
  GaussianProcessSlipModel model_;
  SigmaPoints sigma_points_;
  Window window_;
  Nanoseconds newest_ = 0;
  Nanoseconds kept_until_ = 0;  ///< the countdown runs
  std::string problem_;
};

}  // namespace slipnav
