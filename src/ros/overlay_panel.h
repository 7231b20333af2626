#pragma once
/// The words of the overlay: panel and legend.

#include <string>

#include "marker_sketch.h"
#include "slipnav/ros/overlay_markers.h"

namespace slipnav {

/// Printf-style number: `formatted(0.123, 2)` is "0.12".
std::string formatted(double value, int decimals);

/// Supervisor, slip, distance and error in a few lines. This and the legend are placed from the rover.
void drawPanel(const DrivePicture& picture, const OverlayMessages& messages, const OverlayParams& params,
               MarkerSketch& sketch);

/// What the colours mean.
void drawLegend(const OverlayParams& params, MarkerSketch& sketch);

}  // namespace slipnav
