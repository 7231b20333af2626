#pragma once
/// Keys that have another name than in an earlier release.

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace slipnav {

/// Gives former keys of a configuration their present names.
/// @param source name of the document for messages
/// @return one line for each, with its place and its present name. Throws std::invalid_argument with one line if the
/// document has both names of a key.
std::vector<std::string> renameFormerKeys(YAML::Node& document, const std::string& source);

}  // namespace slipnav
