#pragma once
/// Which parameters may be changed while the nodelets run, and the configuration after a change.

#include <set>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/parameter_list.h"

namespace slipnav {

/// A new value of one parameter.
struct ParameterChange {
  std::string key;  ///< full dotted key
  ParameterValue value;
};

/// The parameters `nodelet` ("Filter") lets users change, with the values of `config`, in the order of the
/// configuration. No parameter is offered by two nodelets.
std::vector<ParameterInfo> tunableParameters(const std::string& nodelet, const Config& config);

/// The keys of all parameters that some nodelet offers.
std::set<std::string> tunableKeys();

/// The configuration with new values. Throws std::invalid_argument with one line that names the key and what is wrong:
/// missing, of another type, out of range, or in contradiction to another value.
Config withChanges(Config config, const std::vector<ParameterChange>& changes);

/// One parameter before and after a change.
struct ParameterDifference {
  std::string key;
  ParameterValue before;
  ParameterValue after;
};

/// Differences between two lists of the same parameters.
std::vector<ParameterDifference> differences(const std::vector<ParameterInfo>& before,
                                             const std::vector<ParameterInfo>& after);

/// In words: "forecast.threshold_m from 3 to 2", separated by commas.
std::string toText(const std::vector<ParameterDifference>& differences);

}  // namespace slipnav
