#include "slipnav/core/ekf/adaptation/noise_scales.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// One outlier must not turn a road into sand.
constexpr double kLargestNis = 30.0;
/// What was learned fades towards the prior over this many memory lengths.
constexpr double kPriorLengths = 10.0;
/// Distance between innovations of the wheel speed, and between those of the constraints [m].
constexpr double kWheelInterval_m = 0.1;
constexpr double kConstraintInterval_m = 1.0;
constexpr double kLeastTheta = -9.0;

/// Upper limits on the noise of each kind: beyond them a contradiction is about the state. An encoder may be ninety
/// times as coarse as configured; a body does not pitch by more than a tenth about its path, nor slip by more than a
/// third for long.
const NoiseVector& largestTheta() {
  static const NoiseVector largest = (NoiseVector() << 9.0, 2.2, 3.2, 4.2, 3.2, 4.2, 0.0).finished();
  return largest;
}

constexpr int kNewtonSteps = 4;

/// α that maximizes −½α²q − ½(ln S(α) + r²/S(α)), with S(α) = S + Σ Cᵢ (exp(α dᵢ) − 1).
double mostProbable(const NoiseVector& shares, const NoiseVector& direction, double q, double squared,
                    double variance) {
  double alpha = 0.0;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const NoiseVector now = shares.array() * (alpha * direction.array()).exp();
    const double S = variance + (now - shares).sum();
    const double slope = now.dot(direction) / S;
    const double gradient = alpha * q + 0.5 * slope * (1.0 - squared / S);
    const double curvature = q + 0.5 * slope * slope * std::max(squared / S, 1.0);
    alpha -= gradient / curvature;
  }
  return alpha;
}

}  // namespace

void NoiseScaleParams::visit(ParameterVisitor& v) {
  v.number("length_m", length_m, {0.1, 1e6}, "distance over which learned noise and ground are forgotten [m]");
  v.number("factor_std", factor_std, {1.0, 100.0},
           "how far a configured standard deviation may be off, 1σ as a factor; 1: it is exact, nothing is learned");
  v.number("slip_factor_std", slip_factor_std, {1.0, 100.0}, "the same for slip and side slip");
  v.number("imu_factor_std", imu_factor_std, {1.0, 100.0},
           "how much noisier than its data sheet the IMU is assumed to be in motion, as a factor on the standard "
           "deviations, until the constraints show it; 1: the data sheet is exact, nothing is learned");
  v.number("whiteness", whiteness, {0.0, 1.0},
           "fraction of the IMU's vibration that integrates like white noise, before anything is learned");
  v.number("whiteness_factor_std", whiteness_factor_std, {1.0, 100.0}, "how far that may be off, 1σ as a factor");
}

NoiseScales::NoiseScales(const NoiseScaleParams& params) : length_m_(params.length_m) {
  prior_.setZero();
  prior_(kVibrationNoise) = std::log(std::max(params.whiteness, 1e-4));
  prior_variance_.setConstant(square(2.0 * std::log(params.factor_std)));
  for (const NoiseKind slip : {kFastSlipNoise, kSlowSlipNoise, kSideSlipNoise}) {
    prior_variance_(slip) = square(2.0 * std::log(params.slip_factor_std));
  }
  prior_variance_(kVibrationNoise) = square(2.0 * std::log(params.whiteness_factor_std));
  theta_ = prior_;
  sigma_ = prior_variance_.asDiagonal();
  refresh();
}

void NoiseScales::fade(double way_m) {
  const double decay = std::exp(-way_m / (kPriorLengths * length_m_));
  theta_ = prior_ + decay * (theta_ - prior_);
  // In steady state an innovation that θ explains alone has the gain Σ/2 = interval/length: q = 2 · interval ·
  // way/length².
  const double q = 2.0 * way_m / square(length_m_);
  for (int kind = 0; kind < kNoiseKinds; ++kind) {
    const bool by_wheels = kind == kWheelNoise || kind == kFastSlipNoise || kind == kSlowSlipNoise;
    sigma_(kind, kind) = std::min(sigma_(kind, kind) + q * (by_wheels ? kWheelInterval_m : kConstraintInterval_m),
                                  prior_variance_(kind));
  }
  refresh();
}

void NoiseScales::learn(const NoiseVector& shares, double squared, double variance) {
  if (!(variance > 0.0) || !std::isfinite(squared)) {
    return;
  }
  const NoiseVector g = shares / variance;
  const NoiseVector direction = sigma_ * g;
  const double q = g.dot(direction);
  if (!(q > 0.0)) {
    return;
  }
  theta_ += mostProbable(shares, direction, q, std::min(squared, kLargestNis * variance), variance) * direction;
  theta_ = theta_.cwiseMax(kLeastTheta).cwiseMin(largestTheta());
  sigma_ -= direction * direction.transpose() / (2.0 + q);
  refresh();
}

void NoiseScales::refresh() { factor_ = theta_.array().exp(); }

}  // namespace slipnav
