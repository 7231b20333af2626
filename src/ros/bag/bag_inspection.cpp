#include "ros/bag/bag_inspection.h"

#include <sensor_msgs/JointState.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "io/rtklib_pos.h"
#include "ros/bag/bag_file.h"
#include "ros/messages/conversions.h"
#include "ros/runtime/extrinsics.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// After this many unreadable messages of one topic no more are tried.
constexpr std::size_t kMostDamaged = 5;

std::string bare(const std::string& frame) {
  return frame.substr(std::min(frame.find_first_not_of('/'), frame.size()));
}

template <class Header>
MessageTime timeOf(const Header& header, const BagEntry& entry) {
  return {toNanoseconds(header.stamp), entry.time};
}

template <class V>
Vector3 toVector3(const V& v) {
  return {v.x, v.y, v.z};
}

/// Fills a recording from one file after another.
class RecordingReader {
 public:
  void read(const std::string& path) {
    BagFile bag(path);
    if (bag.entries().empty()) {
      throw std::invalid_argument(path + ": has no messages");
    }
    noteTopics(bag);
    for (const BagEntry& entry : bag.entries()) {
      ++topics_[bag.connection(entry).topic].messages;
      if (damaged_[bag.connection(entry).topic] < kMostDamaged) {
        take(bag, entry);
      }
    }
    begin_ = begin_ == 0 ? bag.entries().front().time : std::min(begin_, bag.entries().front().time);
    end_ = std::max(end_, bag.entries().back().time);
  }

  Recording finish() {
    result_.begin = begin_;
    result_.end = end_;
    for (auto& entry : topics_) {
      result_.topics.push_back(entry.second);
    }
    result_.damage.assign(damage_.begin(), damage_.end());
    return std::move(result_);
  }

 private:
  void noteTopics(const BagFile& bag) {
    std::map<std::string, std::size_t> publishers;
    for (const auto& [id, connection] : bag.connections()) {
      TopicRecord& topic = topics_[connection.topic];
      topic.topic = connection.topic;
      topic.type = connection.type;
      topic.publishers = std::max(topic.publishers, ++publishers[connection.topic]);
    }
  }

  /// Reports a damaged message, and the next one is tried.
  void take(BagFile& bag, const BagEntry& entry) {
    const std::string& topic = bag.connection(entry).topic;
    try {
      if (bag.holds<sensor_msgs::Imu>(entry)) {
        takeImu(topic, bag.read<sensor_msgs::Imu>(entry), entry);
      } else if (bag.holds<sensor_msgs::JointState>(entry)) {
        takeJoints(topic, bag.read<sensor_msgs::JointState>(entry), entry);
      } else if (bag.holds<nav_msgs::Odometry>(entry)) {
        takeOdometry(topic, bag.read<nav_msgs::Odometry>(entry), entry);
      } else if (bag.holds<geometry_msgs::PoseStamped>(entry)) {
        takePose(topic, bag.read<geometry_msgs::PoseStamped>(entry), entry);
      } else if (bag.holds<sensor_msgs::NavSatFix>(entry)) {
        takeFix(topic, bag.read<sensor_msgs::NavSatFix>(entry), entry);
      } else if (bag.holds<tf2_msgs::TFMessage>(entry)) {
        takeTransforms(topic, bag.read<tf2_msgs::TFMessage>(entry));
      }
    } catch (const std::invalid_argument& error) {
      ++damaged_[topic];
      damage_.insert(error.what());
    }
  }

  void takeImu(const std::string& topic, const sensor_msgs::Imu& message, const BagEntry& entry) {
    const std::string frame = bare(message.header.frame_id);
    ImuRecord& record = recordOf(result_.imus, topic, [&frame](const ImuRecord& r) { return r.frame == frame; });
    record.frame = frame;
    record.samples.push_back(
        {timeOf(message.header, entry), toVector3(message.linear_acceleration), toVector3(message.angular_velocity)});
    record.without_force += message.linear_acceleration_covariance[0] == -1.0 ? 1 : 0;
    record.without_rate += message.angular_velocity_covariance[0] == -1.0 ? 1 : 0;
  }

  void takeJoints(const std::string& topic, const sensor_msgs::JointState& message, const BagEntry& entry) {
    JointRecord& record =
        recordOf(result_.joints, topic, [&message](const JointRecord& r) { return r.names == message.name; });
    record.names = message.name;
    record.samples.push_back({timeOf(message.header, entry), message.position, message.velocity});
  }

  void takeOdometry(const std::string& topic, const nav_msgs::Odometry& message, const BagEntry& entry) {
    PoseRecord& record = recordOf(result_.poses, topic, [](const PoseRecord&) { return true; });
    record.frame = message.header.frame_id;
    record.has_motion = true;
    RawPoseSample sample = poseOf(message.pose.pose);
    sample.time = timeOf(message.header, entry);
    sample.forward_mps = message.twist.twist.linear.x;
    sample.yaw_rate_radps = message.twist.twist.angular.z;
    record.samples.push_back(sample);
  }

  void takePose(const std::string& topic, const geometry_msgs::PoseStamped& message, const BagEntry& entry) {
    PoseRecord& record = recordOf(result_.poses, topic, [](const PoseRecord&) { return true; });
    record.frame = message.header.frame_id;
    RawPoseSample sample = poseOf(message.pose);
    sample.time = timeOf(message.header, entry);
    record.samples.push_back(sample);
  }

