/// Noise, delay and slip of a robot from its recordings, without truth.

#include <unistd.h>

#include <iostream>

#include "config/config.h"
#include "core/base/atomic_file.h"
#include "evaluation/progress_bar.h"
#include "ros/bag/bag_tuning.h"
#include "tuning/tuning_report.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("tune",
                           "Noise, stamp delay and slip of a robot from its recordings by maximum likelihood of the "
                           "innovations. Needs no truth and uses none.");
  command_line.positionals("BAG", "ROS 1 recordings; several give one set of values for all")
      .option("out", "YAML", "file to write when tuning is worth it, for --config after the current ones")
      .repeated("only", "KEY", "tune this parameter and no others")
      .option("ask", "N",
              "ask for runs on the standard output, N at a time, instead of making them: see tune_drives.py")
      .option("run", "RUN", "make one of these runs and print its likelihood");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

std::vector<slipnav::TuningDrive> readDrives(const std::vector<std::string>& bags, const slipnav::Config& config) {
  std::vector<slipnav::TuningDrive> drives;
  drives.reserve(bags.size());
  for (const std::string& bag : bags) {
    drives.push_back(slipnav::readTuningDrive(bag, config));
  }
  return drives;
}

/// For a tuning that runs elsewhere.
void runOne(const Arguments& arguments, const slipnav::Config& config) {
  const slipnav::TuningRun run = slipnav::runFromText(arguments.text("run"));
  const std::vector<slipnav::Knob> knobs = slipnav::tuningKnobs(config, arguments.all("only"));
  const std::vector<std::string>& bags = arguments.all("BAG");
  if (run.drive >= bags.size() || run.position.size() != static_cast<Eigen::Index>(knobs.size())) {
    throw slipnav::UsageError("--run does not fit the other arguments");
  }
  const slipnav::TuningDrive drive = slipnav::readTuningDrive(bags[run.drive], config);
  std::cout << slipnav::likelihoodText(
                   slipnav::likelihoodOf(drive, slipnav::withKnobs(drive.config, knobs, run.position), run.stretches))
            << "\n";
}

slipnav::TuningRuns runsFor(const Arguments& arguments, slipnav::RunExchange& exchange) {
  slipnav::TuningRuns runs;
  if (arguments.given("ask")) {
    runs.slots = static_cast<std::size_t>(arguments.integer("ask", {1.0, 1e4}));
    runs.elsewhere = [&exchange](const slipnav::TuningRun& run) { return exchange.ask(run); };
  }
  return runs;
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  const slipnav::Config config = slipnav::configFromOptions(arguments);
  if (arguments.given("run")) {
    runOne(arguments, config);
    return 0;
  }
  slipnav::RunExchange exchange(std::cin, std::cout);
  slipnav::ProgressBar bar("tune", std::cerr, isatty(STDERR_FILENO) != 0);
  const slipnav::TuningResult result = slipnav::tune(
      slipnav::tuningKnobs(config, arguments.all("only")), readDrives(arguments.all("BAG"), config),
      [&bar](const slipnav::TuningProgress& progress) {
        bar.show(progress.runs, progress.expected, std::to_string(progress.runs) + " runs");
      },
      runsFor(arguments, exchange));
  bar.finish();
  std::cout << slipnav::tuningTable(config, result);
  if (!result.worthwhile) {
    std::cout << (arguments.given("out") ? "nothing is written to " + arguments.text("out") + "\n" : "");
    return 0;
  }
  const std::string yaml = slipnav::tuningYaml(config, result);
  std::cout << "\n" << yaml;
  if (arguments.given("out")) {
    slipnav::AtomicFile file(arguments.text("out"));
    file.stream() << yaml;
    file.commit();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("tune", std::cerr, [argc, argv] { return run(argc, argv); });
}
