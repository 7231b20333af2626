#include "ros/replay/node_process.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace slipnav {
namespace {

/// Fields of /proc/PID/stat after the name, which may contain spaces: the first of them is the state.
constexpr int kUserTime = 11;
constexpr int kThreads = 17;
constexpr int kResidentPages = 21;

}  // namespace

pid_t pidOf(const std::string& node) {
  std::string host;
  std::uint32_t port = 0;
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false) ||
      !ros::network::splitURI(static_cast<std::string>(uri), host, port)) {
    return 0;
  }
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue caller;
  XmlRpc::XmlRpcValue answer;
  caller[0] = ros::this_node::getName();
  return client.execute("getPid", caller, answer) ? static_cast<int>(answer[2]) : 0;
}

ProcessUsage usageOf(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::vector<std::string> fields;
  for (std::string word; words >> word;) {
    fields.push_back(word);
  }
  if (fields.size() <= kResidentPages) {
    throw std::runtime_error("process " + std::to_string(process) + " is gone");
  }
  const auto number = [&fields](int field) { return std::stod(fields.at(static_cast<std::size_t>(field))); };
  ProcessUsage usage;
  usage.cpu_s = (number(kUserTime) + number(kUserTime + 1)) / static_cast<double>(sysconf(_SC_CLK_TCK));
  usage.threads = static_cast<int>(number(kThreads));
  usage.memory_mb = number(kResidentPages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  return usage;
}

}  // namespace slipnav
