#pragma once
/// A tuning in words for people, and as configuration.

#include <string>

#include "tuning/tuner.h"

namespace slipnav {

/// Table of all parameters that the drives tell, with 1σ and what either half alone says; what they do not tell; log
/// likelihood and NIS on what was held out, before and after; and whether it is worth it.
std::string tuningTable(const Config& config, const TuningResult& result);

/// What to change in the configuration, each value with its 1σ as a comment. A file for --config, after those that the
/// tuning began with.
std::string tuningYaml(const Config& config, const TuningResult& result);

}  // namespace slipnav
