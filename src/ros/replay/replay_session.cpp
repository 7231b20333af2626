#include "ros/replay/replay_session.h"

#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <variant>

#include "config/parameter_list.h"
#include "config/sensor_topics.h"
#include "core/base/text.h"
#include "ros/bag/bag_file.h"
#include "ros/messages/conversions.h"
#include "ros/runtime/child_process.h"
#include "ros/runtime/internal_topics.h"

namespace slipnav {
namespace {

constexpr double kStartTimeout_s = 60.0;
constexpr double kSilence_s = 60.0;  // on a busy machine
constexpr double kStragglers_s = 0.5;
const ros::WallDuration kPollInterval(0.02);

/// Serves callbacks until `done`; @return false if the time limit, if any, has passed without it.
template <class Done>
bool spinUntil(Done done, std::optional<double> timeout_s) {
  const ros::SteadyTime begin = ros::SteadyTime::now();
  while (!done()) {
    if (!ros::ok()) {
      throw std::runtime_error("ROS was shut down");
    }
    if (timeout_s && (ros::SteadyTime::now() - begin).toSec() > *timeout_s) {
      return false;
    }
    ros::getGlobalCallbackQueue()->callAvailable(kPollInterval);
  }
  return true;
}

/// Topics that have at least one node of the given kind (0: publishers, 1: subscribers), as the master knows them.
std::set<std::string> topicsWith(int kind) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  std::set<std::string> topics;
  if (ros::master::execute("getSystemState", request, response, payload, false)) {
    XmlRpc::XmlRpcValue entries = payload[kind];
    for (int i = 0; i < entries.size(); ++i) {
      topics.insert(static_cast<std::string>(entries[i][0]));
    }
  }
  return topics;
}

std::set<std::string> recordedTopics(const std::string& path) {
  const BagFile bag(path);
  std::set<std::string> topics;
  for (const auto& [id, connection] : bag.connections()) {
    topics.insert(connection.topic);
  }
  return topics;
}

/// What a recording must not publish while the nodelets run: their own outputs, commands, time and transforms of
/// moving frames. As full names.
std::set<std::string> outputTopics(const TopicNames& topics) {
  std::set<std::string> outputs = topicsWith(0);
  const std::vector<std::string> sensors = sensorTopics(topics);
  for (const ParameterInfo& topic : listParameters(topics)) {
    const std::string& name = std::get<std::string>(topic.value);
    if (std::find(sensors.begin(), sensors.end(), name) == sensors.end()) {
      outputs.insert(ros::names::resolve(name));
    }
  }
  outputs.insert({"/clock", "/tf"});
  outputs.erase("/tf_static");  // sensor poses
  return outputs;
}

/// Topics with subscribers, less the outputs, as full names.
std::set<std::string> wantedTopics(const TopicNames& topics) {
  const std::set<std::string> heard = topicsWith(1);
  const std::set<std::string> outputs = outputTopics(topics);
  std::set<std::string> wanted;
  std::set_difference(heard.begin(), heard.end(), outputs.begin(), outputs.end(), std::inserter(wanted, wanted.end()));
  return wanted;
}

/// @param wanted full names of the topics to be played
std::vector<std::string> playCommand(const ReplayOptions& options, const std::set<std::string>& wanted) {
  std::vector<std::string> command = {"rosbag",
                                      "play",
                                      "--quiet",
                                      "--clock",
                                      "--keep-alive",
                                      "--wait-for-subscribers",
                                      "--queue=1000000",
                                      "--rate=" + formatNumber(options.rate),
                                      "--start=" + formatNumber(options.start_s)};
  if (options.duration_s > 0.0) {
    command.push_back("--duration=" + formatNumber(options.duration_s));
  }
  command.insert(command.end(), {options.bag, "--topics"});
  for (const std::string& topic : recordedTopics(options.bag)) {
    if (wanted.count(ros::names::resolve(topic)) > 0 || wanted.count("/" + topic) > 0) {
      command.push_back(topic);
    }
  }
  return command;
}

}  // namespace

ReplaySession::ReplaySession(const TopicNames& topics, Outputs outputs) : topics_(topics), outputs_(outputs) {
  const auto listen = [this](const std::string& topic, auto handler) {
    subscribers_.push_back(node_.subscribe(topic, 0, handler, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  };
  listen(topics.odometry, boost::function<void(const nav_msgs::Odometry::ConstPtr&)>(
                              [this](const nav_msgs::Odometry::ConstPtr& message) {
                                recorder_.add(*message);
                                odometry_.add(*message);
                              }));
  if (outputs == Outputs::kOdometry) {
    return;
  }
  listen(topics.nav_state, boost::function<void(const NavState::ConstPtr&)>(
                               [this](const NavState::ConstPtr& message) { recorder_.add(*message); }));
  listen(topics.slip, boost::function<void(const Slip::ConstPtr&)>(
                          [this](const Slip::ConstPtr& message) { recorder_.add(*message); }));
}

void ReplaySession::waitForNodelets() {
  // Each nodelet advertises its internal topic after it has subscribed to everything else.
  std::string missing;
  const auto all_there = [this, &missing] {
    const std::set<std::string> published = topicsWith(0);
    missing.clear();
    for (const char* topic : {kInsStepsTopic, kCorrectionTopic, kInitialStateTopic}) {
      const std::string name = node_.resolveName(topic);
      if (published.count(name) == 0) {
        missing += " " + name;
      }
    }
    return missing.empty();
  };
  if (!spinUntil(all_there, kStartTimeout_s)) {
    throw std::runtime_error("the nodelets do not start, nobody publishes" + missing);
  }
  const auto connected = [this] {
    return std::all_of(subscribers_.begin(), subscribers_.end(),
                       [](const ros::Subscriber& subscriber) { return subscriber.getNumPublishers() > 0; });
  };
  if (!spinUntil(connected, kStartTimeout_s)) {
    throw std::runtime_error("the outputs of the nodelets cannot be subscribed to");
  }
}

void ReplaySession::play(const ReplayOptions& options, Nanoseconds last_stamp) {
  play(options, [this, last_stamp] { return newestStamp() >= last_stamp; });
}

void ReplaySession::play(const ReplayOptions& options, const std::function<bool()>& done) {
  recorder_ = EstimateRecorder();  // else the previous track would pass for this one until its first estimate arrives
  odometry_ = OdometryLog();
  ros::Time clock;
  const boost::function<void(const rosgraph_msgs::Clock::ConstPtr&)> note =
      [&clock](const rosgraph_msgs::Clock::ConstPtr& message) { clock = message->clock; };
  const ros::Subscriber listener = node_.subscribe<rosgraph_msgs::Clock>("/clock", 1, note);
  ChildProcess player(playCommand(options, wantedTopics(topics_)));
  const auto has_ended = [&player, &done] {
    if (player.poll()) {
      throw std::runtime_error("rosbag play has failed");
    }
    return done();
  };
  const ros::Time end = toRosTime(BagFile(options.bag).entries().back().time);
  std::size_t estimates = 0;
  ros::Time clock_before;
  do {
    estimates = recorder_.size();
    clock_before = clock;
  } while (!spinUntil(has_ended, kSilence_s) &&
           (recorder_.size() != estimates || (clock != clock_before && clock < end)));
  // The slip of the last wheel sample was published before, but takes its own route.
  spinUntil([] { return false; }, kStragglers_s);
}

}  // namespace slipnav
