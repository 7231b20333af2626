#include "evaluation/metrics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/base/statistics.h"
#include "evaluation/verdict.h"
#include "io/bracket.h"

namespace slipnav {
namespace {

/// Estimate minus truth at one truth epoch, and the covariance of the estimate.
struct ErrorEpoch {
  Vector3 error_enu_m;
  Matrix3 covariance_enu_m2;
};

void requireOrdered(const EstimateTrack& estimates) {
  if (estimates.empty()) {
    throw std::invalid_argument("metrics: no estimate");
  }
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    if (estimates[i].stamp <= estimates[i - 1].stamp) {
      throw std::invalid_argument("metrics: estimate at " + std::to_string(estimates[i].stamp) +
                                  " ns is not later than the one before it");
    }
  }
}

std::vector<ErrorEpoch> errorEpochs(const MetricsInput& input, const MetricsOptions& options) {
  std::vector<ErrorEpoch> epochs;
  for (const TruthSample& truth : input.truth.samples()) {
    const auto estimate = interpolate(input.estimates, truth.stamp, input.truth.maxGap());
    if (!estimate) {
      continue;
    }
    Matrix3 covariance = estimate->covariance_enu_m2;
    if (options.add_truth_covariance) {
      covariance += truth.covariance_enu_m2;
    }
    epochs.push_back({estimate->position_enu_m - truth.position_enu_m, covariance});
  }
  return epochs;
}

std::vector<double> components(const std::vector<ErrorEpoch>& epochs, int axis) {
  std::vector<double> values;
  values.reserve(epochs.size());
  for (const ErrorEpoch& epoch : epochs) {
    values.push_back(epoch.error_enu_m[axis]);
  }
  return values;
}

std::vector<double> horizontalErrors(const std::vector<ErrorEpoch>& epochs) {
  std::vector<double> values;
  values.reserve(epochs.size());
  for (const ErrorEpoch& epoch : epochs) {
    values.push_back(epoch.error_enu_m.head<2>().norm());
  }
  return values;
}

std::optional<double> meanNees(const std::vector<ErrorEpoch>& epochs) {
  std::vector<double> nees;
  for (const ErrorEpoch& epoch : epochs) {
    const Eigen::LLT<Matrix3> factor(epoch.covariance_enu_m2);
    if (factor.info() == Eigen::Success) {
      nees.push_back(epoch.error_enu_m.dot(factor.solve(epoch.error_enu_m)) / 3.0);
    }
  }
  return nees.empty() ? std::nullopt : std::optional<double>(mean(nees));
}

double coverage3SigmaPct(const std::vector<ErrorEpoch>& epochs) {
  std::size_t covered = 0;
  for (const ErrorEpoch& epoch : epochs) {
    for (int axis = 0; axis < 3; ++axis) {
      const double sigma_m = std::sqrt(std::max(epoch.covariance_enu_m2(axis, axis), 0.0));
      covered += std::abs(epoch.error_enu_m[axis]) <= 3.0 * sigma_m ? 1 : 0;
    }
  }
  return 100.0 * static_cast<double>(covered) / static_cast<double>(3 * epochs.size());
}

void fillErrors(const std::vector<ErrorEpoch>& epochs, Metrics& metrics) {
  if (epochs.empty()) {
    return;
  }
  const std::vector<double> horizontal_m = horizontalErrors(epochs);
  metrics.horizontal_median_m = median(horizontal_m);
  metrics.horizontal_std_m = standardDeviation(horizontal_m);
  metrics.horizontal_max_m = *std::max_element(horizontal_m.begin(), horizontal_m.end());
  metrics.horizontal_final_m = horizontal_m.back();
  const Vector3 rms_enu_m(rootMeanSquare(components(epochs, 0)), rootMeanSquare(components(epochs, 1)),
                          rootMeanSquare(components(epochs, 2)));
  metrics.rms_east_m = rms_enu_m.x();
  metrics.rms_north_m = rms_enu_m.y();
  metrics.rms_up_m = rms_enu_m.z();
  metrics.position_nees_mean = meanNees(epochs);
  metrics.coverage_3sigma_pct = coverage3SigmaPct(epochs);
  if (metrics.distance_m.value_or(0.0) > 0.0) {
    metrics.enu_error_pct = enuErrorPct(rms_enu_m, *metrics.distance_m);
    metrics.median_error_pct = 100.0 * *metrics.horizontal_median_m / *metrics.distance_m;
    metrics.final_pct = 100.0 * *metrics.horizontal_final_m / *metrics.distance_m;
  }
}

/// Horizontal error [m] of the baseline at the last truth epoch that it covers.
std::optional<double> finalError(const PlanarTrack& track, const TruthTrack& truth) {
  for (auto sample = truth.samples().rbegin(); sample != truth.samples().rend(); ++sample) {
    if (const auto bracket = findBracket(track, sample->stamp, truth.maxGap())) {
      const PlanarSample& from = track[bracket->before];
      const PlanarSample& to = track[bracket->after];
      const Vector2 position_m =
          blend<Vector2>({from.east_m, from.north_m}, {to.east_m, to.north_m}, bracket->fraction);
      return (position_m - sample->position_enu_m.head<2>()).norm();
    }
  }
  return std::nullopt;
}

void fillMotion(const MetricsInput& input, const MetricsOptions& options, Metrics& metrics) {
  const Nanoseconds first = input.estimates.front().stamp;
  const Nanoseconds last = input.estimates.back().stamp;
  metrics.duration_s = toSeconds(last - first);
  if (!input.truth.empty()) {
    metrics.distance_m = distanceDriven(input.truth, first, last, options.distance);
  }
  double stopped_s = 0.0;
  for (const Stop& stop : findStops(input.estimates)) {
    ++metrics.stop_count;
    stopped_s += toSeconds(stop.end - stop.begin);
  }
  if (metrics.duration_s > 0.0) {
    metrics.stop_rate_pct = stopRatePct(stopped_s, metrics.duration_s);
  }
}

void fillCounters(const RunCounters& counters, Metrics& metrics) {
  metrics.imu_samples = counters.imu_samples;
  metrics.wheel_samples = counters.wheel_samples;
  metrics.rejected_samples = counters.rejected_samples;
  metrics.forecasts = counters.forecasts;
  if (!counters.forecast_ms.empty()) {
    metrics.forecast_ms_p50 = percentile(counters.forecast_ms, 50.0);
    metrics.forecast_ms_p99 = percentile(counters.forecast_ms, 99.0);
  }
  metrics.cpu_s = counters.cpu_s;
  metrics.realtime_factor = counters.realtime_factor;
}

}  // namespace

