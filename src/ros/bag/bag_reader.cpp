#include "ros/bag/bag_reader.h"

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "core/base/text.h"
#include "core/ordering/stamp_watch.h"
#include "ros/bag/bag_file.h"
#include "ros/messages/conversions.h"
#include "ros/messages/fix_input.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/wheel_input.h"
#include "ros/runtime/extrinsics.h"

namespace slipnav {
namespace {

/// Recordings have topics with and without a leading slash.
std::string bare(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

/// No recording is longer than ROS can count seconds.
Nanoseconds span(double duration_s) { return fromSeconds(std::clamp(duration_s, 0.0, 4294967295.0)); }

template <class Message>
std::string typeName() {
  return ros::message_traits::datatype<Message>();
}

}  // namespace

struct BagReader::Parts {
  Parts(const std::vector<std::string>& files, Config configuration)
      : path(files.front()), config(std::move(configuration)), bag(files) {}

  std::string path;
  Config config;
  BagParts bag;
  std::map<std::string, std::string> types;  ///< of each topic, by its bare name
  std::string truth_topic;                   ///< bare; "" if there is none
  Nanoseconds begin = 0;
  Nanoseconds end = 0;

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
    const std::vector<BagEntry>& all = bag.entries();
    if (all.empty()) {
      fail("has no messages");
    }
    begin = all.front().time + span(range.start_s);
    end = all.back().time;
    if (range.duration_s > 0.0) {
      end = std::min(end, begin + span(range.duration_s));
    }
    if (end < begin) {
      fail("is shorter than " + std::to_string(range.start_s) + " s");
    }
    for (const BagConnection& connection : bag.connections()) {
      types[bare(connection.topic)] = connection.type;
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
    has<geometry_msgs::TwistWithCovarianceStamped>(topics.gps_velocity);  // or of the wrong type
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
      fail("topic '" + truth_topic + "' is of type " + type + ", which is not a truth type");
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
    for (const BagEntry& entry : bag.entries()) {
      const std::string topic = bare(bag.connection(entry).topic);
      if (topic != "tf_static" && topic != "tf") {
        continue;
      }
      const auto message = bag.read<tf2_msgs::TFMessage>(entry);
      for (const geometry_msgs::TransformStamped& transform : message.transforms) {
        buffer.setTransform(transform, path, true);
      }
    }
    const std::string missing = takeExtrinsics(buffer, config.initialization.source == "gnss", config);
    if (!missing.empty()) {
      fail(missing + " in /tf_static and /tf");
    }
  }

  void dispatchTruth(const BagEntry& entry, const BagSink& sink) {
    if (bag.holds<sensor_msgs::NavSatFix>(entry)) {
      if (std::optional<GnssFix> fix = toGnssFix(bag.read<sensor_msgs::NavSatFix>(entry))) {
        fix->stamp += fromSeconds(config.truth.stamp_offset_s);
        sink.truth_fix(*fix);
      }
      return;
    }
    std::optional<TruthSample> pose = bag.holds<nav_msgs::Odometry>(entry)
                                          ? toTruthSample(bag.read<nav_msgs::Odometry>(entry))
                                          : toTruthSample(bag.read<geometry_msgs::PoseStamped>(entry));
    if (pose) {
      pose->stamp += fromSeconds(config.truth.stamp_offset_s);
      sink.truth_pose(*pose);
    }
  }

  /// The state of the IMU at a truth message, and whether its attitude is known; nothing if it cannot be used.
  std::optional<std::pair<NavigationState, bool>> truthStart(const BagEntry& entry) {
    if (bag.holds<sensor_msgs::NavSatFix>(entry)) {
      const std::optional<GnssFix> fix = toGnssFix(bag.read<sensor_msgs::NavSatFix>(entry));
      if (!fix) {
        return std::nullopt;
      }
      NavigationState state;
      state.stamp = fix->stamp;
      state.position = toPositionFix(*fix).position;
      return std::pair(state, false);
    }
    const auto odometry = bag.read<nav_msgs::Odometry>(entry);
    const std::optional<TruthSample> sample = toTruthSample(odometry);
    if (!sample) {
      return std::nullopt;
    }
    const InitializationParams& start = config.initialization;
    const LocalFrame frame(Planet::byName(config.planet),
                           {degToRad(start.latitude_deg), degToRad(start.longitude_deg), start.height_m});
    return std::pair(toNavigationState(odometry, frame, config.imu.mount.position_b()),
                     sample->q_flu_to_enu.has_value());
  }

