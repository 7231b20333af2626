#pragma once
/// Between parameters and the messages of dynamic_reconfigure.

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include <vector>

#include "config/tuning.h"

namespace slipnav {

/// The values only, in groups by block.
dynamic_reconfigure::Config toValues(const std::vector<ParameterInfo>& parameters);

/// Names, types, ranges, choices and meanings; the values count as defaults.
dynamic_reconfigure::ConfigDescription toDescription(const std::vector<ParameterInfo>& parameters);

/// All values of a message.
std::vector<ParameterChange> changesOf(const dynamic_reconfigure::Config& message);

}  // namespace slipnav