double enuErrorPct(const Vector3& rms_enu_m, double distance_m) { return 100.0 * rms_enu_m.norm() / distance_m; }

double stopRatePct(double stopped_s, double duration_s) { return 100.0 * stopped_s / duration_s; }

Metrics computeMetrics(const MetricsInput& input, const MetricsOptions& options) {
  requireOrdered(input.estimates);
  Metrics metrics;
  fillMotion(input, options, metrics);
  fillErrors(errorEpochs(input, options), metrics);
  const auto wheel_only_m = finalError(input.wheel_only, input.truth);
  if (wheel_only_m && metrics.distance_m.value_or(0.0) > 0.0) {
    metrics.wheel_only_error_pct = 100.0 * *wheel_only_m / *metrics.distance_m;
  }
  metrics.no_zupt_error_pct = input.no_zupt_error_pct;
  fillCounters(input.counters, metrics);
  metrics.truth_left_out = input.truth_left_out;
  metrics.stops_seen = input.stops.seen;
  metrics.stops_used = input.stops.used;
  if (input.largest_nis) {
    metrics.largest_nis = input.largest_nis->mean;
    metrics.largest_nis_of = input.largest_nis->of;
  }
  metrics.verdict = verdictOf(metrics, input.uses_stops);
  return metrics;
}

}  // namespace slipnav
