#pragma once
/// Named worlds and sensor grades: YAML files of a folder of configurations.

#include <string>
#include <vector>

namespace slipnav::sim {

/// Names of the files NAME.yaml in `folder`, in alphabetical order; empty if there is no such folder.
std::vector<std::string> configurationsIn(const std::string& folder);

/// Path of NAME.yaml in `folder`. Throws std::invalid_argument that names the known ones if there is none.
/// @param what for the message, e.g. "world"
std::string configurationNamed(const std::string& name, const std::string& folder, const std::string& what);

}  // namespace slipnav::sim
