/// Checks a recording, reports what is wrong with it, and writes a configuration from what it reveals.

#include <iostream>
#include <stdexcept>

#include "config/config.h"
#include "core/base/atomic_file.h"
#include "inspection/configuration_proposal.h"
#include "inspection/inspection.h"
#include "io/rtklib_pos.h"
#include "ros/bag/bag_inspection.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("check",
                           "Checks a recording: what is wrong with it and what to do, worst first. Exit "
                           "status: 0 usable, 1 doubtful, 2 not usable.");
  command_line.positionals("BAG", "ROS 1 recording; several are parts of one drive")
      .option("truth", "TOPIC|FILE.pos", "truth: a topic of the recording or an RTKLIB solution; default: by its name")
      .option("sensor", "YAML", "data sheet of the IMU, as in config/grades; what the drive shows beyond it is written")
      .option("wheel-radius", "M", "of all wheels, if no configuration gives it", "0")
      .option("out", "YAML", "configuration to write: what the drive determines reliably, with reasons");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

bool hasConfiguration(const Arguments& arguments) {
  return arguments.given("config") || arguments.given("topic") || arguments.given("set");
}

slipnav::InspectionOptions optionsFrom(const Arguments& arguments) {
  slipnav::InspectionOptions options;
  options.truth = arguments.text("truth");
  options.wheel_radius_m = arguments.number("wheel-radius", {0.0, 10.0});
  if (arguments.given("sensor")) {
    options.sensor = slipnav::Config::load({arguments.text("sensor")}).imu.noise;
  }
  if (hasConfiguration(arguments)) {
    options.config = slipnav::configFromOptions(arguments);
  }
  return options;
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  slipnav::InspectionOptions options = optionsFrom(arguments);
  const std::vector<std::string>& paths = arguments.all("BAG");
  slipnav::Recording recording = slipnav::readRecording(paths);
  if (slipnav::isRtklibFile(options.truth)) {
    slipnav::addRtklibFile(options.truth, recording);
  }
  const slipnav::FrameNames frames = options.config ? options.config->frames : slipnav::FrameNames{};
  if (!recording.imus.empty()) {
    options.tf = slipnav::poseByTransforms(recording, frames.base, recording.imus.front().frame);
  }
  const slipnav::Inspection inspection = slipnav::inspect(recording, options);
  std::cout << slipnav::toText(inspection.findings) << "\n"
            << "topics:\n"
            << slipnav::topicTable(recording, inspection.roles);
  if (arguments.given("out")) {
    slipnav::AtomicFile file(arguments.text("out"));
    file.stream() << slipnav::proposedYaml(inspection, options, paths.front());
    file.commit();
  }
  return slipnav::statusOf(inspection.findings);
}

/// Status 1 means doubt: anything that prevents checking the recording is 2.
int runToStatus(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("check", std::cerr, [argc, argv] { return runToStatus(argc, argv); });
}
