#pragma once
/// The figures used to judge a drive: those of the paper's Tables I and II, consistency, and cost.
///
/// Errors are estimate minus truth in east, north, up at the truth epochs, the estimate interpolated to them.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/motion.h"
#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/run_diagnostics.h"
#include "evaluation/stop_ledger.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/types.h"
#include "slipnav/core/navigation/health.h"

namespace slipnav {

/// Counts and measurements of the run about itself.
struct RunCounters {
  std::int64_t imu_samples = 0;
  std::int64_t wheel_samples = 0;
  std::int64_t rejected_samples = 0;
  std::int64_t forecasts = 0;
  std::vector<double> forecast_ms;        ///< computing time of each forecast
  std::optional<double> cpu_s;            ///< processor time of the run
  std::optional<double> realtime_factor;  ///< recorded time over wall time
};

/// Input for judging one drive.
struct MetricsInput {
  EstimateTrack estimates;  ///< without the initialization phase
  TruthTrack truth;         ///< may be empty
  PlanarTrack wheel_only;   ///< the baseline; may be empty
  std::optional<double> no_zupt_error_pct;
  StopCounts stops;
  std::optional<LargestNis> largest_nis;
  std::int64_t truth_left_out = 0;  ///< rows of truth that are not in `truth`
  bool uses_stops = true;           ///< zero-velocity updates are part of the run
  RunCounters counters;
};

/// How it is judged.
struct MetricsOptions {
  DistanceOptions distance;
  /// Judge the errors by P + R, with R the truth's own covariance, instead of P alone: the reference
  /// is a measurement, too.
  bool add_truth_covariance = true;
};

/// Names equal the keys of `metrics.json`. Empty if a figure cannot be computed, such as errors without truth.
struct Metrics {
  /// D, along truth, over the epochs of the estimate; without truth that of addLoopClosure()
  std::optional<double> distance_m;
  double duration_s = 0.0;                    ///< T, first to last epoch of the estimate
  std::int64_t stop_count = 0;                ///< see findStops()
  std::optional<double> stop_rate_pct;        ///< 100·(time in stops)/T
  std::optional<double> enu_error_pct;        ///< 100·√(RMS_E² + RMS_N² + RMS_U²)/D
  std::optional<double> median_error_pct;     ///< 100·(median horizontal error)/D
  std::optional<double> horizontal_median_m;  ///< of √(e_E² + e_N²); so are the three below
  std::optional<double> horizontal_std_m;     ///< divisor n
  std::optional<double> horizontal_max_m;
  std::optional<double> horizontal_final_m;  ///< at the last truth epoch that the estimate covers
  std::optional<double> rms_east_m;
  std::optional<double> rms_north_m;
  std::optional<double> rms_up_m;
  /// Mean of eᵀP⁻¹e/3 over the epochs whose 3×3 position covariance P is positive definite; 1 if P is honest.
  std::optional<double> position_nees_mean;
  /// Share of the single components e_i, three per epoch, with |e_i| ≤ 3σ_i; 99.73 if errors are Gaussian and P
  /// honest.
  std::optional<double> coverage_3sigma_pct;
  /// 100·(horizontal error of the baseline at the last truth epoch that it covers)/D
  std::optional<double> wheel_only_error_pct;
  std::optional<double> no_zupt_error_pct;  ///< enu_error_pct of the same pipeline without zero-velocity updates
  std::int64_t imu_samples = 0;
  std::int64_t wheel_samples = 0;
  std::int64_t rejected_samples = 0;
  std::int64_t forecasts = 0;
  std::optional<double> forecast_ms_p50;
  std::optional<double> forecast_ms_p99;
  std::optional<double> cpu_s;
  std::optional<double> realtime_factor;
  std::int64_t truth_left_out = 0;    ///< rows of truth far off their neighbors, see withoutJumps()
  std::optional<double> final_pct;    ///< 100·horizontal_final_m/D
  std::int64_t stops_seen = 0;        ///< standstills by wheels and IMU, see StopLedger
  std::int64_t stops_used = 0;        ///< of these, with an accepted zero-velocity update
  std::optional<double> largest_nis;  ///< see largestNis()
  std::string largest_nis_of;         ///< the kind of measurement
  std::optional<double> threshold_m;  ///< ε as configured, of a run that forecasts
  /// Horizontal distance between the first and the last estimate, of a drive that returns to its start; so are those
  /// below.
  std::optional<double> closure_m;
  std::optional<double> closure_up_m;      ///< last minus first height
  std::optional<double> closure_pct;       ///< 100·closure_m/D
  std::optional<double> closure_3sigma_m;  ///< growth of the 3σ ellipse since the start, its longer half axis
  std::int64_t forecasts_judged = 0;       ///< whose horizon has come without a stop, see judgeForecasts()
  std::optional<double> forecast_horizon_s;
  std::optional<double> forecast_bound_m;       ///< at the horizon, mean
  std::optional<double> forecast_growth_rms_m;  ///< of the error; a bound of 3σ should be three times that
  std::optional<double> forecast_below_pct;     ///< share of the forecasts whose bound held
  std::string verdict;                          ///< see verdictOf()
  Alarms problems;                              ///< of the recording: unusable messages, and the like
  Alarms alarms;                                ///< everything reported by the monitoring of sensors and filter
};

/// Throws std::invalid_argument if the estimate is empty or not in order of stamp.
Metrics computeMetrics(const MetricsInput& input, const MetricsOptions& options = {});

/// 100·‖RMS error‖/D: the paper's ENU error.
double enuErrorPct(const Vector3& rms_enu_m, double distance_m);

/// 100·(time in stops)/T: the paper's stop rate S_R.
double stopRatePct(double stopped_s, double duration_s);

}  // namespace slipnav
