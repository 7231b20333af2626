#pragma once
/// The text of the overlay.

#include <string>

#include "ros/rviz/marker_builder.h"
#include "ros/rviz/overlay_markers.h"

namespace slipnav {

/// Printf-style number: `formatted(0.123, 2)` is "0.12".
std::string formatted(double value, int decimals);

/// What the colors mean; placed relative to the rover.
void drawLegend(const OverlayParams& params, MarkerBuilder& sketch);

}  // namespace slipnav
