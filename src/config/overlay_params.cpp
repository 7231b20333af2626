#include "config/overlay_params.h"

namespace slipnav {

void OverlayParams::visit(ParameterVisitor& v) {
  v.number("publish_period_s", publish_period_s, {0.05, 60.0}, "how often paths and markers are published [s]");
  v.number("point_spacing_m", point_spacing_m, {1e-3, 100.0}, "distance between the points of a path [m]");
  v.integer("max_points", max_points, {4, 1e6}, "points of a path beyond which it is thinned out");
  v.integer("max_stops", max_stops, {0, 1e4}, "stops beyond which the oldest are no longer shown");
  v.flag("flat", flat, "draw the truth at the height of the estimate, so that neither hides the other from above");
  v.number("slip_full_scale", slip_full_scale, {0.001, 1.0}, "slip ratio shown in full color");
  v.number("text_height_m", text_height_m, {0.01, 100.0}, "size of all text [m]");
  v.text("frame", frame, "frame_id of the overlay: at the rover, aligned with the map");
  v.number("legend_east_m", legend_east_m, {-1e3, 1e3}, "upper left corner of the legend, from the rover [m]");
  v.number("legend_north_m", legend_north_m, {-1e3, 1e3}, "likewise [m]");
}

}  // namespace slipnav
