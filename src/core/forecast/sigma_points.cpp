#include "core/forecast/sigma_points.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

// Slope of wheelSpeedFromSlip(), for a spread too small to measure it.
double slope(double speed_mps, double slip) {
  return slip >= 0.0 ? speed_mps / ((1.0 - slip) * (1.0 - slip)) : speed_mps;
}

// For a narrower spread the difference quotient of the points loses precision.
constexpr double kMinSpread = 1e-6;

}  // namespace

void SigmaPointParameters::visit(ParameterVisitor& v) {
  v.choice("form", form, {"unscented", "paper"},
           "wheel speed variance from predicted slip: dimensionally right, or by the letter of the paper");
  v.number("spread", spread, {1.0, 10.0}, "distance of the outer sigma points from the mean, in standard deviations");
  v.number("max_slip", max_slip, {0.0, 0.999}, "sigma points are clamped to this slip ratio, short of the pole at 1");
}

double wheelSpeedFromSlip(double speed_mps, double slip) {
  return slip >= 0.0 ? speed_mps / (1.0 - slip) : speed_mps * (1.0 + slip);
}

SigmaPoints::SigmaPoints(const SigmaPointParameters& parameters)
    : form_(parameters.form == "paper" ? SigmaPointForm::kPaper : SigmaPointForm::kUnscented),
      spread_(parameters.spread),
      max_slip_(parameters.max_slip) {
  checkParameters(parameters);
}

double SigmaPoints::clampSlip(double slip) const { return std::clamp(slip, -max_slip_, max_slip_); }

WheelSpeedPrediction SigmaPoints::predict(double speed_mps, double slip_mean, double slip_stddev) const {
  if (!(slip_stddev >= 0.0)) {
    throw std::invalid_argument("sigma points: the standard deviation of slip must not be negative");
  }
  return form_ == SigmaPointForm::kPaper ? paper(speed_mps, slip_mean, slip_stddev)
                                         : unscented(speed_mps, slip_mean, slip_stddev);
}

WheelSpeedPrediction SigmaPoints::unscented(double speed_mps, double slip_mean, double slip_stddev) const {
  const double reach = spread_ * slip_stddev;
  const double outer_weight = 0.5 / (spread_ * spread_);
  const double center = wheelSpeedFromSlip(speed_mps, clampSlip(slip_mean));
  // Deviations from the central point: exact zeros for zero spread.
  const double above = wheelSpeedFromSlip(speed_mps, clampSlip(slip_mean + reach)) - center;
  const double below = wheelSpeedFromSlip(speed_mps, clampSlip(slip_mean - reach)) - center;
  const double shift = outer_weight * (above + below);
  WheelSpeedPrediction prediction;
  prediction.mean_mps = center + shift;
  prediction.variance = std::max(0.0, outer_weight * (above * above + below * below) - shift * shift);
  prediction.sensitivity_mps =
      reach > kMinSpread ? 0.5 * (above - below) / reach : slope(speed_mps, clampSlip(slip_mean));
  return prediction;
}

WheelSpeedPrediction SigmaPoints::paper(double speed_mps, double slip_mean, double slip_stddev) const {
  const double slip_variance = slip_stddev * slip_stddev;
  const auto chi = [&](double slip) { return speed_mps / (1.0 - clampSlip(slip)); };
  const std::array<double, 3> points = {chi(slip_mean), chi(slip_mean + slip_variance), chi(slip_mean - slip_variance)};
  const double mean = (points[0] + points[1] + points[2]) / 3.0;
  double spread = 0.0;
  for (const double point : points) {
    spread += (point - mean) * (point - mean) / 3.0;
  }
  return {mean, spread * spread, slope(speed_mps, clampSlip(slip_mean))};
}

}  // namespace slipnav
