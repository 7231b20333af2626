#include "slipnav/ros/bag_reader.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "slipnav/ros/conversions.h"
#include "slipnav/ros/extrinsics.h"
#include "slipnav/ros/wheel_input.h"

namespace slipnav {
namespace {

/// Recordings have topics with and without a leading slash.
std::string bare(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

template <class Message>
std::string typeName() {
  return ros::message_traits::datatype<Message>();
}

void open(const std::string& path, rosbag::Bag& bag) {
  if (!std::ifstream(path)) {
    throw std::invalid_argument(path + ": cannot be read");
  }
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::invalid_argument(path + ": has no index, the recording was cut off; rosbag reindex may mend it");
  } catch (const std::exception& error) {
    throw std::invalid_argument(path + ": is not a complete bag: " + error.what());
  }
}

}  // namespace

struct BagReader::Parts {
  std::string path;
  Config config;
  mutable rosbag::Bag bag;
  std::map<std::string, std::string> types;  ///< of each topic, by its bare name
  std::string truth_topic;                   ///< bare; "" when there is none
  ros::Time begin;
  ros::Time end;

  [[noreturn]] void fail(const std::string& what) const { throw std::invalid_argument(path + ": " + what); }

  std::string typeOf(const std::string& topic) const {
    const auto found = types.find(bare(topic));
    return found == types.end() ? "" : found->second;
  }

  std::string listOfTopics() const {
    std::string list;
    for (const auto& entry : types) {
      list += (list.empty() ? "" : ", ") + entry.first;
    }
    return list;
  }

  template <class Message>
  bool has(const std::string& topic) const {
    const std::string type = typeOf(topic);
    if (!type.empty() && type != typeName<Message>()) {
      fail("topic '" + topic + "' is of type " + type + ", not " + typeName<Message>());
    }
    return !type.empty();
  }

  void scan(const BagRange& range) {
    rosbag::View all(bag);
    if (all.size() == 0) {
      fail("has no messages");
    }
    begin = all.getBeginTime() + ros::Duration(range.start_s);
    end = all.getEndTime();
    if (range.duration_s > 0.0) {
      end = std::min(end, begin + ros::Duration(range.duration_s));
    }
    if (end < begin) {
      fail("is shorter than " + std::to_string(range.start_s) + " s");
    }
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      types[bare(connection->topic)] = connection->datatype;
    }
  }

  void requireInputs() const {
    const TopicNames& topics = config.topics;
    if (!has<sensor_msgs::Imu>(topics.imu)) {
      fail("has no topic '" + topics.imu + "' (" + typeName<sensor_msgs::Imu>() + "); it has " + listOfTopics());
    }
    const WheelInput wheels(config);
    const bool has_wheels = (wheels.wantsJointStates() && has<sensor_msgs::JointState>(topics.joint_states)) ||
                            (wheels.wantsOdometry() && has<nav_msgs::Odometry>(topics.wheel_odometry));
    if (!has_wheels && !config.filter.updates.empty()) {
      fail("has neither topic '" + topics.joint_states + "' (" + typeName<sensor_msgs::JointState>() + ") nor '" +
           topics.wheel_odometry + "' (" + typeName<nav_msgs::Odometry>() + "); it has " + listOfTopics());
    }
    if (config.initialization.source == "gnss" && !has<sensor_msgs::NavSatFix>(topics.gps_fix)) {
      fail("has no topic '" + topics.gps_fix + "' (" + typeName<sensor_msgs::NavSatFix>() +
           "), which initialization.source: gnss needs; it has " + listOfTopics());
    }
  }

  void chooseTruth(const std::string& wanted) {
    if (!wanted.empty() && typeOf(wanted).empty()) {
      fail("has no topic '" + wanted + "' for the truth; it has " + listOfTopics());
    }
    const TopicNames& topics = config.topics;
    const std::vector<std::string> candidates =
        wanted.empty() ? std::vector<std::string>{topics.truth_fix, topics.truth_odometry, topics.truth_pose}
                       : std::vector<std::string>{wanted};
    const auto present = std::find_if(candidates.begin(), candidates.end(),
                                      [this](const std::string& topic) { return !typeOf(topic).empty(); });
    truth_topic = present == candidates.end() ? "" : bare(*present);
    const std::string type = typeOf(truth_topic);
    if (!type.empty() && type != typeName<sensor_msgs::NavSatFix>() && type != typeName<nav_msgs::Odometry>() &&
        type != typeName<geometry_msgs::PoseStamped>()) {
      fail("topic '" + truth_topic + "' is of type " + type + ", which is no truth");
    }
  }

  void requireTruthToStartFrom() const {
    const std::string type = typeOf(truth_topic);
    if (config.initialization.source == "truth" && type != typeName<sensor_msgs::NavSatFix>() &&
        type != typeName<nav_msgs::Odometry>()) {
      fail("initialization.source: truth needs a truth of type " + typeName<sensor_msgs::NavSatFix>() + " or " +
           typeName<nav_msgs::Odometry>());
    }
  }

