/// Drives a simulated rover in closed loop with a stop policy and measures its navigation.

#include <chrono>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <optional>

#include "config/command_line.h"
#include "config/config.h"
#include "core/base/atomic_file.h"
#include "evaluation/simulated_run.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/bag/bag_writer.h"
#include "ros/runtime/child_process.h"
#include "simulation/world_files.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;
using slipnav::Config;

/// Location of worlds and grades: installed, or in the source tree.
std::string configurationFolder(const std::string& kind) {
  const std::filesystem::path installed = slipnav::packageExecutable("../../share/slipnav/config");
  const std::filesystem::path folder =
      std::filesystem::is_directory(installed / kind) ? installed : std::filesystem::path(SLIPNAV_CONFIG_DIR);
  return (folder / kind).string();
}

CommandLine commandLine() {
  CommandLine command_line("simulate", "Drives a simulated rover in closed loop and measures its navigation.");
  command_line
      .option("world", "NAME", "ground, body, sensors and operator of config/worlds; 'list' names them; see --grade")
      .option("grade", "NAME", "the IMU and its data sheet: one of config/grades; 'list' names them")
      .choice("terrain", {"paved", "unpaved", "gravel", "rough", "rocking"}, "the ground", "rough")
      .option("distance", "M", "meters to drive after the initialization", "150")
      .option("seed", "N", "seed of terrain, slip and sensor errors", "1")
      .option("policy", "P", "when to stop: none, periodic:EVERY_S:HOLD_S, autonomous", "periodic:12:3")
      .option("threshold", "M", "error bound at which autonomous stops come; forecast.threshold_m")
      .option("out", "DIR", "where metrics.json, timeline.csv, forecasts.csv, estimate.tum, truth.tum go")
      .option("figures", "FILE",
              "metrics and simulation figures as one JSON object; without --out no baselines are run")
      .option("bag", "FILE", "record the sensors and the truth, as a robot would")
      .flag("smooth", "run the drive backwards too: a second row, and smoothed.csv and smoothed.tum beside the others")
      .flag("report", "plots into the output directory");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

Config configuration(const Arguments& arguments) {
  if (arguments.given("report") && !arguments.given("out")) {
    throw slipnav::UsageError("--report needs --out");
  }
  std::vector<std::string> files;
  for (const char* kind : {"grade", "world"}) {
    if (arguments.given(kind)) {
      const std::string folder = configurationFolder(std::string(kind) + "s");
      files.push_back(slipnav::sim::configurationNamed(arguments.text(kind), folder, kind));
    }
  }
  Config config = slipnav::configFromOptions(arguments, files);
  const bool has_world = arguments.given("world");
  if (!has_world || arguments.given("terrain")) {
    config.simulator.terrain = arguments.text("terrain");
  }
  if (!has_world || arguments.given("distance")) {
    config.simulator.drive.distance_m = arguments.number("distance", {1.0, 1e6});
  }
  if (arguments.given("threshold")) {
    config.forecast.threshold_m = arguments.number("threshold", {1e-3, 1e4});
  }
  config.simulator.seed = arguments.integer("seed", {0.0, 1e9});
  return config;
}

/// Drives, navigates and records; returns the report.
slipnav::SimulationReport drive(const Config& config, slipnav::StopPolicy& policy, const std::string& bag,
                                bool with_baselines, bool smooth) {
  if (bag.empty()) {
    return slipnav::simulateAndMeasure(config, policy, {}, with_baselines, smooth);
  }
  slipnav::BagWriter recorder(bag, config);
  const slipnav::SimulationReport report = slipnav::simulateAndMeasure(
      config, policy,
      [&recorder](const slipnav::sim::Measurements& measurements, const slipnav::sim::TruthState& truth) {
        recorder.write(measurements, truth);
      },
      with_baselines, smooth);
  recorder.close();
  return report;
}

/// Prints the names if requested. @return whether they were
bool listNames(const Arguments& arguments) {
  bool listed = false;
  for (const char* kind : {"world", "grade"}) {
    if (arguments.given(kind) && arguments.text(kind) == "list") {
      for (const std::string& name : slipnav::sim::configurationsIn(configurationFolder(std::string(kind) + "s"))) {
        std::cout << name << '\n';
      }
      listed = true;
    }
  }
  return listed;
}

void writeFiles(const Arguments& arguments, const slipnav::SimulationReport& report) {
  if (arguments.given("out")) {
    slipnav::writeRunReport(arguments.text("out"), report.run);
    slipnav::AtomicFile file((std::filesystem::path(arguments.text("out")) / "simulation.json").string());
    file.stream() << slipnav::figuresJson(report.figures);
    file.commit();
  }
  if (arguments.given("figures")) {
    slipnav::AtomicFile file(arguments.text("figures"));
    file.stream() << "{\"metrics\": " << slipnav::metricsJson(report.run.metrics, report.run.smoothedMetrics())
                  << ", \"simulation\": " << slipnav::figuresJson(report.figures) << "}\n";
    file.commit();
  }
  if (arguments.given("report")) {
    slipnav::plotReport(arguments.text("out"));
  }
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  if (listNames(arguments)) {
    return 0;
  }
  const Config config = configuration(arguments);
  const std::unique_ptr<slipnav::StopPolicy> policy = slipnav::makeStopPolicy(arguments.text("policy"), config.stop);
  const std::clock_t cpu = std::clock();
  const auto wall = std::chrono::steady_clock::now();
  const bool autonomous = arguments.text("policy") == "autonomous";
  const bool with_baselines = autonomous || arguments.given("out") || !arguments.given("figures");
  slipnav::SimulationReport report =
      drive(config, *policy, arguments.text("bag"), with_baselines, arguments.given("smooth"));
  slipnav::Metrics& metrics = report.run.metrics;
  metrics.cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  metrics.realtime_factor =
      metrics.duration_s / std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  writeFiles(arguments, report);
  const std::string name =
      arguments.text(arguments.given("world") ? "world" : "terrain") + " " + arguments.text("seed");
  std::cout << slipnav::tableHeader()
            << slipnav::tableRows(name, autonomous ? std::optional(config.forecast.threshold_m) : std::nullopt,
                                  report.run);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("simulate", std::cerr, [argc, argv] { return run(argc, argv); });
}