  static RawPoseSample poseOf(const geometry_msgs::Pose& pose) {
    RawPoseSample sample;
    sample.position_m = toVector3(pose.position);
    const Quaternion q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
    if (q.coeffs().allFinite() && q.norm() > 0.5) {
      sample.q_to_parent = q.normalized();
    }
    return sample;
  }

  void takeFix(const std::string& topic, const sensor_msgs::NavSatFix& message, const BagEntry& entry) {
    FixRecord& record = recordOf(result_.fixes, topic, [](const FixRecord&) { return true; });
    record.frame = bare(message.header.frame_id);
    RawFixSample sample;
    sample.time = timeOf(message.header, entry);
    sample.has_fix = message.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX;
    sample.is_nowhere = message.latitude == 0.0 && message.longitude == 0.0;
    sample.has_covariance = message.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN &&
                            message.position_covariance[0] > 0.0;
    if (const std::optional<GnssFix> fix = toGnssFix(message)) {
      sample.fix = *fix;
      sample.is_usable = true;
    }
    record.samples.push_back(sample);
  }

  void takeTransforms(const std::string& topic, const tf2_msgs::TFMessage& message) {
    for (const geometry_msgs::TransformStamped& transform : message.transforms) {
      const std::pair<std::string, std::string> names(bare(transform.header.frame_id), bare(transform.child_frame_id));
      if (!seen_transforms_.insert(names).second) {
        continue;  // a sensor's pose does not change
      }
      const geometry_msgs::Quaternion& q = transform.transform.rotation;
      const Quaternion rotation(q.w, q.x, q.y, q.z);
      if (rotation.norm() > 0.5 && rotation.coeffs().allFinite()) {
        result_.transforms.push_back({names.first, names.second, bare(topic) == "tf_static",
                                      toVector3(transform.transform.translation), rotation.normalized()});
      }
    }
  }

  template <class Record, class Same>
  static Record& recordOf(std::vector<Record>& records, const std::string& topic, Same same) {
    for (Record& record : records) {
      if (record.topic == topic && same(record)) {
        return record;
      }
    }
    records.emplace_back();
    records.back().topic = topic;
    return records.back();
  }

  Recording result_;
  Nanoseconds begin_ = 0;
  Nanoseconds end_ = 0;
  std::map<std::string, TopicRecord> topics_;
  std::map<std::string, std::size_t> damaged_;
  std::set<std::string> damage_;
  std::set<std::pair<std::string, std::string>> seen_transforms_;
};

/// The files in order of their start.
std::vector<std::string> inOrderOfTime(const std::vector<std::string>& paths) {
  std::vector<std::pair<Nanoseconds, std::string>> begins;
  for (const std::string& path : paths) {
    const BagFile bag(path);
    begins.emplace_back(bag.entries().empty() ? 0 : bag.entries().front().time, path);
  }
  std::sort(begins.begin(), begins.end());
  std::vector<std::string> ordered;
  ordered.reserve(begins.size());
  for (const auto& begin : begins) {
    ordered.push_back(begin.second);
  }
  return ordered;
}

}  // namespace

Recording readRecording(const std::vector<std::string>& paths) {
  RecordingReader reader;
  for (const std::string& path : paths.size() > 1 ? inOrderOfTime(paths) : paths) {
    reader.read(path);
  }
  return reader.finish();
}

void addRtklibFile(const std::string& path, Recording& recording) {
  FixRecord record;
  record.topic = path;
  for (const RtklibSolution& solution : readRtklibPos(path)) {
    if (!solution.solved()) {
      ++record.left_out[solution.flaw];
      continue;
    }
    RawFixSample sample;
    sample.time = {solution.fix.stamp, solution.fix.stamp};
    sample.has_fix = sample.is_usable = sample.has_covariance = true;
    sample.fix = solution.fix;
    record.samples.push_back(sample);
  }
  recording.topics.push_back({path, "RTKLIB file", record.samples.size(), 1});
  recording.fixes.push_back(std::move(record));
}

std::optional<MountParams> poseByTransforms(const Recording& recording, const std::string& base,
                                            const std::string& child) {
  tf2::BufferCore buffer;
  for (const TransformRecord& record : recording.transforms) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = record.parent;
    transform.child_frame_id = record.child;
    transform.transform.translation.x = record.position_m.x();
    transform.transform.translation.y = record.position_m.y();
    transform.transform.translation.z = record.position_m.z();
    transform.transform.rotation.w = record.q_child_to_parent.w();
    transform.transform.rotation.x = record.q_child_to_parent.x();
    transform.transform.rotation.y = record.q_child_to_parent.y();
    transform.transform.rotation.z = record.q_child_to_parent.z();
    if (!record.parent.empty() && !record.child.empty()) {
      buffer.setTransform(transform, "recording", true);
    }
  }
  Config config;
  config.frames.base = base;
  config.frames.imu = child;
  if (base.empty() || child.empty() || !takeExtrinsics(buffer, false, config).empty()) {
    return std::nullopt;
  }
  return config.imu.mount;
}

}  // namespace slipnav
