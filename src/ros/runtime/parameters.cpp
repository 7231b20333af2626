#include "ros/runtime/parameters.h"

#include <ros/console.h>

#include <stdexcept>
#include <string>

#include "config/renamed_keys.h"
#include "config/yaml_reader.h"
#include "core/base/text.h"

namespace slipnav {
namespace {

using XmlRpc::XmlRpcValue;

/// Scalars, lists and maps. XmlRpcValue has no const access to maps, hence the copies.
YAML::Node convert(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(formatNumber(static_cast<double>(value)));
    case XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) {
        list.push_back(convert(value[i]));
      }
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& entry : value) {
        map[entry.first] = convert(entry.second);
      }
      return map;
    }
    default:
      throw std::invalid_argument("a parameter has a type that YAML does not know");
  }
}

void flatten(const std::string& prefix, const YAML::Node& node, YAML::Node& flat) {
  for (const auto& entry : node) {
    const std::string name = prefix + entry.first.Scalar();
    if (entry.second.IsMap()) {
      flatten(name + "/", entry.second, flat);
    } else {
      flat[name] = entry.second;
    }
  }
}

}  // namespace

YAML::Node toYamlNode(const XmlRpc::XmlRpcValue& value) {
  YAML::Node tree = convert(value);
  if (tree.IsMap() && tree["topics"] && tree["topics"].IsMap()) {
    YAML::Node flat(YAML::NodeType::Map);
    flatten("", tree["topics"], flat);
    tree["topics"] = flat;
  }
  return tree;
}

Config configFromParameters(const ros::NodeHandle& node, const std::string& name) {
  Config config;
  XmlRpc::XmlRpcValue tree;
  if (node.getParam(name, tree)) {
    YAML::Node document = toYamlNode(tree);
    const std::string source = "parameters " + node.resolveName(name);
    for (const std::string& warning : renameFormerKeys(document, source)) {
      ROS_WARN_STREAM(warning);
    }
    readParameters(document, config, source);
    config.requireConsistent();
  }
  return config;
}

}  // namespace slipnav
