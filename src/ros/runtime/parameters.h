#pragma once
/// The configuration from the parameter server: the same reader, hence the same checks, as for YAML files.

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "config/config.h"

namespace slipnav {

/// A parameter tree as YAML. ROS splits keys at slashes; those of the block `topics` ("imu/data") are joined
/// again.
YAML::Node toYamlNode(const XmlRpc::XmlRpcValue& value);

/// The configuration in the tree `name`, relative to the node's namespace; defaults where there is nothing.
/// Throws std::invalid_argument with one line that names the tree, the key and what is wrong.
Config configFromParameters(const ros::NodeHandle& node, const std::string& name);

}  // namespace slipnav
