#pragma once
/// Role of each topic in a recording, by type, name and content.

#include "config/topics.h"
#include "inspection/finding.h"
#include "inspection/recording.h"

namespace slipnav {

/// The record for each role, null if the recording has nothing for it. They point into the recording.
struct Roles {
  const ImuRecord* imu = nullptr;
  const JointRecord* joints = nullptr;
  const PoseRecord* wheel_odometry = nullptr;
  const FixRecord* fix = nullptr;
  const FixRecord* truth_fix = nullptr;
  const PoseRecord* truth_pose = nullptr;
};

/// @param wheel_names from the configuration, to recognize the right joints; may be empty
Roles proposeRoles(const Recording& recording, const TopicNames& names, const std::vector<std::string>& wheel_names);

/// Topics without a leading slash compare equal to those with one.
bool sameTopic(const std::string& a, const std::string& b);

/// Configured names that the recording does not have, with what it has instead.
void checkTopicNames(const Recording& recording, const Roles& roles, const TopicNames& names, Findings& findings);

/// Every topic with its type, messages and role, one line each.
std::string topicTable(const Recording& recording, const Roles& roles);

}  // namespace slipnav
