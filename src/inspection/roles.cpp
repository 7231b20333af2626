#include "inspection/roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iomanip>
#include <sstream>

#include "inspection/wheel_choice.h"

namespace slipnav {
namespace {

const std::array<const char*, 9> kTruthWords = {"truth", "ground", "mocap", "vicon",    "optitrack",
                                                "rtk",   "dgps",   "gt_",   "reference"};
const std::array<const char*, 5> kWheelWords = {"wheel", "encoder", "velocity_controller", "diff_drive", "odom"};
/// Odometry that is more than wheels, or something else.
const std::array<const char*, 14> kFusedWords = {"filtered", "ekf",  "ukf", "vio",     "visual", "camera", "lidar",
                                                 "laser",    "slam", "map", "rtabmap", "gps",    "vins",   "fused"};

std::string bare(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

template <class Words>
bool contains(const std::string& topic, const Words& words) {
  std::string lower = topic;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&lower](const char* word) { return lower.find(word) != std::string::npos; });
}

/// The record with the highest positive score; if tied the one with more samples.
template <class Record, class Score>
const Record* bestOf(const std::vector<Record>& records, Score score) {
  const Record* best = nullptr;
  int best_score = 0;
  for (const Record& record : records) {
    const int its_score = record.samples.empty() ? 0 : score(record);
    const bool better = its_score > best_score ||
                        (best != nullptr && its_score == best_score && record.samples.size() > best->samples.size());
    if (better) {
      best = &record;
      best_score = its_score;
    }
  }
  return best;
}

constexpr int kByName = 1000;

int byName(const std::string& topic, const std::string& wanted) { return sameTopic(topic, wanted) ? kByName : 0; }

int scoreOfImu(const ImuRecord& record, const std::string& wanted) {
  const bool has_all = record.without_force < record.samples.size() && record.without_rate < record.samples.size();
  return byName(record.topic, wanted) + (has_all ? 2 : 1);
}

int scoreOfJoints(const JointRecord& record, const TopicNames& names, const std::vector<std::string>& wheels) {
  const auto configured = std::count_if(wheels.begin(), wheels.end(), [&record](const std::string& wheel) {
    return std::find(record.names.begin(), record.names.end(), wheel) != record.names.end();
  });
  const std::vector<WheelJoint> by_name = wheelsByName(record);
  const auto with_side = std::count_if(by_name.begin(), by_name.end(),
                                       [](const WheelJoint& wheel) { return wheel.side != Side::kUnknown; });
  const int turning = by_name.empty() ? 0 : 1 + static_cast<int>(with_side);
  return turning == 0 ? 0 : byName(record.topic, names.joint_states) + 10 * static_cast<int>(configured) + turning;
}

int scoreOfOdometry(const PoseRecord& record, const TopicNames& names) {
  const bool other = contains(record.topic, kTruthWords) || contains(record.topic, kFusedWords) ||
                     sameTopic(record.topic, names.odometry) || sameTopic(record.topic, names.truth_odometry);
  if (!record.has_motion) {
    return 0;
  }
  return byName(record.topic, names.wheel_odometry) + (other ? 0 : contains(record.topic, kWheelWords) ? 2 : 1);
}

int scoreOfTruth(const std::string& topic, const std::string& wanted) {
  return byName(topic, wanted) + (contains(topic, kTruthWords) ? 1 : 0);
}

std::string listOf(const Recording& recording, const std::string& type) {
  std::string list;
  for (const TopicRecord& topic : recording.topics) {
    if (topic.type == type && topic.messages > 0) {
      list += (list.empty() ? "" : ", ") + topic.topic;
    }
  }
  return list.empty() ? "no topic of type " + type : list + " (" + type + ")";
}

bool has(const Recording& recording, const std::string& name) {
  return std::any_of(recording.topics.begin(), recording.topics.end(),
                     [&name](const TopicRecord& topic) { return sameTopic(topic.topic, name) && topic.messages > 0; });
}

/// @param role topic that would fit; "" for none
void requireTopic(const Recording& recording, const std::string& key, const std::string& name, const std::string& role,
                  const std::string& type, Findings& findings) {
  if (has(recording, name)) {
    return;
  }
  const bool replaceable = !role.empty();
  findings.push_back({Severity::kUnusable, name, "is not in the recording; it has " + listOf(recording, type),
                      replaceable ? "topics: {" + key + ": " + bare(role) + "}" : "record it"});
}

}  // namespace

bool sameTopic(const std::string& a, const std::string& b) { return bare(a) == bare(b); }

Roles proposeRoles(const Recording& recording, const TopicNames& names, const std::vector<std::string>& wheel_names) {
  Roles roles;
  roles.imu = bestOf(recording.imus, [&](const ImuRecord& record) { return scoreOfImu(record, names.imu); });
  roles.joints =
      bestOf(recording.joints, [&](const JointRecord& record) { return scoreOfJoints(record, names, wheel_names); });
  roles.wheel_odometry =
      bestOf(recording.poses, [&](const PoseRecord& record) { return scoreOfOdometry(record, names); });
  roles.truth_fix =
      bestOf(recording.fixes, [&](const FixRecord& record) { return scoreOfTruth(record.topic, names.truth_fix); });
  roles.truth_pose = bestOf(recording.poses, [&](const PoseRecord& record) {
    return scoreOfTruth(record.topic, names.truth_odometry) + byName(record.topic, names.truth_pose);
  });
  roles.fix = bestOf(recording.fixes, [&](const FixRecord& record) {
    return byName(record.topic, names.gps_fix) + (&record == roles.truth_fix ? 0 : 1);
  });
  return roles;
}

void checkTopicNames(const Recording& recording, const Roles& roles, const TopicNames& names, Findings& findings) {
  requireTopic(recording, "imu/data", names.imu, roles.imu != nullptr ? roles.imu->topic : "", "sensor_msgs/Imu",
               findings);
  if (has(recording, names.joint_states) || has(recording, names.wheel_odometry)) {
    return;
  }
  if (roles.joints != nullptr || roles.wheel_odometry == nullptr) {
    requireTopic(recording, "joint_states", names.joint_states, roles.joints != nullptr ? roles.joints->topic : "",
                 "sensor_msgs/JointState", findings);
  } else {
    requireTopic(recording, "wheel_odometry", names.wheel_odometry, roles.wheel_odometry->topic, "nav_msgs/Odometry",
                 findings);
  }
}

std::string topicTable(const Recording& recording, const Roles& roles) {
  std::ostringstream out;
  const double duration_s = std::max(toSeconds(recording.end - recording.begin), 1e-9);
  const auto is = [](const auto* record, const TopicRecord& topic) {
    return record != nullptr && record->topic == topic.topic;
  };
  for (const TopicRecord& topic : recording.topics) {
    std::string role;
    const auto add = [&role](bool yes, const char* name) {
      role += yes ? (role.empty() ? "" : ", ") + std::string(name) : "";
    };
    add(is(roles.imu, topic), "imu/data");
    add(is(roles.joints, topic), "joint_states");
    add(is(roles.wheel_odometry, topic), "wheel_odometry");
    add(is(roles.fix, topic), "gps/fix");
    add(is(roles.truth_fix, topic), "truth/fix");
    add(is(roles.truth_pose, topic), "truth/odometry");
    out << "  " << std::left << std::setw(34) << topic.topic << std::setw(36) << topic.type << std::right
        << std::setw(8) << topic.messages << std::setw(9)
        << decimal(static_cast<double>(topic.messages) / duration_s, 1) << " Hz" << (role.empty() ? "" : "  = " + role)
        << "\n";
  }
  return out.str();
}

}  // namespace slipnav
