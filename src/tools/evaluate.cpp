/// Runs the pipeline on a recording and measures it against its truth.

#include <iostream>
#include <vector>

#include "config/config_options.h"
#include "core/base/atomic_file.h"
#include "evaluation/alarm_text.h"
#include "evaluation/report.h"
#include "ros/bag/bag_evaluation.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("evaluate", "Runs the pipeline on a recording, without a ROS master, and measures it.");
  command_line.positional("BAG", "recording of ROS 1")
      .repeated("part", "BAG", "further file of the same recording, as rosbag record --split leaves them")
      .option("truth", "TOPIC|FILE.pos",
              "truth: a topic of the recording or an RTKLIB solution; default: the first of "
              "truth/fix, truth/odometry, truth/pose that it has")
      .option("out", "DIR", "where metrics.json, timeline.csv, forecasts.csv, estimate.tum, truth.tum go")
      .option("odometry", "FILE", "every message of `odometry` as bytes, to compare runs with")
      .flag("smooth", "run the drive backwards too: a second row, and smoothed.csv and smoothed.tum beside the others")
      .flag("report", "plots into the same place");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

void checkArguments(const Arguments& arguments) {
  if (arguments.given("report") && !arguments.given("out")) {
    throw slipnav::UsageError("--report needs --out");
  }
}

void printFindings(const slipnav::BagEvaluation& evaluation) {
  slipnav::Alarms others = evaluation.alarms;
  for (const auto& problem : evaluation.problems) {
    others.erase(problem.first);
  }
  std::cerr << slipnav::alarmLines("evaluate: problem", evaluation.problems, evaluation.begin)
            << slipnav::alarmLines("evaluate: alarm", others, evaluation.begin);
}

/// Also a run without a start leaves behind what was wrong.
slipnav::BagEvaluation evaluated(const slipnav::Config& config, const Arguments& arguments) {
  std::vector<std::string> bags = arguments.all("part");
  bags.insert(bags.begin(), arguments.text("BAG"));
  try {
    return slipnav::evaluateBag(bags, config, arguments.text("truth"), {}, arguments.given("smooth"));
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
  const slipnav::BagEvaluation evaluation = evaluated(config, arguments);
  printFindings(evaluation);
  if (arguments.given("out")) {
    slipnav::writeRunReport(arguments.text("out"), evaluation.report);
  }
  if (arguments.given("odometry")) {
    evaluation.odometry.write(arguments.text("odometry"));
  }
  if (arguments.given("report")) {
    slipnav::plotReport(arguments.text("out"));
  }
  std::cout << slipnav::tableHeader() << slipnav::tableRows(slipnav::runName(bag), std::nullopt, evaluation.report)
            << slipnav::runName(bag) << ": " << evaluation.report.metrics.verdict << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("evaluate", std::cerr, [argc, argv] { return run(argc, argv); });
}
