#include "ros/messages/stop_outputs.h"

#include <boost/make_shared.hpp>

#include <algorithm>
#include <vector>

#include "ros/messages/stop_messages.h"
#include "ros/runtime/topic_graph.h"

namespace slipnav {
namespace {

/// Subscribers that may act on what they hear.
std::vector<std::string> actors(const std::string& topic) {
  std::vector<std::string> nodes = endsOf(topic).subscribers;
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), isRecorder), nodes.end());
  return nodes;
}

/// If the master does not answer, a connection counts.
std::size_t countOf(bool connected, const std::string& topic) {
  if (!connected) {
    return 0;
  }
  const TopicEnds ends = endsOf(topic);
  return ends.subscribers.empty() ? 1 : actors(topic).size();
}

std::string inWords(const std::string& topic) {
  const std::string names = topic.empty() ? "" : joined(actors(topic));
  return names.empty() ? "nobody" : names;
}

}  // namespace

void StopOutputs::advertise(ros::NodeHandle& node, const TopicNames& topics) {
  countdown_publisher_ = SharedPublisher<std_msgs::Float64>(node, topics.stop_cmd);
  lock_publisher_ = SharedPublisher<std_msgs::Bool>(node, topics.e_stop, true);
  lock_topic_ = node.resolveName(topics.e_stop);
}

void StopOutputs::advertiseCommands(ros::NodeHandle& node, const TopicNames& topics) {
  command_publisher_ = SharedPublisher<geometry_msgs::Twist>(node, topics.cmd_vel);
  command_topic_ = node.resolveName(topics.cmd_vel);
}

void StopOutputs::command(const VelocityCommand& command) const {
  command_publisher_.publish(boost::make_shared<geometry_msgs::Twist>(toTwist(command)));
}

void StopOutputs::countDown(double seconds) const {
  const auto message = boost::make_shared<std_msgs::Float64>();
  message->data = seconds;
  countdown_publisher_.publish(message);
}

void StopOutputs::lock(bool locked) const {
  const auto message = boost::make_shared<std_msgs::Bool>();
  message->data = locked ? 1 : 0;
  lock_publisher_.publish(message);
}

StopListeners StopOutputs::listeners() const {
  return {countOf(command_publisher_.hasSubscribers(), command_topic_),
          countOf(lock_publisher_.hasSubscribers(), lock_topic_)};
}

std::string StopOutputs::listenersInWords() const {
  return "cmd_vel is heard by " + inWords(command_topic_) + ", e_stop by " + inWords(lock_topic_);
}

}  // namespace slipnav
