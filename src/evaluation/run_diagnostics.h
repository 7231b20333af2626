#pragma once
/// Data of a run besides its estimate: biases, innovations, baselines, slip forecasts. For plots.
///
/// Written next to the files of report.h. `t` is in UNIX seconds, `nan` means unknown.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/estimate.h"
#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/truth_track.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {

/// The filter at the end of one wheel interval. Axes forward-left-up.
struct FilterRow {
  Nanoseconds stamp = 0;
  double wheel_speed_mps = 0.0;  ///< forward speed by the wheels, mean over the interval
  Vector3 accel_bias_flu_mps2 = Vector3::Zero();
  Vector3 accel_sigma_mps2 = Vector3::Zero();
  Vector3 gyro_bias_flu_radps = Vector3::Zero();
  Vector3 gyro_sigma_radps = Vector3::Zero();
  /// Normalized innovation squared over its degrees of freedom; none if the component was not measured.
  std::array<std::optional<double>, kComponents> nis = {};
};

/// One moment of one slip forecast.
struct SlipForecastRow {
  Nanoseconds stamp = 0;   ///< when the forecast was made
  double horizon_s = 0.0;  ///< ahead of that
  double mean = 0.0;       ///< of the latent slip ratio
  double stddev = 0.0;
  std::array<double, 3> wheel_speed_mps = {};  ///< of the sigma points, that of the mean first
};

/// The rows of all files of one run.
struct RunDiagnostics {
  std::vector<FilterRow> filter;
  PlanarTrack wheel_only;
  std::vector<SlipForecastRow> slip_forecasts;
};

/// Collects one row per wheel interval.
class FilterRecorder {
 public:
  void clear() { *this = FilterRecorder(); }
  /// Call for every estimate, right after `filter` has made it.
  void add(const Estimate& estimate, const ErrorCovariance& P, const FilterEngine& filter);
  const std::vector<FilterRow>& rows() const { return rows_; }

 private:
  std::array<std::uint64_t, kComponents> measured_ = {};
  std::vector<FilterRow> rows_;
};

/// The kind of measurement that contradicts its predictions most.
struct LargestNis {
  std::string of;     ///< componentName()
  double mean = 0.0;  ///< of the normalized innovations squared over their degrees of freedom; 1 is exact
};

/// Over the kinds that were measured often enough; each innovation counts for a hundred at most.
std::optional<LargestNis> largestNis(const std::vector<FilterRow>& rows);

/// `filter.csv`: t, wheel_speed, accel_bias_x…z, accel_sigma_x…z, gyro_bias_x…z, gyro_sigma_x…z (SI), and nis_ followed
/// by each componentName().
void writeFilterCsv(const std::string& path, const std::vector<FilterRow>& rows);
/// `wheel_track.csv`: t, east, north.
void writeWheelTrackCsv(const std::string& path, const PlanarTrack& track);
/// `slip_forecasts.csv`: t, horizon_s, mean, stddev, wheel_speed, wheel_speed_above, wheel_speed_below: of the sigma
/// points [m/s].
void writeSlipForecastsCsv(const std::string& path, const std::vector<SlipForecastRow>& rows);
/// `nees.csv`: t, nees, truth_sigma_e, truth_sigma_n, truth_sigma_u. Of the position, eᵀ(P + R)⁻¹e with three degrees
/// of freedom and R of truth, at its epochs; and the roots of R's diagonal, 0 if truth has no covariance.
void writeNeesCsv(const std::string& path, const EstimateTrack& estimates, const TruthTrack& truth);

}  // namespace slipnav
