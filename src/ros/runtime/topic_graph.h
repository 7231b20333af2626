#pragma once
/// Who is at the other end of a topic, as the master knows it.

#include <string>
#include <vector>

namespace slipnav {

/// Nodes by name, in alphabetical order.
struct TopicEnds {
  std::vector<std::string> publishers;
  std::vector<std::string> subscribers;
};

/// Nothing when the master does not answer. @param topic resolved
TopicEnds endsOf(const std::string& topic);

/// Whether a node only looks on: what `rosbag record` and `rostopic` call themselves.
bool isRecorder(const std::string& node);

/// The names with commas between.
std::string joined(const std::vector<std::string>& names);

}  // namespace slipnav
