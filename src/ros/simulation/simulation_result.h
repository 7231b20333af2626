#pragma once
/// The result of a simulated drive through the nodelets, compared with the offline pipeline.

#include <string>

#include "evaluation/simulated_run.h"
#include "ros/replay/drive_evaluator.h"
#include "ros/replay/estimate_recorder.h"

namespace slipnav {

/// Keeps the whole drive.
class SimulationResult : public DriveEvaluator {
 public:
  /// @param folder for the files of writeRunReport(); empty: none
  /// @param plots into that folder
  /// @param autonomous the supervisor stops the rover, at the configured threshold
  SimulationResult(const Config& config, const std::string& folder, bool plots, bool autonomous);

  void add(const sim::Measurements& measurements, const sim::TruthState& truth) override;
  void add(const nav_msgs::Odometry& message) override { recorder_.add(message); }
  void add(const NavState& message) override { recorder_.add(message); }
  void add(const Slip& message) override { recorder_.add(message); }

  Nanoseconds newestStamp() const override { return recorder_.newestStamp(); }
  /// Writes the files. @return the comparison with the offline pipeline and the table row
  std::string verdict() override;

 private:
  Config config_;
  std::string folder_;
  bool plots_;
  bool autonomous_;
  SimulatedRun offline_;
  EstimateRecorder recorder_;
  double begun_s_ = 0.0;
};

}  // namespace slipnav
