/// Injects faults into a simulated drive, singly and in random pairs, and prints their effect on the estimate.

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <optional>
#include <random>

#include "config/config.h"
#include "core/base/atomic_file.h"
#include "evaluation/simulated_drive.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/bag/bag_writer.h"
#include "ros/bag/fault_injection.h"
#include "ros/messages/conversions.h"

namespace {

using slipnav::Alarms;
using slipnav::Arguments;
using slipnav::BagEvaluation;
using slipnav::CommandLine;
using slipnav::Config;
using slipnav::Fault;

constexpr double kWorseFactor = 2.0;
constexpr double kLeastError_m = 0.1;  // smaller errors are not worth comparing

CommandLine commandLine() {
  CommandLine command_line("faults", "Injects faults into a simulated drive and prints their effect on the estimate.");
  command_line.option("distance", "M", "meters to drive after the initialization", "100")
      .option("seed", "N", "seed of the drive and of the choice of pairs", "1")
      .option("pairs", "N", "how many random pairs of faults to try as well", "20")
      .option("only", "TEXT", "only faults with this in their name")
      .option("out", "DIR", "where the recordings go", "out/faults");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

void simulate(const Config& config, const std::string& bag) {
  slipnav::BagWriter writer(bag, config);
  slipnav::PeriodicStops stops(12.0, 3.0);
  slipnav::simulateDrive(config.simulator, slipnav::Planet::byName(config.planet), stops,
                         [&writer](const slipnav::sim::Measurements& measurements,
                                   const slipnav::sim::TruthState& truth) { writer.write(measurements, truth); });
  writer.close();
}

/// Result of one run.
struct Outcome {
  bool survived = false;  ///< it ended with finite estimates
  std::string failure;
  double final_error_m = 0.0;
  bool covered = false;  ///< 3σ of each axis covers the final error
  Alarms alarms;
};

Outcome outcomeOf(const std::string& bag, const Config& config) {
  Outcome outcome;
  try {
    const BagEvaluation evaluation = slipnav::evaluateBag(bag, config, config.topics.truth_fix, {});
    const slipnav::RunReport& report = evaluation.report;
    outcome.alarms = evaluation.alarms;
    outcome.survived = std::all_of(report.estimates.begin(), report.estimates.end(), [](const auto& estimate) {
      return estimate.position_enu_m.allFinite() && estimate.covariance_enu_m2.allFinite();
    });
    const slipnav::EstimateSample& last = report.estimates.back();
    for (const slipnav::TruthSample& truth : report.truth.samples()) {
      if (truth.stamp <= last.stamp) {
        const auto estimate = slipnav::interpolate(report.estimates, truth.stamp, 1.0);
        if (!estimate) {
          continue;
        }
        const slipnav::Vector3 error = estimate->position_enu_m - truth.position_enu_m;
        outcome.final_error_m = error.head<2>().norm();
        const slipnav::Matrix3 covariance = estimate->covariance_enu_m2 + truth.covariance_enu_m2;
        outcome.covered = (error.array().abs() <= 3.0 * covariance.diagonal().array().sqrt()).all();
      }
    }
  } catch (const std::runtime_error& error) {
    outcome.failure = error.what();
  }
  return outcome;
}

/// The first alarm that the undisturbed run does not have.
std::optional<std::pair<std::string, slipnav::Alarm>> firstNewAlarm(const Alarms& alarms, const Alarms& usual) {
  std::optional<std::pair<std::string, slipnav::Alarm>> first;
  for (const auto& [name, alarm] : alarms) {
    if (usual.count(name) == 0 && (!first || alarm.first < first->second.first)) {
      first.emplace(name, alarm);
    }
  }
  return first;
}

class Campaign {
 public:
  Campaign(const Config& config, std::string directory) : config_(config), directory_(std::move(directory)) {
    slipnav::createDirectories(directory_);
    const std::string bag = directory_ + "/undisturbed.bag";
    simulate(config_, bag);
    recording_ = slipnav::readRecording(bag);
    const double drive_s = (recording_.back().time - recording_.front().time).toSec();
    times_.drive = recording_.front().time + ros::Duration(0.5 * drive_s);
    times_.initialization = recording_.front().time + ros::Duration(config.simulator.drive.initial_rest_s + 2.0);
    undisturbed_ = outcomeOf(bag, config_);
    std::cout << std::left << std::setw(70) << "fault" << std::setw(10) << "survived" << std::setw(12) << "after s"
              << std::setw(9) << "final m" << std::setw(9) << "3 sigma"
              << "detected as\n";
    print("none", undisturbed_, times_.drive, false);
  }

  /// @return whether the promises held
  bool run(const std::vector<const Fault*>& faults) {
    slipnav::Recording recording = recording_;
    std::string name;
    bool early = false;
    for (const Fault* fault : faults) {
      fault->inject(recording, times_);
      name += (name.empty() ? "" : " + ") + fault->name;
      early = early || fault->at_initialization;
    }
    const std::string bag = directory_ + "/disturbed.bag";
    slipnav::writeRecording(bag, recording);
    const Outcome outcome = outcomeOf(bag, config_);
    return print(name, outcome, early ? times_.initialization : times_.drive, true);
  }

 private:
  bool print(const std::string& name, const Outcome& outcome, const ros::Time& begin, bool has_faults) const {
    const slipnav::Nanoseconds begin_ns = slipnav::toNanoseconds(begin);
    const auto alarm = firstNewAlarm(outcome.alarms, undisturbed_.alarms);
    const bool small = outcome.final_error_m <= std::max(kWorseFactor * undisturbed_.final_error_m, kLeastError_m);
    const bool kept = outcome.survived && (small || outcome.covered) && (alarm || !has_faults);
    std::cout << std::left << std::fixed << std::setprecision(2) << std::setw(70) << name << std::setw(10)
              << (outcome.survived ? "yes" : "no");
    if (alarm) {
      std::cout << std::setw(12) << slipnav::toSeconds(alarm->second.first - begin_ns);
    } else {
      std::cout << std::setw(12) << "-";
    }
    std::cout << std::setw(9) << outcome.final_error_m << std::setw(9) << (outcome.covered ? "covers" : "no")
              << (alarm ? alarm->first : outcome.failure) << (kept ? "" : "  <-- NOT AS PROMISED") << std::endl;
    return kept;
  }

  Config config_;
  std::string directory_;
  slipnav::Recording recording_;
  slipnav::FaultTimes times_;
  Outcome undisturbed_;
};

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  Config config = slipnav::configFromOptions(arguments);
  config.simulator.drive.distance_m = arguments.number("distance", {10.0, 1e5});
  config.simulator.seed = arguments.integer("seed", {0.0, 1e9});
  Campaign campaign(config, arguments.text("out"));
  const std::vector<Fault> faults = slipnav::allFaults(config);
  int broken = 0;
  std::vector<const Fault*> chosen;
  for (const Fault& fault : faults) {
    if (fault.name.find(arguments.text("only")) != std::string::npos) {
      chosen.push_back(&fault);
      broken += campaign.run({&fault}) ? 0 : 1;
    }
  }
  std::mt19937_64 engine(static_cast<std::uint64_t>(config.simulator.seed));
  const int pairs = chosen.size() > 1 ? arguments.integer("pairs", {0.0, 1e6}) : 0;
  for (int i = 0; i < pairs; ++i) {
    std::vector<const Fault*> pair;
    std::sample(chosen.begin(), chosen.end(), std::back_inserter(pair), 2, engine);
    broken += campaign.run(pair) ? 0 : 1;
  }
  std::cout << (broken == 0 ? "everything as promised" : std::to_string(broken) + " not as promised") << "\n";
  return broken == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("faults", std::cerr, [argc, argv] { return run(argc, argv); });
}
