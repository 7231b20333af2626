#include "ros/messages/stop_messages.h"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <vector>

#include "ros/messages/conversions.h"
#include "ros/runtime/topic_graph.h"

namespace slipnav {
namespace {

Vector3 vectorOf(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

geometry_msgs::Vector3 toVectorMessage(const Vector3& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

std::uint8_t toMessage(StopState state) {
  switch (state) {
    case StopState::kDriving:
      return StopStatus::DRIVING;
    case StopState::kCountingDown:
      return StopStatus::COUNTING_DOWN;
    case StopState::kStopping:
      return StopStatus::STOPPING;
    case StopState::kHolding:
      break;
  }
  return StopStatus::HOLDING;
}

std::uint8_t toMessage(StopMode mode) {
  return mode == StopMode::kActive   ? StopStatus::MODE_ACTIVE
         : mode == StopMode::kAdvise ? StopStatus::MODE_ADVISE
                                     : StopStatus::MODE_OFF;
}

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

VelocityCommand toVelocityCommand(const geometry_msgs::Twist& message) {
  return {vectorOf(message.linear), vectorOf(message.angular)};
}

geometry_msgs::Twist toTwist(const VelocityCommand& command) {
  geometry_msgs::Twist message;
  message.linear = toVectorMessage(command.linear_mps);
  message.angular = toVectorMessage(command.angular_radps);
  return message;
}

void fill(const SupervisorStatus& status, StopMode mode, const FrameNames& frames, StopStatus& message) {
  message.header.stamp = toRosTime(status.stamp);
  message.header.frame_id = frames.base;
  message.state = toMessage(status.state);
  message.mode = toMessage(mode);
  message.time_left_s = status.time_left_s;
  message.stops = status.stops;
  message.refusals = status.refusals;
  message.overridden = status.overridden;
  message.emergency_stop = status.emergency_stop;
  message.forecasts_stale = status.forecasts_stale;
  message.reason = status.reason;
}

void RoverObserver::add(const Slip& message) {
  const auto at_rest = [this](double speed_mps) { return std::abs(speed_mps) <= wheel_speed_at_rest_mps_; };
  const auto& speeds = message.wheel_speed_mps;
  forward_mps_ = message.forward_speed_mps;
  wheels_at_rest_ = !speeds.empty() && std::all_of(speeds.begin(), speeds.end(), at_rest);
  has_wheels_ = true;
}

RoverObservation RoverObserver::observe(const NavState& message) {
  constexpr std::size_t kRow = kNavStates + 1;  // from one diagonal element to the next
  constexpr std::size_t kFirst = kVelocity * kRow;
  const auto& P = message.covariance;
  RoverObservation observation;
  observation.stamp = toNanoseconds(message.header.stamp);
  observation.forward_mps = forward_mps_;
  observation.speed_std_mps = std::sqrt((P[kFirst] + P[kFirst + kRow] + P[kFirst + 2 * kRow]) / 3.0);
  observation.stationary = message.status == NavState::STATUS_STATIONARY;
  observation.has_wheels = has_wheels_;
  observation.wheels_at_rest = wheels_at_rest_;
  has_wheels_ = false;
  return observation;
}

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
