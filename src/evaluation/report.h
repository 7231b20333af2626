#pragma once
/// Files and table rows of one run.
///
/// Files are written beside their place and then moved there, so that a reader never meets half of one. Numbers are
/// written with all their digits; `nan` in a CSV file and `null` in JSON stand for what is not known. All functions
/// that write throw std::runtime_error naming the path that cannot be written.

#include <optional>
#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"
#include "evaluation/run_diagnostics.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// One second of one forecast.
struct ForecastRow {
  Nanoseconds stamp = 0;                 ///< when the forecast was made
  double horizon_s = 0.0;                ///< ahead of that
  double horizontal_bound_m = 0.0;       ///< horizontal error bound then
  std::optional<double> time_to_stop_s;  ///< of the whole forecast; none when the threshold is not reached
};

/// `metrics.json`: one object, keys in the order of the struct Metrics.
std::string metricsJson(const Metrics& metrics);
void writeMetricsJson(const std::string& path, const Metrics& metrics);

/// `timeline.csv`: t, est_e, est_n, est_u, sigma_e, sigma_n, sigma_u, truth_e, truth_n, truth_u, speed, slip,
/// stationary; one row per estimate, truth interpolated, t in UNIX seconds.
void writeTimelineCsv(const std::string& path, const EstimateTrack& estimates, const TruthTrack& truth);

/// `forecasts.csv`: t, horizon_s, horizontal_bound_m, time_to_stop_s.
void writeForecastsCsv(const std::string& path, const std::vector<ForecastRow>& forecasts);

/// All that a run leaves in its output directory.
struct RunReport {
  Metrics metrics;
  EstimateTrack estimates;
  TruthTrack truth;
  std::vector<ForecastRow> forecasts;
  RunDiagnostics diagnostics;
};

/// Creates the directory where it is missing and writes metrics.json, timeline.csv, forecasts.csv, estimate.tum, the
/// files of run_diagnostics.h and, with truth, truth.tum (a truth.tum of an earlier run is removed without).
void writeRunReport(const std::string& directory, const RunReport& report);

/// The columns of the paper's Table I, in one row of two header lines: name, Σ_D, ε, stops, Σ_T, ENU and median error,
/// horizontal error (median, standard deviation, maximum), RMS error (east, north, up). Ends with a newline.
std::string tableHeader();
/// The row under it. `-` stands for what is not known.
std::string tableRow(const std::string& name, std::optional<double> threshold_m, const Metrics& metrics);

}  // namespace slipnav
