#include "slipnav/config/config.h"

#include <stdexcept>

#include "slipnav/config/yaml_document.h"
#include "slipnav/config/yaml_reader.h"

namespace slipnav {
namespace {

/// Merges a document into what has been read so far. It is first read alone, so that errors name where they are.
void mergeChecked(const YAML::Node& document, const std::string& source, YAML::Node& merged) {
  Config scratch;
  readParameters(document, scratch, source);
  merged.reset(mergeYaml(merged, document));
}

/// An override has a name, but no lines that an error could point at.
void mergeOverride(const Override& item, YAML::Node& merged) {
  try {
    mergeChecked(toYamlNode(item), "", merged);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(item.source + ": " + error.what());
  }
}

}  // namespace

void Config::visit(ParameterVisitor& v) {
  v.choice("planet", planet, {"earth", "mars", "moon"}, "whose ellipsoid, gravity and rotation hold");
  v.group("topics", topics, "what the robot or the recording calls each topic");
}

Config Config::load(const std::vector<std::string>& yaml_files, const std::vector<Override>& overrides) {
  YAML::Node merged(YAML::NodeType::Map);
  for (const std::string& file : yaml_files) {
    mergeChecked(loadYamlFile(file), file, merged);
  }
  for (const Override& item : overrides) {
    mergeOverride(item, merged);
  }
  Config config;
  readParameters(merged, config);
  return config;
}

}  // namespace slipnav
