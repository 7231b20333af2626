#include "core/forecast/forecast_method.h"

namespace slipnav {
namespace {

std::variant<Forecaster, PaperForecaster> methodOf(const Planet& planet, const FilterSetup& setup,
                                                   const ForecastParams& params) {
  if (params.schedule == "paper") {
    return PaperForecaster(planet, setup, params);
  }
  return Forecaster(planet, setup, params);
}

}  // namespace

ForecastMethod::ForecastMethod(const Planet& planet, const FilterSetup& setup, const ForecastParams& params)
    : method_(methodOf(planet, setup, params)) {}

std::optional<Forecast> ForecastMethod::push(const Estimate& estimate, const ErrorCovariance& P) {
  return std::visit([&](auto& method) { return method.push(estimate, P); }, method_);
}

void ForecastMethod::retune(const FilterSetup& setup, const ForecastParams& params) {
  std::visit([&](auto& method) { method.retune(setup, params); }, method_);
}

void ForecastMethod::reset() {
  std::visit([](auto& method) { method.reset(); }, method_);
}

const std::string& ForecastMethod::problem() const {
  return std::visit([](const auto& method) -> const std::string& { return method.problem(); }, method_);
}

}  // namespace slipnav
