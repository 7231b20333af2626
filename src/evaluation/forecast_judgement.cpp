#include "evaluation/forecast_judgement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// Longest time from an instant to the next estimate.
constexpr double kLongestWait_s = 0.5;

/// Horizontal errors that have grown since the last standstill.
class Growth {
 public:
  Growth(const EstimateTrack& estimates, const TruthTrack& truth) : estimates_(estimates), truth_(truth) {
    stretch_begin_.reserve(estimates.size());
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      stretch_begin_.push_back(i == 0 || estimates[i].stationary ? i : stretch_begin_.back());
    }
  }

  /// Grown until `end`, of the stretch of driving in which `begin` lies. None where it ends before, or truth is
  /// missing.
  std::optional<double> between(Nanoseconds begin, Nanoseconds end) const {
    const std::optional<std::size_t> from = indexAt(begin);
    const std::optional<std::size_t> to = indexAt(end);
    if (!from || !to || stretch_begin_[*from] != stretch_begin_[*to]) {
      return std::nullopt;
    }
    const std::optional<Vector3> before_m = errorAt(stretch_begin_[*from]);
    const std::optional<Vector3> after_m = errorAt(*to);
    return before_m && after_m ? std::optional((*after_m - *before_m).head<2>().norm()) : std::nullopt;
  }

 private:
  std::optional<std::size_t> indexAt(Nanoseconds stamp) const {
    const auto at = std::lower_bound(estimates_.begin(), estimates_.end(), stamp,
                                     [](const EstimateSample& e, Nanoseconds t) { return e.stamp < t; });
    if (at == estimates_.end() || toSeconds(at->stamp - stamp) > kLongestWait_s) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(at - estimates_.begin());
  }

  std::optional<Vector3> errorAt(std::size_t i) const {
    const std::optional<TruthSample> truth = truth_.at(estimates_[i].stamp);
    return truth ? std::optional<Vector3>(estimates_[i].position_enu_m - truth->position_enu_m) : std::nullopt;
  }

  const EstimateTrack& estimates_;
  const TruthTrack& truth_;
  std::vector<std::size_t> stretch_begin_;  ///< of each estimate: the last one at rest
};

}  // namespace

void judgeForecasts(const std::vector<ForecastRow>& forecasts, const EstimateTrack& estimates, const TruthTrack& truth,
                    Metrics& metrics) {
  const Growth growth(estimates, truth);
  double bound_sum_m = 0.0;
  double square_sum_m2 = 0.0;
  double below = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < forecasts.size(); ++i) {
    const ForecastRow& row = forecasts[i];
    const bool is_last = i + 1 == forecasts.size() || forecasts[i + 1].stamp != row.stamp;
    if (!is_last) {
      continue;
    }
    if (const std::optional<double> grown_m = growth.between(row.stamp, row.stamp + fromSeconds(row.horizon_s))) {
      metrics.forecast_horizon_s = row.horizon_s;
      bound_sum_m += row.horizontal_bound_m;
      square_sum_m2 += square(*grown_m);
      below += *grown_m <= row.horizontal_bound_m ? 1.0 : 0.0;
      count += 1.0;
    }
  }
  metrics.forecasts_judged = static_cast<std::int64_t>(count);
  if (count > 0.0) {
    metrics.forecast_bound_m = bound_sum_m / count;
    metrics.forecast_growth_rms_m = std::sqrt(square_sum_m2 / count);
    metrics.forecast_below_pct = 100.0 * below / count;
  }
}

}  // namespace slipnav
