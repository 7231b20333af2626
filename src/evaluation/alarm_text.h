#pragma once
/// Alarms as text.

#include <string>
#include <utility>
#include <vector>

#include "slipnav/core/navigation/health.h"

namespace slipnav {

/// Earliest first.
std::vector<std::pair<std::string, Alarm>> inOrderOfAppearance(const Alarms& alarms);

/// One line per alarm: "`prefix`: what (3 times, 12.5 s to 14.0 s)", in seconds since `begin`.
std::string alarmLines(const std::string& prefix, const Alarms& alarms, Nanoseconds begin);

}  // namespace slipnav
