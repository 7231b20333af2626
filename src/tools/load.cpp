/// Plays a recording through the running nodelets and measures the cost: CPU, memory, and the latency of
/// estimates, seen from outside; and how fast a recording may be played.

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/command_line.h"
#include "core/base/statistics.h"
#include "core/base/text.h"
#include "evaluation/limit_table.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/messages/conversions.h"
#include "ros/replay/node_process.h"
#include "ros/replay/replay_session.h"
#include "ros/runtime/parameters.h"
#include "ros/runtime/ros_arguments.h"

namespace {

using slipnav::Arguments;
using slipnav::CommandLine;
using slipnav::Nanoseconds;
using slipnav::ProcessUsage;
using slipnav::Range;

constexpr double kMostCpu_pct = 2.0;  // of a core
constexpr double kMostMemory_mb = 60.0;
constexpr double kMostLatency_ms = 2.0;
constexpr double kLeastRate = 50.0;
constexpr double kSettling_s = 10.0;  // of estimates, before the figures count
constexpr double kMargin_s = 1.0;     // of recording, after the last required estimate
/// The last one is far beyond any machine: rosbag play then runs as fast as the nodelets accept it.
constexpr double kRates[] = {50.0, 100.0, 1000.0};

CommandLine commandLine() {
  CommandLine command_line("load", "Plays a recording through the running nodelets and measures the cost.");
  command_line.positional("BAG", "ROS 1 recording")
      .option("seconds", "S", "how long to watch in real time", "60")
      .option("out", "FILE", "file to write the table to as well")
      .option("manager", "NODE", "the nodelets' manager", "slipnav_manager")
      .option("tree", "NAME", "parameter tree of the configuration", "slipnav");
  return command_line;
}

/// When each message arrived, by its stamp.
using Arrivals = std::map<Nanoseconds, double>;

/// Listens alongside the nodelets.
class Probe {
 public:
  explicit Probe(const slipnav::TopicNames& topics) {
    listen<sensor_msgs::Imu>(topics.imu, [this](Nanoseconds stamp) { imu_.emplace(stamp, now()); });
    listen<nav_msgs::Odometry>(topics.odometry, [this](Nanoseconds stamp) { onEstimate(stamp); });
  }

  /// Discards earlier arrivals, and skips estimates before `stamp`; the first one after it calls `begin`.
  void watchFrom(Nanoseconds stamp, const std::function<void()>& begin) {
    imu_.clear();
    estimates_.clear();
    first_ = stamp;
    begin_ = begin;
  }

  /// From each IMU sample to its estimate [ms], which may overtake it on the way here.
  std::vector<double> latencies() const {
    std::vector<double> times_ms;
    for (const auto& [stamp, time_s] : estimates_) {
      const auto sample = imu_.find(stamp);
      if (sample != imu_.end()) {
        times_ms.push_back(1e3 * std::max(0.0, time_s - sample->second));
      }
    }
    return times_ms;
  }

  /// From the first estimate to the last [s], in real time and in the recording.
  double watched_s() const {
    return estimates_.empty() ? 0.0 : estimates_.rbegin()->second - estimates_.begin()->second;
  }
  double recorded_s() const {
    return estimates_.empty() ? 0.0 : slipnav::toSeconds(estimates_.rbegin()->first - estimates_.begin()->first);
  }

  /// How many of these estimates have not arrived.
  std::size_t missing(const slipnav::EstimateTrack& expected) const {
    return static_cast<std::size_t>(std::count_if(
        expected.begin(), expected.end(),
        [this](const slipnav::EstimateSample& estimate) { return estimates_.count(estimate.stamp) == 0; }));
  }

 private:
  static double now() { return ros::SteadyTime::now().toSec(); }

