#pragma once
/// Navigates and measures a simulated drive in progress.

#include <variant>
#include <vector>

#include "evaluation/offline_run.h"
#include "evaluation/simulated_drive.h"
#include "evaluation/simulated_judge.h"

namespace slipnav {

/// Feeds the intervals of a simulated drive to an OfflineRun; truth for the metrics are the simulated fixes.
class SimulatedRun {
 public:
  /// @param with_baselines also without zero updates, and with forecasts
  explicit SimulatedRun(const Config& config, bool with_baselines = true);

  /// Smooths the drive when it is over; call before the first interval.
  void smoothAfterwards() { run_.smoothAfterwards(); }

  /// Receives every estimate as soon as there is one.
  void onEstimate(FilterEngine::EstimateSink sink) { on_estimate_ = std::move(sink); }

  /// Receives each forecast, after its estimate.
  void onForecast(ForecastRecorder::Sink sink) { run_.onForecast(std::move(sink)); }

  /// One interval of the drive.
  void add(const sim::Measurements& measurements, const sim::TruthState& truth);

  /// Throws std::runtime_error if the initialization never finished, saying what it was waiting for.
  RunReport finish();

  /// After finish().
  SimulationFigures figures() const;

  // For pushMeasurements(): a late stamp may arrive after one measured later.
  void push(const AntennaFix& fix) { enqueue(stampOf(fix), fix); }
  void push(const WheelMotion& wheels) { enqueue(wheels.stamp, wheels); }
  void push(const ImuSample& sample) { enqueue(sample.stamp, sample); }

 private:
  using Sample = std::variant<AntennaFix, WheelMotion, ImuSample>;
  struct Stamped {
    Nanoseconds stamp;
    Sample sample;
  };
  void enqueue(Nanoseconds stamp, const Sample& sample);
  void release(Nanoseconds until);

  Planet planet_;
  WheelGeometry geometry_;
  Vector3 imu_position_b_;
  double initial_straight_m_;
  bool exact_stamps_;
  Nanoseconds earliest_stamp_;  ///< how much a stamp may be before the instant
  OfflineRun run_;
  SimulatedJudge judge_;
  FilterEngine::EstimateSink on_estimate_;
  std::vector<Stamped> waiting_;  ///< in order of stamp
};

/// Result of a simulated drive.
struct SimulationReport {
  RunReport run;
  SimulationFigures figures;
};

/// Drives with a policy that gets the estimates as they come, from start to end.
/// @param recorder additional work for each interval
/// @param with_baselines see SimulatedRun; forecasts come only with them
/// @param smooth also run it backwards
SimulationReport simulateAndMeasure(const Config& config, StopPolicy& policy, const DriveSink& recorder = {},
                                    bool with_baselines = true, bool smooth = false);

}  // namespace slipnav
