#pragma once
/// The paper's method (Kilic et al. 2021, section IV) as printed: collect slip for 15 s or 12 m of free driving,
/// forecast once, keep the countdown until the rover has stopped, then collect again. See doc/paper_method.md.

#include <optional>
#include <string>
#include <vector>

#include "core/forecast/forecast_method.h"
#include "core/forecast/frozen_filter.h"
#include "core/forecast/sigma_points.h"

namespace slipnav {

/// Makes one forecast per window of driving.
class PaperForecaster final : public ForecastMethod {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  PaperForecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params);

  /// A standstill starts a new window, and so does a forecast that predicts no stop, or a countdown that was ignored.
  std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P) override;
  void retune(const FilterSetup& setup, const ForecastParams& params) override;
  void reset() override;
  const std::string& problem() const override { return problem_; }

 private:
  /// Free driving since the last stop or forecast.
  struct Window {
    Nanoseconds begin = 0;
    SlipSamples slip;  ///< times since `begin`
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
  Nanoseconds kept_until_ = 0;  ///< end of the running countdown
  std::string problem_;
};

}  // namespace slipnav
