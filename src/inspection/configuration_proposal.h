#pragma once
/// A configuration from a drive: only what the drive determines reliably, each value with its reason.

#include <string>

#include "inspection/inspection.h"

namespace slipnav {

/// YAML for --config of all commands. @param source its origin, for the first line
std::string proposedYaml(const Inspection& inspection, const InspectionOptions& options, const std::string& source);

}  // namespace slipnav
