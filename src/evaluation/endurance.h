#pragma once
/// Hours of driving, evaluated as they happen: one row is kept per minute, whatever happened in it.

#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/truth_track.h"

namespace slipnav {

/// How far an estimate is from the truth, and its covariance.
struct PositionError {
  double horizontal_m = 0.0;
  double horizontal_3sigma_m = 0.0;  ///< in the direction of the error
  double nees = 0.0;  ///< eᵀ(P + R)⁻¹e/3 of all three components, R being the truth's own covariance
};

/// For equal stamps.
PositionError positionError(const EstimateSample& estimate, const TruthSample& truth);

/// One moment of the drive, and the latencies since the previous row.
struct EnduranceRow {
  double wall_s = 0.0;          ///< real time since the first estimate
  double driven_h = 0.0;        ///< since the first estimate, by the stamps
  double rss_kb = 0.0;          ///< resident memory of the nodelets' process
  double latency_p50_ms = 0.0;  ///< from an IMU sample to its estimate
  double latency_p99_ms = 0.0;
  PositionError error;
  int stops = 0;  ///< so far
};

/// A line each, with a newline.
std::string enduranceCsvHeader();
std::string enduranceCsv(const EnduranceRow& row);

/// The part of a drive in which buffers reach their size [h].
inline constexpr double kEnduranceSettling_h = 1.0 / 6.0;

/// The median over the rows of the first hour after the settling time, and of the last hour. Halves of the rest if
/// that is shorter than two hours.
struct Trend {
  double first = 0.0;
  double last = 0.0;
};

/// What the rows have shown.
struct EnduranceFigures {
  double memory_growth_mb = 0.0;  ///< from the end of the settling time to the last row
  Trend latency_p50_ms;
  Trend latency_p99_ms;
  double covered_pct = 0.0;  ///< rows whose horizontal error is within 3 sigma
  double nees_mean = 0.0;    ///< 1 when the covariance is honest
};

/// Throws std::invalid_argument if fewer than two rows come after the settling time.
EnduranceFigures enduranceFigures(const std::vector<EnduranceRow>& rows);

}  // namespace slipnav
