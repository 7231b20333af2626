#pragma once
/// Navigates and measures a simulated drive while it goes on.

#include "slipnav/eval/offline_run.h"
#include "slipnav/eval/simulated_drive.h"

namespace slipnav {

/// Feeds the intervals of a simulated drive to an OfflineRun; truth for the metrics are the simulated fixes.
class SimulatedRun {
 public:
  explicit SimulatedRun(const Config& config);

  /// Who is to have every estimate, as soon as there is one.
  void onEstimate(FilterEngine::EstimateSink sink) { run_.onEstimate(std::move(sink)); }

  /// Who is to have each forecast, after its estimate.
  void onForecast(ForecastRecorder::Sink sink) { run_.onForecast(std::move(sink)); }

  /// One interval of the drive.
  void add(const sim::Measurements& measurements, const sim::TruthState& truth);

  /// Throws std::runtime_error when the initialisation never ended, saying what it was waiting for.
  RunReport finish() const { return run_.finish({}); }

 private:
  Planet planet_;
  WheelGeometry geometry_;
  Vector3 imu_position_b_;
  double initial_straight_m_;
  OfflineRun run_;
};

/// Drives with a policy that is given the estimates as they come, from begin to end.
/// @param recorder what else is to be done with each interval
RunReport simulateAndMeasure(const Config& config, StopPolicy& policy, const DriveSink& recorder = {});

}  // namespace slipnav