  void dispatchImu(const BagEntry& entry, ImuInput& imu, StampWatch& stamps, const BagSink& sink) {
    if (const std::optional<ImuSample> sample = imu.take(bag.read<sensor_msgs::Imu>(entry))) {
      stamps.noteImu(sample->stamp);
      sink.imu(*sample);
    } else {
      sink.problem(imu.problem(), entry.time);
    }
  }

  void dispatchFix(const BagEntry& entry, FixInput& fixes, StampWatch& stamps, const BagSink& sink) {
    const std::optional<GnssFix> fix = fixes.take(bag.read<sensor_msgs::NavSatFix>(entry));
    if (!fixes.problem().empty()) {
      sink.problem(fixes.problem(), entry.time);
    }
    if (fix) {
      watch(entry, fixes.topic(), fix->stamp, stamps, sink);
      sink.fix(*fix);
    }
  }

  static void watch(const BagEntry& entry, const std::string& topic, Nanoseconds stamp, StampWatch& stamps,
                    const BagSink& sink) {
    const std::string problem = stamps.note(topic, stamp);
    if (!problem.empty()) {
      sink.problem(problem, entry.time);
    }
  }

  template <class Message>
  void dispatchWheels(const BagEntry& entry, WheelInput& wheels, StampWatch& stamps, const BagSink& sink) {
    const std::optional<WheelMotion> motion = wheels.take(bag.read<Message>(entry));
    for (const std::string& said : {wheels.problem(), wheels.remark()}) {
      if (!said.empty()) {
        sink.problem(said, entry.time);
      }
    }
    if (motion) {
      watch(entry, wheels.topic(), motion->stamp, stamps, sink);
      sink.wheels(*motion);
    }
  }
};

BagReader::BagReader(const std::string& path, const Config& config, const std::string& truth, const BagRange& range)
    : BagReader(std::vector<std::string>{path}, config, truth, range) {}

BagReader::BagReader(const std::vector<std::string>& paths, const Config& config, const std::string& truth,
                     const BagRange& range)
    : parts_(std::make_unique<Parts>(paths, config)) {
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

Nanoseconds BagReader::begin() const { return parts_->begin; }

double BagReader::duration() const { return toSeconds(parts_->end - parts_->begin); }

void BagReader::read(const BagSink& sink) const {
  const TopicNames& topics = parts_->config.topics;
  ImuInput imu(parts_->config);
  WheelInput wheels(parts_->config);
  FixInput fixes(parts_->config);
  StampWatch stamps(topics.imu);
  bool start_wanted = parts_->config.initialization.source == "truth";
  for (const BagEntry& entry : parts_->bag.entries()) {
    if (entry.time < parts_->begin || entry.time > parts_->end) {
      continue;
    }
    const std::string topic = bare(parts_->bag.connection(entry).topic);
    if (topic == bare(topics.imu)) {
      parts_->dispatchImu(entry, imu, stamps, sink);
    } else if (topic == bare(topics.joint_states) && wheels.wantsJointStates()) {
      parts_->dispatchWheels<sensor_msgs::JointState>(entry, wheels, stamps, sink);
    } else if (topic == bare(topics.wheel_odometry) && wheels.wantsOdometry()) {
      parts_->dispatchWheels<nav_msgs::Odometry>(entry, wheels, stamps, sink);
    } else if (topic == bare(topics.gps_fix)) {
      parts_->dispatchFix(entry, fixes, stamps, sink);
    } else if (topic == bare(topics.gps_velocity)) {
      if (auto fix = toVelocityFix(parts_->bag.read<geometry_msgs::TwistWithCovarianceStamped>(entry))) {
        fix->stamp += fromSeconds(parts_->config.initialization.fix_stamp_offset_s);
        sink.velocity(*fix);
      }
    }
    if (topic == parts_->truth_topic) {  // may be one of the inputs, too
      parts_->dispatchTruth(entry, sink);
      const auto start = start_wanted ? parts_->truthStart(entry) : std::nullopt;
      if (start) {
        if (!start->second) {
          sink.problem("the truth has no attitude to start from: initialization.heading_deg is used (" +
                           formatNumber(parts_->config.initialization.heading_deg) + " deg, 1 sigma " +
                           formatNumber(parts_->config.initialization.heading_std_deg) + " deg)",
                       entry.time);
        }
        NavigationState state = start->first;
        state.stamp += fromSeconds(parts_->config.truth.stamp_offset_s);
        sink.truth_start(state, start->second);
        start_wanted = false;
      }
    }
  }
}

}  // namespace slipnav
