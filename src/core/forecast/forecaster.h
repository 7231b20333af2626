#pragma once
/// From the filter's estimates to forecasts: the slip window, the Gaussian process, the growth of the position error
/// and the time at which the rover is to stop.
///
///   Forecaster forecaster(planet, setup, params);
///   ... after each estimate:
///   if (const std::optional<Forecast> forecast = forecaster.push(estimate, P)) { ... }

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/forecast/covariance_forecast.h"
#include "core/forecast/error_outlook.h"
#include "core/forecast/forecast_params.h"
#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/sigma_points.h"
#include "core/forecast/slip_correlation.h"

namespace slipnav {

/// One forecast with everything it was made from.
struct Forecast {
  SlipFit fit;
  SlipPrediction slip;          ///< times ahead of the stamp
  GaussMarkovSlip correlation;  ///< of the predicted slip
  GroundOutlook outlook;
  ErrorOutlook error;
};

/// Receives every estimate, and makes a forecast when one is due.
class Forecaster {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  Forecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params);

  /// Takes each estimate of the filter in order, with its covariance. A forecast is due at the first wheel sample of
  /// each interval while the rover drives, once the window holds enough.
  std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P);

  /// Applies a new threshold, window, horizon and measurement noise from the next estimate on. Slip model, step and
  /// bound must be those of the constructor.
  void retune(const FilterSetup& setup, const ForecastParams& params);

  /// Forgets everything.
  void reset();

  /// Why the last forecast that was due could not be made; empty if it could.
  const std::string& problem() const { return problem_; }

 private:
  /// A wheel interval of free driving.
  struct Drive {
    Nanoseconds stamp = 0;
    double slip = 0.0;
    double speed_mps = 0.0;
    double side_slip_rad = 0.0;
    bool wheel_speed_used = true;
    Quaternion q_b_to_n = Quaternion::Identity();
  };
  /// The step currently being driven.
  struct OpenStep {
    Nanoseconds begin = 0;
    Vector3 v_eb_n = Vector3::Zero();  ///< at its beginning
    double samples = 0.0;
    double used = 0.0;  ///< samples whose wheel speed was used
  };

  void follow(const Estimate& estimate, const ErrorCovariance& P);
  bool collect(const Estimate& estimate);
  bool isDue(Nanoseconds stamp);
  std::optional<Forecast> make(const Estimate& estimate);
  SlipSamples window() const;
  void learnGround(const Forecast& forecast);
  void weighAgainstFilter(const Estimate& estimate);
  double cruisingSpeed() const;
  void learnSpeedAndSideSlip();
  double sideSlipSpread() const;
  std::vector<DriveStep> wayAhead(const Estimate& estimate) const;
  void boundError(const std::vector<double>& std_m, ErrorOutlook& error) const;

  FilterSetup setup_;
  ForecastParams params_;
  GaussianProcessSlipModel model_;
  SigmaPoints sigma_points_;
  CovarianceForecast covariance_;
  GroundOutlook outlook_;    ///< as last learned
  std::deque<Drive> drive_;  ///< the last seconds of free driving
  OpenStep open_step_;
  Nanoseconds newest_ = 0;
  Nanoseconds last_slot_ = 0;
  std::string problem_;
};

}  // namespace slipnav
