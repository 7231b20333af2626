#pragma once
/// A whole drive through the navigation as fast as possible, and its report.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "evaluation/alignment.h"
#include "evaluation/forecast_recorder.h"
#include "evaluation/planar_dead_reckoning.h"
#include "evaluation/report.h"
#include "evaluation/stop_ledger.h"
#include "slipnav/core/navigation/output.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav {

/// Takes samples in order of stamp, keeps the pipeline's results, and reports when the drive is over.
class OfflineRun {
 public:
  /// @param with_baselines also run the pipeline without zero updates, for no_zupt_error_pct
  OfflineRun(const Config& config, bool with_baselines);

  /// Smooths the drive when it is over; call before the first sample.
  void smoothAfterwards();

  /// Receives every estimate as soon as there is one.
  void onEstimate(FilterEngine::EstimateSink sink) { on_estimate_ = std::move(sink); }
  /// Receives each forecast, after the estimate it was made with.
  void onForecast(ForecastRecorder::Sink sink) { on_forecast_ = std::move(sink); }
  /// The same in the axes of users.
  void onOutput(std::function<void(const Output&)> sink) { on_output_ = std::move(sink); }

  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);
  void push(const AntennaFix& fix);
  void setTruth(const NavigationState& truth, bool has_attitude);

  /// Truth for metrics and plots only.
  void addTruthFix(const GnssFix& fix) { truth_fixes_.push_back(fix); }
  void addTruthPose(const TruthSample& pose) { truth_poses_.push_back(pose); }

  const Pipeline& pipeline() const { return pipeline_; }

  bool hasEstimates() const { return !estimates_.empty(); }
  /// Why there are none, in one line: what the initialization was waiting for.
  std::string failure() const { return "the initialization did not finish: " + pipeline_.initializer().progress(); }

  /// Throws std::runtime_error with failure() if there are no estimates.
  RunReport finish(const TruthAlignment& alignment) const;

 private:
  void record(const Estimate& estimate, const ErrorCovariance& P);
  void startWheelOnly(const Output& out);
  TruthTrack truthTrack(const TruthAlignment& alignment, const EstimateTrack& estimates, MetricsInput& input) const;
  EstimateTrack smoothedTrack() const;
  SmoothedRun smoothed(const TruthAlignment& alignment, const Metrics& filtered) const;

  Config config_;
  Planet planet_;
  Pipeline pipeline_;
  std::function<void(const Output&)> on_output_;
  FilterEngine::EstimateSink on_estimate_;
  ForecastRecorder::Sink on_forecast_;
  std::optional<OutputMaker> output_;
  std::shared_ptr<FilterHistory> history_;  ///< if the drive is to be smoothed
  EstimateTrack estimates_;
  FilterRecorder filter_rows_;
  StopLedger stops_;
  std::uint64_t zero_updates_ = 0;             ///< accepted by the filter so far
  std::optional<ForecastRecorder> forecasts_;  ///< not for a baseline
  std::optional<double> slip_;
  std::optional<PlanarDeadReckoning> wheel_only_;
  std::vector<ImuSample> earlier_imu_;       ///< received before the start was known
  std::vector<SpeedSample> earlier_speeds_;  ///< likewise
  std::unique_ptr<OfflineRun> without_zupt_;
  std::vector<GnssFix> truth_fixes_;
  std::vector<TruthSample> truth_poses_;
};

}  // namespace slipnav
