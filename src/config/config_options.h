#pragma once
/// The options that every executable with a configuration shares.

#include "config/command_line.h"
#include "config/config.h"

namespace slipnav {

/// Declares --config, --topic and --set.
void declareConfigOptions(CommandLine& command_line);

/// The configuration selected by those options. Throws std::invalid_argument, see Config::load().
/// @param first files that come before those of the options
Config configFromOptions(const Arguments& arguments, std::vector<std::string> first = {});

}  // namespace slipnav
