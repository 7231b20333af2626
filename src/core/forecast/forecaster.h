#pragma once
/// From the filter's estimates to forecasts: the slip window, the Gaussian process, the growth of the position error
/// and the time at which the rover is to stop.
///
///   Forecaster forecaster(planet, setup, params);
///   ... after each estimate:
///   if (const std::optional<Forecast> forecast = forecaster.push(estimate, P)) { ... }

#include <optional>
#include <string>
#include <vector>

#include "core/forecast/forecast_method.h"
#include "core/forecast/recent_drive.h"
#include "core/forecast/sigma_points.h"

namespace slipnav {

/// Makes a forecast at every interval of driving.
class Forecaster final : public ForecastMethod {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  Forecaster(const Planet& planet, const FilterSetup& setup, const ForecastParams& params);

  /// A forecast is due at the first wheel sample of each interval while the rover moves. While the window holds too
  /// little slip, that which the filter expects is forecast, and the fit says why.
  std::optional<Forecast> push(const Estimate& estimate, const ErrorCovariance& P) override;
  void retune(const FilterSetup& setup, const ForecastParams& params) override;
  void reset() override;
  const std::string& problem() const override { return problem_; }

 private:
  /// The step currently being driven.
  struct OpenStep {
    Nanoseconds begin = 0;
    Vector3 v_eb_n = Vector3::Zero();  ///< at its beginning
    double samples = 0.0;
    double used = 0.0;  ///< samples whose wheel speed was used
  };

  bool isMoving(const Estimate& estimate) const;
  void follow(const Estimate& estimate, const ErrorCovariance& P);
  void watchSlip(const Estimate& estimate);
  bool isDue(Nanoseconds stamp);
  std::optional<Forecast> make(const Estimate& estimate);
  void learnGround(const Estimate& estimate, Forecast& forecast);
  Eigen::VectorXd timesAhead() const;
  void predictSlip(Nanoseconds now, Forecast& forecast) const;
  void learnSlip(const Forecast& forecast);
  void weighAgainstFilter(const Estimate& estimate);
  std::vector<DriveStep> wayAhead(const Estimate& estimate) const;
  void boundError(const std::vector<double>& std_m, ErrorOutlook& error) const;

  FilterSetup setup_;
  ForecastParams params_;
  RecentDrive recent_;
  GaussianProcessSlipModel model_;
  SigmaPoints sigma_points_;
  CovarianceForecast covariance_;
  GroundOutlook outlook_;  ///< as last learned
  OpenStep open_step_;
  Nanoseconds stopped_ = 0;      ///< newest standstill
  double shown_variance_ = 0.0;  ///< of persistent slip, as largest seen since then
  Nanoseconds newest_ = 0;
  Nanoseconds last_slot_ = 0;
  std::string problem_;
};

}  // namespace slipnav
