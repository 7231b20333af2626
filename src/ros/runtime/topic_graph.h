#pragma once
/// Publishers and subscribers of a topic, as the master knows them.

#include <string>
#include <vector>

namespace slipnav {

/// Nodes by name, in alphabetical order.
struct TopicEnds {
  std::vector<std::string> publishers;
  std::vector<std::string> subscribers;
};

/// Nothing if the master does not answer. @param topic resolved
TopicEnds endsOf(const std::string& topic);

/// Whether a node only records: the names that `rosbag record` and `rostopic` use.
bool isRecorder(const std::string& node);

/// The names separated by commas.
std::string joined(const std::vector<std::string>& names);

}  // namespace slipnav
