/// Plays a recording through the running nodelets and measures their estimate against the recording's truth. The node
/// behind replay.launch.

#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <iostream>

#include "config/command_line.h"
#include "evaluation/report.h"
#include "evaluation/track_comparison.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/bag/other_systems.h"
#include "ros/replay/replay_session.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/parameters.h"
#include "ros/runtime/ros_arguments.h"
#include "ros/rviz/compared_tracks.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;
using slipnav::Range;

CommandLine commandLine() {
  CommandLine command_line("replay", "Plays a recording through the running nodelets and measures their estimate.");
  command_line.positional("BAG", "ROS 1 recording")
      .option("rate", "FACTOR", "how fast to play", "1")
      .option("start", "S", "seconds from the beginning of the recording", "0")
      .option("duration", "S", "seconds to play, 0 for all", "0")
      .option("truth", "TOPIC|FILE.pos", "truth: a topic of the recording or an RTKLIB solution")
      .option("out", "DIR", "where metrics.json and the other results go")
      .option("odometry", "FILE", "every message of `odometry` as bytes, to compare runs with")
      .repeated("compare", "NAME=TOPIC|NAME=FILE.tum", "another system's poses on the same drive, also shown in rviz")
      .option("folder", "DIR", "where relative paths of --compare begin", ".")
      .option("tree", "NAME", "parameter tree of the configuration", "slipnav")
      .flag("report", "plots into the same place");
  return command_line;
}

slipnav::ReplayOptions optionsOf(const Arguments& arguments) {
  slipnav::ReplayOptions options;
  options.bag = arguments.text("BAG");
  options.rate = arguments.number("rate", Range{1e-3, 1e3});
  options.start_s = arguments.number("start", Range{0.0, 1e9});
  options.duration_s = arguments.number("duration", Range{0.0, 1e9});
  return options;
}

/// Latched: rviz may come later.
ros::Publisher showCompared(const std::vector<slipnav::OtherSystem>& systems, const slipnav::RunReport& report,
                            const slipnav::Config& config) {
  slipnav::RunReport compared = report;
  slipnav::addOtherSystems(systems, compared);
  ros::Publisher publisher =
      ros::NodeHandle().advertise<visualization_msgs::MarkerArray>(slipnav::kComparedTopic, 1, true);
  publisher.publish(slipnav::comparedTracks(compared.others, config.frames.map));
  return publisher;
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = slipnav::parseWithoutRosArguments(command_line, argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  ros::init(argc, argv, "replay");
  const slipnav::Config config = slipnav::configFromParameters(ros::NodeHandle(), arguments.text("tree"));
  const slipnav::ReplayOptions options = optionsOf(arguments);
  const std::vector<slipnav::OtherSystem> systems =
      slipnav::readOtherSystems(arguments.all("compare"), {options.bag}, arguments.text("folder"));
  const slipnav::BagEvaluation offline =
      slipnav::evaluateBag(options.bag, config, arguments.text("truth"), {options.start_s, options.duration_s});
  const ros::Publisher compared = showCompared(systems, offline.report, config);
  slipnav::ReplaySession session(config.topics);
  session.waitForNodelets();
  const ros::SteadyTime begin = ros::SteadyTime::now();
  session.play(options, offline.report.estimates.back().stamp);
  const double wall_s = (ros::SteadyTime::now() - begin).toSec();

  slipnav::RunReport report = slipnav::withEstimates(offline.report, session.recorder().track(), wall_s);
  slipnav::addOtherSystems(systems, report);
  if (arguments.given("out")) {
    slipnav::writeRunReport(arguments.text("out"), report);
  }
  if (arguments.given("out") && arguments.given("report")) {
    slipnav::plotReport(arguments.text("out"));
  }
  if (arguments.given("odometry")) {
    session.odometry().write(arguments.text("odometry"));
  }
  std::cout << slipnav::comparisonText("replay", report.estimates, offline.report.estimates) << slipnav::tableHeader()
            << slipnav::tableRows(slipnav::runName(options.bag), std::nullopt, report) << std::flush;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("replay", std::cerr, [argc, argv] { return run(argc, argv); });
}
