#include "core/forecast/forecast_method.h"

#include <cmath>

#include "core/forecast/forecaster.h"
#include "core/forecast/paper_forecaster.h"

namespace slipnav {
namespace {

bool isFinite(const Estimate& estimate, const ErrorCovariance& P) {
  return isFinite(estimate.nav) && estimate.motion.v_eb_b.allFinite() && estimate.f_ib_b.allFinite() &&
         std::isfinite(estimate.wheels.motion.forward_mps) && P.allFinite();
}

}  // namespace

std::unique_ptr<ForecastMethod> makeForecastMethod(const Planet& planet, const FilterSetup& setup,
                                                   const ForecastParams& params) {
  if (params.schedule == "paper") {
    return std::make_unique<PaperForecaster>(planet, setup, params);
  }
  return std::make_unique<Forecaster>(planet, setup, params);
}

bool isUsable(const Estimate& estimate, const ErrorCovariance& P, std::string& problem) {
  if (estimate.has_wheels && !isFinite(estimate, P)) {
    problem = "the estimate is not finite";
    return false;
  }
  return estimate.has_wheels;
}

}  // namespace slipnav
