#include "config/yaml_document.h"

#include <stdexcept>

namespace slipnav {

YAML::Node loadYamlFile(const std::string& file) {
  try {
    return YAML::LoadFile(file);
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(file + ": cannot be read");
  } catch (const YAML::ParserException& error) {
    throw std::invalid_argument(yamlLocation(file, error.mark) + error.msg);
  }
}

YAML::Node parseYaml(const std::string& text, const std::string& source) {
  try {
    return YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw std::invalid_argument(yamlLocation(source, error.mark) + error.msg);
  }
}

YAML::Node mergeYaml(const YAML::Node& base, const YAML::Node& overlay) {
  if (!overlay.IsMap() || !base.IsMap()) {
    return YAML::Clone(overlay.IsNull() ? base : overlay);
  }
  YAML::Node merged = YAML::Clone(base);
  for (const auto& entry : overlay) {
    const std::string& key = entry.first.Scalar();
    const YAML::Node present = base[key];
    merged[key] = present ? mergeYaml(present, entry.second) : YAML::Clone(entry.second);
  }
  return merged;
}

std::string yamlLocation(const std::string& source, const YAML::Mark& mark) {
  if (source.empty()) {
    return "";
  }
  return mark.line < 0 ? source + ": " : source + ":" + std::to_string(mark.line + 1) + ": ";
}

}  // namespace slipnav
