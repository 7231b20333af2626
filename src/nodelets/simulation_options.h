#pragma once
/// Settings of the simulator from launch files, besides the configuration: its private parameters.

#include <ros/node_handle.h>

#include <stdexcept>
#include <string>

namespace slipnav {

/// Private parameters of the simulator nodelet.
struct SimulationOptions {
  std::string policy;        ///< none, periodic:EVERY_S:HOLD_S (the operator stops), autonomous (the supervisor does)
  std::string out;           ///< folder of the results; empty: none
  std::string bag;           ///< file of the recording; empty: none
  bool report = false;       ///< plots into `out`
  double endurance_h = 0.0;  ///< drive for this long and keep only a row per minute; 0: to the end, keep all
  std::string manager;       ///< nodelet manager whose memory is monitored then
  double rate = 0.0;         ///< factor on real time; 0: as fast as possible

  explicit SimulationOptions(const ros::NodeHandle& node)
      : policy(node.param<std::string>("policy", "none")),
        out(node.param<std::string>("out", "")),
        bag(node.param<std::string>("bag", "")),
        report(node.param("report", false)),
        endurance_h(node.param("endurance", 0.0)),
        manager(node.param<std::string>("manager", "slipnav_manager")),
        rate(node.param("rate", 0.0)) {
    if (!(rate >= 0.0)) {
      throw std::invalid_argument("rate must not be negative");
    }
    if (endurance_h > 0.0 && out.empty()) {
      throw std::invalid_argument("endurance needs a folder for its rows: out");
    }
  }
};

}  // namespace slipnav
