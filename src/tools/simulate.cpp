/// Drives a simulated rover in closed loop with a stop policy and measures its navigation.

#include <chrono>
#include <ctime>
#include <iostream>
#include <optional>

#include "slipnav/config/command_line.h"
#include "slipnav/config/config_options.h"
#include "slipnav/eval/simulated_run.h"
#include "slipnav/ros/bag_evaluation.h"
#include "slipnav/ros/bag_writer.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;
using slipnav::Config;

CommandLine commandLine() {
  CommandLine command_line("simulate", "Drives a simulated rover in closed loop and measures its navigation.");
  command_line.choice("terrain", {"paved", "unpaved", "gravel", "rough", "rocking"}, "the ground", "rough")
      .option("distance", "M", "metres to drive after the initialisation", "150")
      .option("seed", "N", "makes terrain, slip and sensor errors", "1")
      .option("policy", "P", "when to stop: none, periodic:EVERY_S:HOLD_S, autonomous", "periodic:12:3")
      .option("threshold", "M", "error bound at which autonomous stops come; forecast.threshold_m")
      .option("out", "DIR", "where metrics.json, timeline.csv, forecasts.csv, estimate.tum, truth.tum go")
      .option("bag", "FILE", "record the sensors and the truth, as a robot would")
      .flag("report", "plots into the output directory");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

Config configuration(const Arguments& arguments) {
  if (arguments.given("report") && !arguments.given("out")) {
    throw slipnav::UsageError("--report needs --out");
  }
  Config config = slipnav::configFromOptions(arguments);
  config.simulator.terrain = arguments.text("terrain");
  config.simulator.drive.distance_m = arguments.number("distance", {1.0, 1e6});
  if (arguments.given("threshold")) {
    config.forecast.threshold_m = arguments.number("threshold", {1e-3, 1e4});
  }
  config.simulator.seed = arguments.integer("seed", {0.0, 1e9});
  return config;
}

/// Drives, navigates and records; returns what there is to say about it.
slipnav::RunReport drive(const Config& config, slipnav::StopPolicy& policy, const std::string& bag) {
  if (bag.empty()) {
    return slipnav::simulateAndMeasure(config, policy);
  }
  slipnav::BagWriter recorder(bag, config);
  const slipnav::RunReport report = slipnav::simulateAndMeasure(
      config, policy,
      [&recorder](const slipnav::sim::Measurements& measurements, const slipnav::sim::TruthState& truth) {
        recorder.write(measurements, truth);
      });
  recorder.close();
  return report;
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  const Config config = configuration(arguments);
  const std::unique_ptr<slipnav::StopPolicy> policy = slipnav::makeStopPolicy(arguments.text("policy"), config.stop);
  const std::clock_t cpu = std::clock();
  const auto wall = std::chrono::steady_clock::now();
  slipnav::RunReport report = drive(config, *policy, arguments.text("bag"));
  report.metrics.cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  report.metrics.realtime_factor =
      report.metrics.duration_s / std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  if (arguments.given("out")) {
    slipnav::writeRunReport(arguments.text("out"), report);
  }
  if (arguments.given("report")) {
    slipnav::plotReport(arguments.text("out"));
  }
  const std::string name = arguments.text("terrain") + " " + arguments.text("seed");
  const bool autonomous = arguments.text("policy") == "autonomous";
  std::cout << slipnav::tableHeader()
            << slipnav::tableRow(name, autonomous ? std::optional(config.forecast.threshold_m) : std::nullopt,
                                 report.metrics);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("simulate", std::cerr, [argc, argv] { return run(argc, argv); });
}
