/// Runs the pipeline on a recording and measures it against its truth.

#include <iostream>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/base/atomic_file.h"
#include "evaluation/alarm_text.h"
#include "evaluation/loop_closure.h"
#include "evaluation/report.h"
#include "evaluation/tum.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/bag/other_systems.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("evaluate", "Runs the pipeline on a recording, without a ROS master, and measures it.");
  command_line.positional("BAG", "ROS 1 recording")
      .repeated("part", "BAG", "another file of the same recording, as rosbag record --split leaves them")
      .option("truth", "TOPIC|FILE.pos",
              "truth: a topic of the recording or an RTKLIB solution; default: the first of "
              "truth/fix, truth/odometry, truth/pose that it has")
      .option("out", "DIR", "where metrics.json, timeline.csv, forecasts.csv, estimate.tum, truth.tum go")
      .option("odometry", "FILE", "every message of `odometry` as bytes, to compare runs with")
      .flag("smooth", "run the drive backwards too: a second row, and smoothed.csv and smoothed.tum beside the others")
      .repeated("compare", "NAME=TOPIC|NAME=FILE.tum",
                "another system's poses on the same drive: one more row, compare_NAME.csv and compare_NAME.tum")
      .flag("returns-to-start", "the drive ends where it began: without truth it is judged by that")
      .flag("report", "plots into the same place")
      .option("figure", "STOP", "the paper's figure of that stop, counted from 1, as stop_STOP.png in the same place");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

void checkArguments(const Arguments& arguments) {
  for (const char* plots : {"report", "figure"}) {
    if (arguments.given(plots) && !arguments.given("out")) {
      throw slipnav::UsageError("--" + std::string(plots) + " needs --out");
    }
  }
}

std::vector<std::string> partsOf(const Arguments& arguments) {
  std::vector<std::string> parts = arguments.all("part");
  parts.insert(parts.begin(), arguments.text("BAG"));
  return parts;
}

void printFindings(const slipnav::BagEvaluation& evaluation) {
  slipnav::Alarms others = evaluation.alarms;
  for (const auto& problem : evaluation.problems) {
    others.erase(problem.first);
  }
  std::cerr << slipnav::alarmLines("evaluate: problem", evaluation.problems, evaluation.begin)
            << slipnav::alarmLines("evaluate: alarm", others, evaluation.begin);
}

/// A run without a start also reports its problems.
slipnav::BagEvaluation evaluated(const slipnav::Config& config, const Arguments& arguments) {
  try {
    return slipnav::evaluateBag(partsOf(arguments), config, arguments.text("truth"), {}, arguments.given("smooth"));
  } catch (const slipnav::NoStart& failure) {
    printFindings(failure.evaluation());
    if (arguments.given("out")) {
      slipnav::createDirectories(arguments.text("out"));
      slipnav::writeMetricsJson(arguments.text("out") + "/metrics.json", failure.evaluation().report.metrics);
    }
    throw;
  }
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  checkArguments(arguments);
  const std::string& bag = arguments.text("BAG");
  const slipnav::Config config = slipnav::configFromOptions(arguments);
  const std::vector<slipnav::OtherSystem> others =  // before the run, so that a wrong name does not cost one
      slipnav::readOtherSystems(arguments.all("compare"), partsOf(arguments));
  slipnav::BagEvaluation evaluation = evaluated(config, arguments);
  slipnav::RunReport& report = evaluation.report;
  slipnav::addOtherSystems(others, report);
  if (arguments.given("returns-to-start")) {
    slipnav::addLoopClosure(report.estimates, config.filter.uses("zupt"), report.metrics);
  }
  printFindings(evaluation);
  if (arguments.given("out")) {
    slipnav::writeRunReport(arguments.text("out"), report);
  }
  if (arguments.given("odometry")) {
    evaluation.odometry.write(arguments.text("odometry"));
  }
  if (arguments.given("report")) {
    slipnav::plotReport(arguments.text("out"));
  }
  if (arguments.given("figure")) {
    slipnav::plotStop(arguments.text("out"), static_cast<int>(arguments.integer("figure", {1.0, 1e6})));
  }
  std::cout << slipnav::tableHeader() << slipnav::tableRows(slipnav::runName(bag), std::nullopt, report)
            << slipnav::runName(bag) << ": " << report.metrics.verdict << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("evaluate", std::cerr, [argc, argv] { return run(argc, argv); });
}
