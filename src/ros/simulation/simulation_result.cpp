#include "ros/simulation/simulation_result.h"

#include <ros/time.h>

#include <optional>

#include "evaluation/report.h"
#include "evaluation/track_comparison.h"
#include "ros/bag/bag_evaluation.h"

namespace slipnav {

SimulationResult::SimulationResult(const Config& config, const std::string& folder, bool plots, bool autonomous)
    : config_(config), folder_(folder), plots_(plots), autonomous_(autonomous), offline_(config) {}

void SimulationResult::add(const sim::Measurements& measurements, const sim::TruthState& truth) {
  if (begun_s_ == 0.0) {
    begun_s_ = ros::SteadyTime::now().toSec();
  }
  offline_.add(measurements, truth);
}

std::string SimulationResult::verdict() {
  const RunReport offline = offline_.finish();
  const RunReport report = withEstimates(offline, recorder_.track(), ros::SteadyTime::now().toSec() - begun_s_);
  if (!folder_.empty()) {
    writeRunReport(folder_, report);
  }
  if (!folder_.empty() && plots_) {
    plotReport(folder_);
  }
  const std::string name = config_.simulator.terrain + " " + std::to_string(config_.simulator.seed);
  const std::optional<double> threshold_m =
      autonomous_ ? std::optional<double>(config_.forecast.threshold_m) : std::nullopt;
  return comparisonText("simulate", report.estimates, offline.estimates) + tableHeader() +
         tableRow(name, threshold_m, report.metrics);
}

}  // namespace slipnav
