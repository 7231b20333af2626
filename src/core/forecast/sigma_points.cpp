#include "core/forecast/sigma_points.h"

#include <algorithm>
#include <stdexcept>

#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

// Slope of wheelSpeedFromSlip(), for a spread too small to measure it.
double slope(double speed_mps, double slip) {
  return slip >= 0.0 ? speed_mps / ((1.0 - slip) * (1.0 - slip)) : speed_mps;
}

SigmaPointForm formOf(const std::string& name) {
  return name == "paper"    ? SigmaPointForm::kPaper
         : name == "letter" ? SigmaPointForm::kLetter
                            : SigmaPointForm::kUnscented;
}

// For a narrower spread the difference quotient of the points loses precision.
constexpr double kMinSpread = 1e-6;

}  // namespace

void SigmaPointParameters::visit(ParameterVisitor& v) {
  v.choice(
      "form", form, {"unscented", "paper", "letter"},
      "wheel speed variance from predicted slip: unscented; by the paper's three points; or by the paper's printed "
      "equations, whose units are inconsistent");
  v.number("spread", spread, {1.0, 10.0}, "distance of the outer sigma points from the mean, in standard deviations");
  v.number("max_slip", max_slip, {0.0, 0.999}, "sigma points are clamped to this slip ratio, short of the pole at 1");
}

double wheelSpeedFromSlip(double speed_mps, double slip) {
  return slip >= 0.0 ? speed_mps / (1.0 - slip) : speed_mps * (1.0 + slip);
}

SigmaPoints::SigmaPoints(const SigmaPointParameters& parameters)
    : form_(formOf(parameters.form)), spread_(parameters.spread), max_slip_(parameters.max_slip) {
  checkParameters(parameters);
}

double SigmaPoints::clampSlip(double slip) const { return std::clamp(slip, -max_slip_, max_slip_); }

WheelSpeedPrediction SigmaPoints::predict(double speed_mps, double slip_mean, double slip_stddev) const {
  if (!(slip_stddev >= 0.0)) {
    throw std::invalid_argument("sigma points: the standard deviation of slip must not be negative");
  }
  return form_ == SigmaPointForm::kUnscented ? unscented(speed_mps, slip_mean, slip_stddev)
                                             : paper(speed_mps, slip_mean, slip_stddev);
}

double SigmaPoints::wheelSpeed(double speed_mps, double slip) const {
  return form_ == SigmaPointForm::kUnscented ? wheelSpeedFromSlip(speed_mps, clampSlip(slip))
                                             : speed_mps / (1.0 - clampSlip(slip));
}

/// From the mean to the outer points.
double SigmaPoints::reach(double slip_stddev) const {
  switch (form_) {
    case SigmaPointForm::kUnscented:
      return spread_ * slip_stddev;
    case SigmaPointForm::kPaper:
      return slip_stddev;
    case SigmaPointForm::kLetter:
      break;
  }
  return slip_stddev * slip_stddev;
}

std::array<double, 3> SigmaPoints::points(double speed_mps, double slip_mean, double slip_stddev) const {
  const double outer = reach(slip_stddev);
  return {wheelSpeed(speed_mps, slip_mean), wheelSpeed(speed_mps, slip_mean + outer),
          wheelSpeed(speed_mps, slip_mean - outer)};
}

WheelSpeedPrediction SigmaPoints::unscented(double speed_mps, double slip_mean, double slip_stddev) const {
  const double outer_weight = 0.5 / (spread_ * spread_);
  const std::array<double, 3> chi = points(speed_mps, slip_mean, slip_stddev);
  // Deviations from the central point: exact zeros for zero spread.
  const double above = chi[1] - chi[0];
  const double below = chi[2] - chi[0];
  const double shift = outer_weight * (above + below);
  WheelSpeedPrediction prediction;
  prediction.mean_mps = chi[0] + shift;
  prediction.variance = std::max(0.0, outer_weight * (above * above + below * below) - shift * shift);
  prediction.sensitivity_mps = reach(slip_stddev) > kMinSpread ? 0.5 * (above - below) / reach(slip_stddev)
                                                               : slope(speed_mps, clampSlip(slip_mean));
  return prediction;
}

WheelSpeedPrediction SigmaPoints::paper(double speed_mps, double slip_mean, double slip_stddev) const {
  const std::array<double, 3> chi = points(speed_mps, slip_mean, slip_stddev);
  const double mean = (chi[0] + chi[1] + chi[2]) / 3.0;
  double spread = 0.0;
  for (const double point : chi) {
    spread += (point - mean) * (point - mean) / 3.0;
  }
  const double variance = form_ == SigmaPointForm::kLetter ? spread * spread : spread;
  return {mean, variance, slope(speed_mps, clampSlip(slip_mean))};
}

}  // namespace slipnav
