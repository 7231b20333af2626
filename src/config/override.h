#pragma once
/// Single settings from a command line that take precedence over configuration files.

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace slipnav {

/// One setting, as a path of block names and a value.
struct Override {
  std::vector<std::string> path;  ///< block names, then the key
  std::string value;              ///< YAML, for example "3", "[wheel, zupt]"
  std::string source;             ///< name in error messages, for example "--topic imu/data:=imu_filtered"
};

/// From `--topic name:=other`: what the robot or the recording calls one of slipnav's topics.
/// Throws std::invalid_argument if `argument` does not have this form.
Override topicOverride(const std::string& argument);

/// From `--set block.key=value`. Throws std::invalid_argument if `argument` does not have this form.
Override keyOverride(const std::string& argument);

/// The override as a document of nested blocks. Throws std::invalid_argument if the value is not YAML.
YAML::Node toYamlNode(const Override& item);

}  // namespace slipnav
