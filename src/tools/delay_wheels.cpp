/// Copies a recording and delays its wheel messages, each by a random time, like a busy network. Headers
/// are unchanged.

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <random>

#include "config/config.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;

CommandLine commandLine() {
  CommandLine command_line("delay_wheels", "Copies a recording and delays its wheel messages at random.");
  command_line.positional("BAG", "ROS 1 recording")
      .positional("COPY", "what to write")
      .option("most", "S", "longest delay [s]", "0.5")
      .option("duration", "S", "seconds to copy, 0 for all", "0")
      .option("seed", "N", "seed of the delays", "1");
  slipnav::declareConfigOptions(command_line);
  return command_line;
}

/// Recordings have topics with and without a leading slash.
std::string bare(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = command_line.parse(argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  if (!std::ifstream(arguments.text("BAG"))) {
    throw std::invalid_argument(arguments.text("BAG") + ": cannot be read");
  }
  rosbag::Bag source(arguments.text("BAG"));
  rosbag::Bag copy(arguments.text("COPY"), rosbag::bagmode::Write);
  const slipnav::TopicNames names = slipnav::configFromOptions(arguments).topics;
  std::mt19937_64 engine(static_cast<std::uint64_t>(arguments.integer("seed", {0.0, 1e9})));
  std::uniform_real_distribution<double> delay_s(0.0, arguments.number("most", {0.0, 60.0}));

  rosbag::View all(source);
  const double duration_s = arguments.number("duration", {0.0, 1e9});
  const ros::Time end = duration_s > 0.0 ? all.getBeginTime() + ros::Duration(duration_s) : ros::TIME_MAX;
  for (const rosbag::MessageInstance& instance : rosbag::View(source, ros::TIME_MIN, end)) {
    const std::string topic = bare(instance.getTopic());
    const bool delayed = topic == bare(names.joint_states) || topic == bare(names.wheel_odometry);
    const ros::Duration by(delayed ? delay_s(engine) : 0.0);
    copy.write(instance.getTopic(), instance.getTime() + by, instance);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("delay_wheels", std::cerr, [argc, argv] { return run(argc, argv); });
}
