#pragma once
/// A configuration from a drive: only what the drive is sure of, each value with its reason.

#include <string>

#include "inspection/inspection.h"

namespace slipnav {

/// YAML for --config of all commands. @param source what it comes from, for the first line
std::string proposedYaml(const Inspection& inspection, const InspectionOptions& options, const std::string& source);

}  // namespace slipnav
