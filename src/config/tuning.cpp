#include "config/tuning.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "config/override.h"
#include "config/yaml_reader.h"

namespace slipnav {
namespace {

/// Keys, or whole blocks. Anything else needs a new start: the state would no longer fit, as with another
/// wheel geometry, or the change would have no effect, as with the prior of something already learned.
const std::map<std::string, std::vector<std::string>>& offers() {
  static const std::map<std::string, std::vector<std::string>> kOffers = {
      {"Filter",
       {"filter.gate_alpha", "filter.zero_velocity_gate_alpha", "filter.max_rejection_s", "wheel.speed_std_mps",
        "wheel.slip_noise_std", "wheel.yaw_rate_std_deg_per_s", "wheel.yaw_rate_scale_std", "nonholonomic",
        "zero_motion.min_velocity_std_mps", "zero_motion.max_velocity_std_mps", "zero_motion.adaptation_samples",
        "zero_motion.rate_std_deg_per_h", "stationary"}},
      {"Forecast",
       {"forecast.threshold_m", "forecast.sigmas", "forecast.window_s", "forecast.interval_s", "forecast.horizon_s",
        "forecast.max_age_s", "forecast.speed_window_s"}},
      {"StopSupervisor", {"stop"}}};
  return kOffers;
}

bool isOffered(const std::string& key, const std::vector<std::string>& offered) {
  return std::any_of(offered.begin(), offered.end(), [&key](const std::string& entry) {
    return key == entry || key.compare(0, entry.size() + 1, entry + ".") == 0;
  });
}

Override toOverride(const ParameterChange& change) {
  Override item{{}, toText(change.value), ""};
  std::istringstream names(change.key);
  for (std::string name; std::getline(names, name, '.');) {
    item.path.push_back(name);
  }
  return item;
}

}  // namespace

std::vector<ParameterInfo> tunableParameters(const std::string& nodelet, const Config& config) {
  std::vector<ParameterInfo> parameters = listParameters(config);
  const std::vector<std::string>& offered = offers().at(nodelet);
  parameters.erase(std::remove_if(parameters.begin(), parameters.end(),
                                  [&](const ParameterInfo& parameter) { return !isOffered(parameter.key, offered); }),
                   parameters.end());
  return parameters;
}

std::set<std::string> tunableKeys() {
  std::set<std::string> keys;
  for (const auto& [nodelet, offered] : offers()) {
    for (const ParameterInfo& parameter : tunableParameters(nodelet, Config{})) {
      keys.insert(parameter.key);
    }
  }
  return keys;
}

Config withChanges(Config config, const std::vector<ParameterChange>& changes) {
  for (const ParameterChange& change : changes) {
    readParameters(toYamlNode(toOverride(change)), config);
  }
  config.requireConsistent();
  return config;
}

std::vector<ParameterDifference> differences(const std::vector<ParameterInfo>& before,
                                             const std::vector<ParameterInfo>& after) {
  std::vector<ParameterDifference> found;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].value != after[i].value) {
      found.push_back({before[i].key, before[i].value, after[i].value});
    }
  }
  return found;
}

std::string toText(const std::vector<ParameterDifference>& differences) {
  std::string text;
  for (const ParameterDifference& item : differences) {
    text += (text.empty() ? "" : ", ") + item.key + " from " + toText(item.before) + " to " + toText(item.after);
  }
  return text;
}

}  // namespace slipnav
