#include "ros/runtime/tuning_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace slipnav {
namespace {

using Values = dynamic_reconfigure::Config;

/// The group that contains all others; tools expect it under this name.
constexpr const char* kRootGroup = "Default";
constexpr double kLargest = std::numeric_limits<double>::max();

std::string blockOf(const std::string& key) { return key.substr(0, key.rfind('.')); }

/// Blocks in the order of their first parameter.
std::vector<std::string> blocksOf(const std::vector<ParameterInfo>& parameters) {
  std::vector<std::string> blocks;
  for (const ParameterInfo& parameter : parameters) {
    const std::string block = blockOf(parameter.key);
    if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) {
      blocks.push_back(block);
    }
  }
  return blocks;
}

const char* typeOf(const ParameterValue& value) {
  static const char* const kTypes[] = {"bool", "int", "double", "str"};
  return kTypes[value.index()];
}

template <class Messages, class Value>
void append(const std::string& name, const Value& value, Messages& messages) {
  messages.emplace_back();
  messages.back().name = name;
  messages.back().value = value;
}

void add(const std::string& name, const ParameterValue& value, Values& message) {
  if (const bool* flag = std::get_if<bool>(&value)) {
    append(name, *flag, message.bools);
  } else if (const int* integer = std::get_if<int>(&value)) {
    append(name, *integer, message.ints);
  } else if (const double* number = std::get_if<double>(&value)) {
    append(name, *number, message.doubles);
  } else {
    append(name, std::get<std::string>(value), message.strs);
  }
}

/// Limit of the field at one end of its range, in the field's own type.
ParameterValue limitOf(const ParameterInfo& parameter, double limit) {
  if (std::holds_alternative<int>(parameter.value)) {
    constexpr double kLeastInt = std::numeric_limits<int>::min();
    constexpr double kLargestInt = std::numeric_limits<int>::max();
    return static_cast<int>(std::clamp(limit, kLeastInt, kLargestInt));
  }
  if (std::holds_alternative<double>(parameter.value)) {
    return std::clamp(limit, -kLargest, kLargest);
  }
  return std::holds_alternative<bool>(parameter.value) ? ParameterValue(limit > 0.0) : ParameterValue(std::string());
}

std::vector<ParameterInfo> atLimit(std::vector<ParameterInfo> parameters, double Range::*limit) {
  for (ParameterInfo& parameter : parameters) {
    parameter.value = limitOf(parameter, parameter.range.*limit);
  }
  return parameters;
}

/// A choice, in the form that the tools evaluate.
std::string editMethod(const ParameterInfo& parameter) {
  std::string items;
  for (const std::string& option : parameter.options) {
    items += (items.empty() ? "" : ", ") + std::string("{'name': '") + option + "', 'type': 'str', 'value': '" +
             option + "', 'description': '" + option + "'}";
  }
  return items.empty() ? "" : "{'enum': [" + items + "], 'enum_description': '" + parameter.key + "'}";
}

dynamic_reconfigure::ParamDescription describe(const ParameterInfo& parameter) {
  dynamic_reconfigure::ParamDescription description;
  description.name = parameter.key;
  description.type = typeOf(parameter.value);
  description.description = parameter.meaning;
  description.edit_method = editMethod(parameter);
  return description;
}

template <class Messages>
void collect(const Messages& messages, std::vector<ParameterChange>& changes) {
  for (const auto& message : messages) {
    changes.push_back({message.name, message.value});
  }
}

}  // namespace

dynamic_reconfigure::Config toValues(const std::vector<ParameterInfo>& parameters) {
  Values message;
  for (const ParameterInfo& parameter : parameters) {
    add(parameter.key, parameter.value, message);
  }
  std::vector<std::string> names = blocksOf(parameters);
  names.insert(names.begin(), kRootGroup);
  for (std::size_t i = 0; i < names.size(); ++i) {
    dynamic_reconfigure::GroupState group;
    group.name = names[i];
    group.state = 1;
    group.id = static_cast<int>(i);
    message.groups.push_back(group);
  }
  return message;
}

dynamic_reconfigure::ConfigDescription toDescription(const std::vector<ParameterInfo>& parameters) {
  dynamic_reconfigure::ConfigDescription message;
  message.dflt = toValues(parameters);
  message.min = toValues(atLimit(parameters, &Range::min));
  message.max = toValues(atLimit(parameters, &Range::max));
  for (const dynamic_reconfigure::GroupState& state : message.dflt.groups) {
    dynamic_reconfigure::Group group;
    group.name = state.name;
    group.id = state.id;
    for (const ParameterInfo& parameter : parameters) {
      if (blockOf(parameter.key) == state.name) {
        group.parameters.push_back(describe(parameter));
      }
    }
    message.groups.push_back(group);
  }
  return message;
}

std::vector<ParameterChange> changesOf(const dynamic_reconfigure::Config& message) {
  std::vector<ParameterChange> changes;
  for (const dynamic_reconfigure::BoolParameter& flag : message.bools) {
    changes.push_back({flag.name, flag.value != 0});
  }
  collect(message.ints, changes);
  collect(message.doubles, changes);
  collect(message.strs, changes);
  return changes;
}

}  // namespace slipnav
