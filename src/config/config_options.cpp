#include "config/config_options.h"

#include "config/legacy_start.h"

namespace slipnav {

void declareConfigOptions(CommandLine& command_line) {
  command_line.repeated("config", "YAML", "configuration file; later ones win")
      .repeated("legacy-start", "YAML", "init_params.yaml of the paper's software: start, heading and biases")
      .repeated("topic", "NAME:=OTHER", "what the robot or the recording calls a topic")
      .repeated("set", "BLOCK.KEY=VALUE", "one setting, overriding the files");
}

Config configFromOptions(const Arguments& arguments, std::vector<std::string> first) {
  std::vector<Override> overrides;
  for (const std::string& file : arguments.all("legacy-start")) {
    const std::vector<Override> start = legacyStart(file);
    overrides.insert(overrides.end(), start.begin(), start.end());
  }
  for (const std::string& argument : arguments.all("topic")) {
    overrides.push_back(topicOverride(argument));
  }
  for (const std::string& argument : arguments.all("set")) {
    overrides.push_back(keyOverride(argument));
  }
  const std::vector<std::string>& given = arguments.all("config");
  first.insert(first.end(), given.begin(), given.end());
  return Config::load(first, overrides);
}

}  // namespace slipnav
