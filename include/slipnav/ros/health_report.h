#pragma once
/// What a HealthMonitor has found, as diagnostics.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include "slipnav/navigator/health.h"

namespace slipnav {

/// Adds one line for each thing that has ever been wrong; those of the last seconds before `now` make it a warning.
void report(const HealthMonitor& health, Nanoseconds now, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace slipnav
