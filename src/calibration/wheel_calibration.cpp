#include "calibration/wheel_calibration.h"

#include <cmath>

#include "calibration/batch_regression.h"
#include "calibration/side_fit.h"
#include "core/base/square.h"

namespace slipnav {
namespace {

/// Less turning than this says nothing about scrubbing.
constexpr double kLeastTurnForScrub_rad = 1.5;
/// Stretches into which the firm ground is divided; slip there decorrelates within a meter or two.
constexpr double kFirmBatches = 8.0;
/// Firm ground on which the wheels slip more than elsewhere, by this many standard deviations, is not firm.
constexpr double kFirmDoubt = 3.0;
/// Ground with more slip than this is unsuitable for calibration.
constexpr double kSoftSlip = 0.03;

/// Speed of the vehicle's middle line by the wheels, with the right difference between the sides.
double wheelSpeed(const Sides& sides, const SideFit& fit, const MotionSample& sample) {
  if (!sides.present(sample.wheels)) {
    return sample.wheels.motion.forward_mps;
  }
  return ((1.0 + fit.half_difference) * sides.leftSpeed(sample.wheels) * sides.rightOffset() +
          (1.0 - fit.half_difference) * sides.rightSpeed(sample.wheels) * sides.leftOffset()) /
         sides.track();
}

/// Ground over wheel speed on a part of the drive, by robust regression; 1σ from its batches.
std::optional<Calibrated> speedRatio(const Sides& sides, const SideFit& side_fit,
                                     const std::vector<MotionSample>& samples, double batch_m) {
  RegressionProblem problem(1);
  Eigen::VectorXd row(1);
  for (const MotionSample& sample : samples) {
    row(0) = wheelSpeed(sides, side_fit, sample);
    problem.add(row, sample.v_eb_b.x(), batchOf(sample, batch_m));
  }
  if (samples.empty()) {
    return std::nullopt;
  }
  const RegressionResult fit = regress(problem);
  if (fit.effective_batches(0) < kLeastBatches) {
    return std::nullopt;
  }
  return Calibrated{fit.estimate(0), std::sqrt(fit.covariance(0, 0))};
}

/// 1σ of the length of a part of the drive by the truth: its two ends, along the path.
double lengthStd(const std::vector<MotionSample>& samples) {
  const auto variance = [](const MotionSample& s) { return s.forward_n.dot(s.position_covariance_n * s.forward_n); };
  return std::sqrt(variance(samples.front()) + variance(samples.back()));
}

double length(const std::vector<MotionSample>& samples) {
  double sum_m = 0.0;
  for (const MotionSample& sample : samples) {
    sum_m += sample.v_eb_b.x() * sample.duration_s;
  }
  return std::abs(sum_m);
}

/// The part of the drive on firm ground and the rest.
struct Parts {
  std::vector<MotionSample> firm;
  std::vector<MotionSample> rest;
};

Parts divide(const CalibrationParams& params, const std::vector<MotionSample>& samples) {
  Parts parts;
  for (const MotionSample& sample : samples) {
    (sample.travel_m <= params.firm_distance_m ? parts.firm : parts.rest).push_back(sample);
  }
  return parts;
}

double relativeStd(const Calibrated& quantity) { return quantity.std / std::abs(quantity.value); }

/// 1σ of a product or quotient relative to itself, as if its parts were independent.
double relativeStd(const Calibrated& a, const Calibrated& b) { return std::hypot(relativeStd(a), relativeStd(b)); }

/// Radii from the firm part, and the slip of the rest with these radii.
class RadiusEstimate {
 public:
  RadiusEstimate(const CalibrationParams& params, const Sides& sides, const SideFit& side_fit,
                 const std::vector<MotionSample>& samples)
      : params_(params), sides_(sides), side_fit_(side_fit), parts_(divide(params, samples)) {
    firm_ = speedRatio(sides_, side_fit_, parts_.firm, params_.firm_distance_m / kFirmBatches);
    if (firm_) {
      firm_->std = firm_->value * std::sqrt(square(relativeStd(*firm_)) + square(params_.firm_slip_std) +
                                            square(lengthStd(parts_.firm) / length(parts_.firm)));
    }
  }

  bool known() const { return firm_.has_value(); }

  /// @param side +1 left, −1 right
  Calibrated ratio(double side) const {
    const double value = firm_->value * (1.0 + side * side_fit_.half_difference);
    return {value, value * std::hypot(relativeStd(*firm_), side_fit_.half_difference_std)};
  }

  std::optional<Calibrated> slip() const {
    const std::optional<Calibrated> rest = speedRatio(sides_, side_fit_, parts_.rest, params_.batch_m);
    if (!rest) {
      return std::nullopt;
    }
    const double grip = rest->value / firm_->value;
    return Calibrated{1.0 - grip, grip * relativeStd(*rest, *firm_)};
  }

 private:
  const CalibrationParams& params_;
  const Sides& sides_;
  const SideFit& side_fit_;
  Parts parts_;
  std::optional<Calibrated> firm_;
};

}  // namespace

void calibrateWheels(const Config& config, const std::vector<MotionSample>& samples, CalibrationResult& result) {
  const CalibrationParams& params = config.calibration;
  const Sides sides(config.wheels);
  SideFit side_fit;
  result.has_wheel_rates = samples.front().wheels.count > 0;
  result.sides_differ = sides.present(samples.front().wheels);
  if (!result.sides_differ) {
    result.not_observable.push_back("scrub factor, and radii per side: there are no wheel speeds on both sides");
  } else {
    const bool turns = result.turned_rad >= kLeastTurnForScrub_rad;
    side_fit = fitSides(sides, params.batch_m, config.wheel.scrub_factor, turns, samples);
    const std::optional<Calibrated> whole_drive = speedRatio(sides, side_fit, samples, params.batch_m);
    result.track_m = sides.track();
    if (side_fit.turn_gain && whole_drive) {
      const double scrub = whole_drive->value * side_fit.turn_gain->value;
      result.scrub_factor = Calibrated{scrub, scrub * relativeStd(*whole_drive, *side_fit.turn_gain)};
    } else {
      result.not_observable.push_back("scrub factor: there are too few turns; drive at least five, to both sides");
    }
  }
  const RadiusEstimate radii(params, sides, side_fit, samples);
  if (!radii.known()) {
    result.not_observable.push_back("radii: the drive on firm ground is too short");
    return;
  }
  result.left_radius_ratio = radii.ratio(1.0);
  result.right_radius_ratio = radii.ratio(-1.0);
  result.slip = radii.slip();
  if (result.slip && result.slip->value < -kFirmDoubt * result.slip->std) {
    result.warnings.push_back("the wheels slip more on the firm ground than later: the radii are too small");
  }
  if (result.slip && result.slip->value > kSoftSlip) {
    result.warnings.push_back("wheels slip by several percent: on such ground side slip turns the mounting angles");
  }
}

}  // namespace slipnav
