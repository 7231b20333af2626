#pragma once
/// Files and table rows of one run.
///
/// Files are written next to their place and then moved there, so that a reader never sees half of one. Numbers are
/// written with all their digits; `nan` in a CSV file and `null` in JSON mean unknown. All functions
/// that write throw std::runtime_error naming the path that cannot be written.

#include <optional>
#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/metrics.h"
#include "evaluation/other_track.h"
#include "evaluation/run_diagnostics.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// One second of one forecast.
struct ForecastRow {
  Nanoseconds stamp = 0;                 ///< when the forecast was made
  double horizon_s = 0.0;                ///< ahead of that
  double horizontal_bound_m = 0.0;       ///< horizontal error bound then
  std::optional<double> time_to_stop_s;  ///< of the whole forecast; none if the threshold is not reached
};

/// `metrics.json`: one object, keys in the order of the struct Metrics. At its end, for a smoothed drive,
/// `smoothed`: its errors, under the same keys; and, for tracks it was compared with, `compared`: an object
/// with those of each by its name.
std::string metricsJson(const Metrics& metrics, const Metrics* smoothed = nullptr,
                        const std::vector<OtherTrack>& others = {});
void writeMetricsJson(const std::string& path, const Metrics& metrics, const Metrics* smoothed = nullptr,
                      const std::vector<OtherTrack>& others = {});

/// `timeline.csv`, `smoothed.csv`: t, est_e, est_n, est_u, sigma_e, sigma_n, sigma_u, truth_e, truth_n, truth_u, speed,
/// slip, stationary; one row per estimate, truth interpolated, t in UNIX seconds.
void writeTimelineCsv(const std::string& path, const EstimateTrack& estimates, const TruthTrack& truth);

/// `forecasts.csv`: t, horizon_s, horizontal_bound_m, time_to_stop_s.
void writeForecastsCsv(const std::string& path, const std::vector<ForecastRow>& forecasts);

/// The drive given all of its measurements, see FilterHistory; ten epochs a second.
struct SmoothedRun {
  EstimateTrack estimates;
  TruthTrack truth;  ///< aligned with these estimates, if it is aligned at all
  Metrics metrics;   ///< errors and consistency; stops are those of the filter, no counters
};

/// Everything a run leaves in its output directory.
struct RunReport {
  Metrics metrics;
  EstimateTrack estimates;
  TruthTrack truth;
  std::vector<ForecastRow> forecasts;
  RunDiagnostics diagnostics;
  std::optional<SmoothedRun> smoothed;
  std::vector<OtherTrack> others;  ///< tracks it was compared with

  /// Of `smoothed`, if present.
  const Metrics* smoothedMetrics() const { return smoothed ? &smoothed->metrics : nullptr; }
};

/// Creates the directory if it is missing and writes metrics.json, timeline.csv, forecasts.csv, estimate.tum, the
/// files of run_diagnostics.h; with truth, truth.tum; for a smoothed drive, smoothed.csv and smoothed.tum;
/// for each track it was compared with, compare_NAME.csv and compare_NAME.tum (those of an earlier run are removed
/// if this one has none).
void writeRunReport(const std::string& directory, const RunReport& report);

/// The columns of the paper's Table I, in one row of two header lines: name, Σ_D, ε, stops, Σ_T, ENU and median error,
/// horizontal error (median, standard deviation, maximum), RMS error (east, north, up). Ends with a newline.
std::string tableHeader();
/// The row under it. `-` means unknown.
std::string tableRow(const std::string& name, std::optional<double> threshold_m, const Metrics& metrics);
/// That of the run, followed by one named `(smoothed)` if it was smoothed, and one for each track it was compared
/// with.
std::string tableRows(const std::string& name, std::optional<double> threshold_m, const RunReport& report);

}  // namespace slipnav
