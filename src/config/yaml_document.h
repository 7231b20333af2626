#pragma once
/// YAML documents as a whole: reading, parsing and merging them.

#include <yaml-cpp/yaml.h>

#include <string>

namespace slipnav {

/// Reads one YAML document from a file. Throws std::invalid_argument that names the file if it cannot be read or
/// parsed.
YAML::Node loadYamlFile(const std::string& file);

/// Parses YAML text. `source` is its name in error messages. Throws std::invalid_argument.
YAML::Node parseYaml(const std::string& text, const std::string& source);

/// Deep merge: where both have a map at a key, the maps are merged; anything else (including a list) of `overlay`
/// replaces that of `base`. Neither argument is changed.
YAML::Node mergeYaml(const YAML::Node& base, const YAML::Node& overlay);

/// "source:line: " for the start of an error message, as far as known.
std::string yamlLocation(const std::string& source, const YAML::Mark& mark);

}  // namespace slipnav
