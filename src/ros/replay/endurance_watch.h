#pragma once
/// Monitors hours of driving in progress: the nodelets' memory, the latency of estimates, and whether
/// their covariance is right.

#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/endurance.h"
#include "ros/replay/drive_evaluator.h"
#include "ros/replay/latency_meter.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {

/// Keeps a row for every minute of the drive, and nothing else.
class EnduranceWatch : public DriveEvaluator {
 public:
  /// @param hours from the first estimate on, after which it has seen enough
  /// @param folder for soak.csv, which grows with the drive, and soak.txt, the verdict
  /// @param memory_kb returns the resident memory of the nodelets' process
  EnduranceWatch(const Planet& planet, double hours, const std::string& folder, std::function<double()> memory_kb);

  void add(const sim::Measurements& measurements, const sim::TruthState& truth) override;
  void add(const nav_msgs::Odometry& message) override;
  void add(const StopStatus& message) override { stops_ = static_cast<int>(message.stops); }
  void add(const Initialization& message) override;

  Nanoseconds newestStamp() const override { return newest_.stamp; }
  bool hasSeenEnough() const override { return !rows_.empty() && rows_.back().driven_h >= hours_; }
  /// Writes soak.txt. @return the same: figures beside their limits
  std::string verdict() override;

 private:
  void addRow(const EstimateTrack& around, const TruthSample& truth);

  Planet planet_;
  double hours_;
  std::string folder_;
  std::function<double()> memory_kb_;
  std::ofstream csv_;
  std::optional<LocalFrame> frame_;
  Arrivals published_;     ///< IMU samples
  Nanoseconds first_ = 0;  ///< estimate
  double begun_s_ = 0.0;   ///< when that arrived
  EstimateSample newest_;
  double longest_gap_s_ = 0.0;  ///< between estimates
  Nanoseconds next_row_ = 0;
  std::optional<TruthSample> truth_;  ///< of the next row, until its estimate arrives
  std::vector<double> latencies_ms_;  ///< since the last row
  int stops_ = 0;
  std::vector<EnduranceRow> rows_;
};

}  // namespace slipnav
