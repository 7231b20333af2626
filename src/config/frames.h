#pragma once
/// Names of coordinate frames (REP-105), and where the poses of the sensors come from.

#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `frames`: the name of each frame in TF and message headers.
struct FrameNames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string imu = "imu_link";
  std::string gps = "gps";
  std::string extrinsics = "parameters";
  bool publish_tf = true;
  void visit(ParameterVisitor& v);

  bool extrinsicsFromTf() const { return extrinsics == "tf"; }
};

}  // namespace slipnav
