/// Estimates wheel radii, scrub factor and the mounting of the IMU from a recording with truth.

#include <iostream>

#include "calibration/calibration_report.h"
#include "config/config.h"
#include "core/base/atomic_file.h"
#include "ros/bag/bag_calibration.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("calibrate",
                           "Estimates wheel radii, scrub factor and IMU mounting from a recording with truth.");
  command_line.positional("BAG", "ROS 1 recording")
      .option("truth", "TOPIC|FILE.pos",
              "truth: a topic of the recording or an RTKLIB solution; default: the first of "
              "truth/fix, truth/odometry, truth/pose that it has")
      .option("start", "S", "seconds from the beginning of the recording", "0")
      .option("duration", "S", "seconds to use, 0 for all", "0")
      .option("out", "YAML", "file to write, for --config of the other commands");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  const slipnav::BagRange range{arguments.number("start", {0.0, 1e9}), arguments.number("duration", {0.0, 1e9})};
  const slipnav::BagCalibration calibration = slipnav::calibrateBag(
      arguments.text("BAG"), slipnav::configFromOptions(arguments), arguments.text("truth"), range);
  const std::string yaml = slipnav::calibrationYaml(calibration.config, calibration.result);
  std::cout << slipnav::calibrationTable(calibration.config, calibration.result) << "\n" << yaml;
  if (arguments.given("out")) {
    slipnav::AtomicFile file(arguments.text("out"));
    file.stream() << yaml;
    file.commit();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("calibrate", std::cerr, [argc, argv] { return run(argc, argv); });
}