  void takeExtrinsicsFromBag() {
    tf2::BufferCore buffer;
    for (const rosbag::MessageInstance& instance :
         rosbag::View(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf_static", "tf_static"}))) {
      const tf2_msgs::TFMessage::ConstPtr message = instance.instantiate<tf2_msgs::TFMessage>();
      for (const geometry_msgs::TransformStamped& transform : message->transforms) {
        buffer.setTransform(transform, path, true);
      }
    }
    const std::string missing = takeExtrinsics(buffer, config.initialization.source == "gnss", config);
    if (!missing.empty()) {
      fail(missing + " in /tf_static");
    }
  }

  void dispatchTruth(const rosbag::MessageInstance& instance, const BagSink& sink) const {
    if (const auto fix = instance.instantiate<sensor_msgs::NavSatFix>()) {
      if (const std::optional<GnssFix> converted = toGnssFix(*fix)) {
        sink.truth_fix(*converted);
      }
      return;
    }
    std::optional<TruthSample> pose;
    if (const auto odometry = instance.instantiate<nav_msgs::Odometry>()) {
      pose = toTruthSample(*odometry);
    } else if (const auto stamped = instance.instantiate<geometry_msgs::PoseStamped>()) {
      pose = toTruthSample(*stamped);
    }
    if (pose) {
      sink.truth_pose(*pose);
    }
  }

  /// The state of the IMU at a truth message, and whether its attitude is known; nothing when it cannot be used.
  std::optional<std::pair<NavigationState, bool>> truthStart(const rosbag::MessageInstance& instance) const {
    if (const auto fix = instance.instantiate<sensor_msgs::NavSatFix>()) {
      const std::optional<GnssFix> converted = toGnssFix(*fix);
      if (!converted) {
        return std::nullopt;
      }
      NavigationState state;
      state.stamp = converted->stamp;
      state.position = toPositionFix(*converted).position;
      return std::pair(state, false);
    }
    const auto odometry = instance.instantiate<nav_msgs::Odometry>();
    if (!odometry || !toTruthSample(*odometry)) {
      return std::nullopt;
    }
    const InitializationParams& start = config.initialization;
    const LocalFrame frame(Planet::byName(config.planet),
                           {degToRad(start.latitude_deg), degToRad(start.longitude_deg), start.height_m});
    return std::pair(toNavigationState(*odometry, frame, config.imu.mount.position_b()), true);
  }

  template <class Message>
  static void dispatchWheels(const rosbag::MessageInstance& instance, WheelInput& wheels, const BagSink& sink) {
    const auto message = instance.instantiate<Message>();
    if (const std::optional<WheelMotion> motion = wheels.take(*message)) {
      sink.wheels(*motion);
    } else if (!wheels.problem().empty()) {
      sink.problem(wheels.problem());
    }
  }
};

BagReader::BagReader(const std::string& path, const Config& config, const std::string& truth, const BagRange& range)
    : parts_(std::make_unique<Parts>()) {
  parts_->path = path;
  parts_->config = config;
  open(path, parts_->bag);
  parts_->scan(range);
  parts_->requireInputs();
  parts_->chooseTruth(truth);
  parts_->requireTruthToStartFrom();
  if (config.frames.extrinsicsFromTf()) {
    parts_->takeExtrinsicsFromBag();
  }
}

BagReader::~BagReader() = default;
BagReader::BagReader(BagReader&&) noexcept = default;
BagReader& BagReader::operator=(BagReader&&) noexcept = default;

const Config& BagReader::config() const { return parts_->config; }

bool BagReader::truthIsGeodetic() const {
  return parts_->truth_topic.empty() || parts_->typeOf(parts_->truth_topic) == typeName<sensor_msgs::NavSatFix>();
}

double BagReader::duration() const { return (parts_->end - parts_->begin).toSec(); }

void BagReader::read(const BagSink& sink) const {
  const TopicNames& topics = parts_->config.topics;
  const ImuMount mount(parts_->config.imu.mount);
  WheelInput wheels(parts_->config);
  bool start_wanted = parts_->config.initialization.source == "truth";
  try {
    for (const rosbag::MessageInstance& instance : rosbag::View(parts_->bag, parts_->begin, parts_->end)) {
      const std::string topic = bare(instance.getTopic());
      if (topic == bare(topics.imu)) {
        sink.imu(toImuSample(*instance.instantiate<sensor_msgs::Imu>(), mount));
      } else if (topic == bare(topics.joint_states) && wheels.wantsJointStates()) {
        Parts::dispatchWheels<sensor_msgs::JointState>(instance, wheels, sink);
      } else if (topic == bare(topics.wheel_odometry) && wheels.wantsOdometry()) {
        Parts::dispatchWheels<nav_msgs::Odometry>(instance, wheels, sink);
      } else if (topic == bare(topics.gps_fix)) {
        if (const std::optional<GnssFix> fix = toGnssFix(*instance.instantiate<sensor_msgs::NavSatFix>())) {
          sink.fix(*fix);
        }
      }
      if (topic == parts_->truth_topic) {  // may be one of the inputs, too
        parts_->dispatchTruth(instance, sink);
        const auto start = start_wanted ? parts_->truthStart(instance) : std::nullopt;
        if (start) {
          sink.truth_start(start->first, start->second);
          start_wanted = false;
        }
      }
    }
  } catch (const rosbag::BagException& error) {
    parts_->fail(std::string("is damaged: ") + error.what());
  } catch (const ros::serialization::StreamOverrunException& error) {
    parts_->fail(std::string("is damaged: ") + error.what());
  }
}

}  // namespace slipnav
