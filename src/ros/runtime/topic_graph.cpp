#include "ros/runtime/topic_graph.h"

#include <ros/master.h>
#include <ros/this_node.h>

#include <XmlRpcValue.h>

#include <algorithm>
#include <array>

namespace slipnav {
namespace {

/// One of the lists of getSystemState: [[topic, [node, …]], …].
std::vector<std::string> nodesOf(const std::string& topic, XmlRpc::XmlRpcValue& list) {
  std::vector<std::string> nodes;
  for (int i = 0; i < list.size(); ++i) {
    if (std::string(list[i][0]) == topic) {
      for (int k = 0; k < list[i][1].size(); ++k) {
        nodes.push_back(list[i][1][k]);
      }
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

TopicEnds endsOf(const std::string& topic) {
  XmlRpc::XmlRpcValue request;
  request[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue state;
  if (!ros::master::execute("getSystemState", request, response, state, false)) {
    return {};
  }
  return {nodesOf(topic, state[0]), nodesOf(topic, state[1])};
}

bool isRecorder(const std::string& node) {
  const std::string name = node.substr(node.rfind('/') + 1);
  const std::array<std::string, 2> recorders = {"record_", "rostopic_"};
  return std::any_of(recorders.begin(), recorders.end(),
                     [&name](const std::string& start) { return name.compare(0, start.size(), start) == 0; });
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

}  // namespace slipnav
