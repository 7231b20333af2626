#pragma once
/// What roscpp knows of the links of this process.

#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace slipnav::test {

/// roscpp's own answer to an XML-RPC call, asked at this node.
inline XmlRpc::XmlRpcValue askThisNode(const std::string& method) {
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port);
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  XmlRpc::XmlRpcValue answer;
  caller[0] = ros::this_node::getName();
  EXPECT_TRUE(client.execute(method.c_str(), caller, answer));
  return answer;
}

struct Traffic {
  int messages = 0;
  int bytes = 0;
};

/// What came in on each topic.
inline std::map<std::string, Traffic> traffic() {
  std::map<std::string, Traffic> result;
  XmlRpc::XmlRpcValue subscriptions = askThisNode("getBusStats")[1];  // of this call roscpp gives no status
  for (int i = 0; i < subscriptions.size(); ++i) {
    XmlRpc::XmlRpcValue& links = subscriptions[i][1];
    for (int k = 0; k < links.size(); ++k) {
      Traffic& topic = result[subscriptions[i][0]];
      topic.bytes += static_cast<int>(links[k][1]);
      topic.messages += static_cast<int>(links[k][2]);
    }
  }
  return result;
}

/// Topics with a link that is not within this process.
inline std::set<std::string> topicsToOutside() {
  std::set<std::string> topics;
  XmlRpc::XmlRpcValue links = askThisNode("getBusInfo")[2];
  for (int i = 0; i < links.size(); ++i) {
    if (static_cast<std::string>(links[i][3]) != "INTRAPROCESS") {
      topics.insert(links[i][4]);
    }
  }
  return topics;
}

}  // namespace slipnav::test
