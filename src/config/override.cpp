#include "config/override.h"

#include <sstream>
#include <stdexcept>

#include "config/yaml_document.h"
#include "config/yaml_writer.h"

namespace slipnav {
namespace {

struct Assignment {
  std::string name;
  std::string value;
};

Assignment splitAt(const std::string& separator, const std::string& argument, const std::string& option,
                   const std::string& form) {
  const std::size_t position = argument.find(separator);
  if (position == std::string::npos || position == 0 || position + separator.size() == argument.size()) {
    throw std::invalid_argument(option + " '" + argument + "' must have the form " + form);
  }
  return {argument.substr(0, position), argument.substr(position + separator.size())};
}

}  // namespace

Override topicOverride(const std::string& argument) {
  const Assignment parts = splitAt(":=", argument, "--topic", "name:=other");
  return {{"topics", parts.name}, yamlScalar(parts.value), "--topic " + argument};
}

Override keyOverride(const std::string& argument) {
  const Assignment parts = splitAt("=", argument, "--set", "block.key=value");
  Override item{{}, parts.value, "--set " + argument};
  std::istringstream names(parts.name);
  for (std::string name; std::getline(names, name, '.');) {
    item.path.push_back(name);
  }
  return item;
}

YAML::Node toYamlNode(const Override& item) {
  YAML::Node node = parseYaml(item.value, "");
  for (auto name = item.path.rbegin(); name != item.path.rend(); ++name) {
    YAML::Node block(YAML::NodeType::Map);
    block[*name] = node;
    node.reset(block);
  }
  return node;
}

}  // namespace slipnav
