#pragma once
/// A tuning as text, and as configuration.

#include <string>

#include "tuning/tuner.h"

namespace slipnav {

/// Table of all parameters that the drives determine, with 1σ and the values from either half; those they do not; log
/// likelihood and NIS on held-out data, before and after; and whether it is worth it.
std::string tuningTable(const Config& config, const TuningResult& result);

/// What to change in the configuration, each value with its 1σ as a comment. A file for --config, after those that the
/// tuning started from.
std::string tuningYaml(const Config& config, const TuningResult& result);

}  // namespace slipnav
