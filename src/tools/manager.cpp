/// The manager of the launch files: like `nodelet manager`, with the same services and parameters, but it loads its
/// nodelets itself.
///
/// With `nodelet load` each nodelet has a process besides the manager, which notices only after 4 s without a heartbeat
/// that the manager was killed; until then a restarted manager is empty. Here a manager is complete as soon as it is
/// restarted.
///
/// A second one of the same name on this computer waits until the first has ended: ROS would end the first instead,
/// which its roslaunch restarts, which ends the second, and so on.

#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <iostream>
#include <string>

#include "core/navigation/checkpoint.h"

namespace {

constexpr const char* kUsage = "usage: manager NAME=PACKAGE/TYPE...\n";

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) {
  interrupted = 1;
  ros::requestShutdown();
}

/// Claims the name of this node under this master; the kernel gives it back when the process ends, however it ends.
/// @return whether nobody has claimed it
bool claimName() {
  static const int handle = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::string name =
      "slipnav_" + std::to_string(std::hash<std::string>()(ros::master::getURI() + ros::this_node::getName()));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);  // a leading zero byte: no file
  return bind(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 || errno != EADDRINUSE;
}

/// @return false if interrupted meanwhile
bool waitForName() {
  while (interrupted == 0 && !claimName()) {
    ROS_WARN_ONCE("%s is running already: waiting for its end; a second rover needs a namespace of its own",
                  ros::this_node::getName().c_str());
    ros::WallDuration(0.2).sleep();
  }
  return interrupted == 0;
}

bool areWellFormed(const ros::V_string& words) {
  for (const std::string& word : words) {
    if (word.find('=') == std::string::npos) {
      return false;
    }
  }
  return true;
}

/// @param word NAME=PACKAGE/TYPE
bool loadNodelet(nodelet::Loader& loader, const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = ros::names::resolve(word.substr(0, equals));
  const std::string type = word.substr(equals + 1);
  if (!loader.load(name, type, ros::names::getRemappings(), {})) {
    ROS_FATAL("%s of type %s cannot be loaded", name.c_str(), type.c_str());
    return false;
  }
  return true;
}

/// Runs until ROS is shut down. @return whether all could be loaded
bool serve(const ros::V_string& words) {
  nodelet::Loader loader;
  for (const std::string& word : words) {
    if (!loadNodelet(loader, word)) {
      return false;
    }
  }
  ros::spin();
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "slipnav_manager", ros::init_options::NoSigintHandler);
  const ros::V_string words(argv + 1, argv + argc);
  if (!areWellFormed(words)) {
    std::cerr << kUsage;
    return 2;
  }
  std::signal(SIGINT, &interrupt);
  if (!waitForName()) {
    return 0;
  }
  const ros::NodeHandle keep_alive;
  const auto launch_file = ros::param::param<std::string>("slipnav/checkpoint/launch_file", "");
  const bool loaded = serve(words);
  if (interrupted != 0) {  // roslaunch ends the launch: nobody will resume from there
    slipnav::deleteCheckpoint(launch_file);
  }
  return loaded ? 0 : 1;
}