  template <class Message>
  void listen(const std::string& topic, const std::function<void(Nanoseconds)>& note) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [note](const boost::shared_ptr<const Message>& message) {
          note(slipnav::toNanoseconds(message->header.stamp));
        };
    subscribers_.push_back(
        node_.subscribe<Message>(topic, 0, callback, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }

  void onEstimate(Nanoseconds stamp) {
    if (stamp < first_) {
      return;
    }
    if (begin_) {
      std::exchange(begin_, nullptr)();
    }
    estimates_.emplace(stamp, now());
  }

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  Arrivals imu_;
  Arrivals estimates_;
  Nanoseconds first_ = 0;
  std::function<void()> begin_;
};

/// Plays a recording at different rates and measures.
class Load {
 public:
  Load(const Arguments& arguments, const slipnav::Config& config)
      : bag_(arguments.text("BAG")),
        manager_(ros::names::resolve(arguments.text("manager"))),
        seconds_(arguments.number("seconds", Range{1.0, 1e5})),
        offline_(slipnav::evaluateBag(bag_, config, "", {})),
        session_(config.topics, slipnav::ReplaySession::Outputs::kOdometry),
        probe_(config.topics) {
    session_.waitForNodelets();
  }

  std::string run() {
    watchInRealTime();
    double highest = 0.0;
    for (const double rate : kRates) {
      highest = std::max(highest, playAt(rate));
    }
    table_.addAtLeast("highest playback rate without a lost message", highest, kLeastRate);
    return table_.text();
  }

 private:
  void watchInRealTime() {
    const rosbag::Bag bag(bag_);
    const Nanoseconds begin = slipnav::toNanoseconds(rosbag::View(bag).getBeginTime());
    const Nanoseconds settled = offline_.report.estimates.front().stamp + slipnav::fromSeconds(kSettling_s);
    const Nanoseconds last = std::min(settled + slipnav::fromSeconds(seconds_), offline_.report.estimates.back().stamp);
    const pid_t process = slipnav::pidOf(manager_);
    ProcessUsage before;
    probe_.watchFrom(settled, [&] { before = slipnav::usageOf(process); });
    session_.play({bag_, 1.0, 0.0, slipnav::toSeconds(last - begin) + kMargin_s}, last);
    const ProcessUsage after = slipnav::usageOf(process);
    const std::vector<double> latencies = probe_.latencies();
    if (latencies.empty()) {
      throw std::runtime_error("no estimate came while the recording was played in real time");
    }
    table_.add("watched in real time [s]", probe_.watched_s());
    table_.addAtMost("CPU of the manager [% of a core]", 100.0 * (after.cpu_s - before.cpu_s) / probe_.watched_s(),
                     kMostCpu_pct);
    table_.addAtMost("memory of the manager, resident [MB]", after.memory_mb, kMostMemory_mb);
    table_.add("IMU sample to its odometry, p50 [ms]", slipnav::percentile(latencies, 50.0));
    table_.addAtMost("IMU sample to its odometry, p99 [ms]", slipnav::percentile(latencies, 99.0), kMostLatency_ms);
    table_.add("IMU sample to its odometry, longest [ms]", slipnav::percentile(latencies, 100.0));
  }

  /// @return the rate that was reached, 0 if something was lost
  double playAt(double rate) {
    probe_.watchFrom(0, [] {});
    session_.play({bag_, rate, 0.0, 0.0}, offline_.report.estimates.back().stamp);
    const std::size_t missing = probe_.missing(offline_.report.estimates);
    const double reached = probe_.watched_s() > 0.0 ? probe_.recorded_s() / probe_.watched_s() : 0.0;
    table_.add("played at " + slipnav::formatNumber(rate) + ": times real time", reached);
    table_.add("played at " + slipnav::formatNumber(rate) + ": estimates lost", static_cast<double>(missing));
    return missing == 0 ? reached : 0.0;
  }

  std::string bag_;
  std::string manager_;
  double seconds_;
  slipnav::BagEvaluation offline_;
  slipnav::ReplaySession session_;
  Probe probe_;
  slipnav::LimitTable table_;
};

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) {
    throw std::runtime_error("cannot write '" + path + "'");
  }
}

int run(int argc, char** argv) {
  const CommandLine command_line = commandLine();
  const Arguments arguments = slipnav::parseWithoutRosArguments(command_line, argc, argv);
  if (arguments.helpRequested()) {
    std::cout << command_line.help();
    return 0;
  }
  ros::init(argc, argv, "load");
  const std::string table =
      Load(arguments, slipnav::configFromParameters(ros::NodeHandle(), arguments.text("tree"))).run();
  std::cout << table << std::flush;
  if (arguments.given("out")) {
    write(arguments.text("out"), table);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return slipnav::runGuarded("load", std::cerr, [argc, argv] { return run(argc, argv); });
}
