#include "overlay_panel.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace slipnav {
namespace {

constexpr double kLineSpacing = 1.5;   ///< of text, as a multiple of its height
constexpr double kLetterWidth = 0.46;  ///< mean, as a multiple of the height
constexpr double kSwatchLength_m = 1.6;
constexpr double kSwatchWidth_m = 0.25;
constexpr double kAboveGround_m = 1.5;  ///< all words float above whatever lies on the ground

std::string supervisorLine(const DrivePicture& picture, const StopStatus* stop) {
  if (stop == nullptr || stop->mode == StopStatus::MODE_OFF) {
    return picture.isStationary() ? "STANDING" : "DRIVING";
  }
  const bool timed = std::isfinite(stop->time_left_s);
  const std::string left = timed ? formatted(stop->time_left_s, 0) + " s" : "";
  switch (stop->state) {
    case StopStatus::COUNTING_DOWN:
      return "STOP IN " + left;
    case StopStatus::STOPPING:
      return "STOPPING";
    case StopStatus::HOLDING:
      return timed ? "HOLDING, " + left + " left" : "HOLDING";
    default:
      return timed ? "DRIVING, stop in " + left : "DRIVING";
  }
}

std::string errorLine(const DrivePicture& picture) {
  const std::optional<double> error_m = picture.horizontalError();
  if (!error_m) {
    return "error: no truth";
  }
  std::string line = "error " + formatted(*error_m, 2) + " m";
  if (picture.distance() > 1.0) {
    line += " = " + formatted(100.0 * *error_m / picture.distance(), 2) + " %";
  }
  return line;
}

std::string forecastLine(const ErrorForecast& forecast) {
  return "forecast " + formatted(forecast.horizontal_bound_m.back(), 2) + " m of " +
         formatted(forecast.threshold_m, 1) + " m in " + formatted(forecast.times_s.back(), 0) + " s";
}

/// One line of the legend: a swatch that goes from one colour to another, and what it means.
struct Entry {
  Colour from;
  Colour to;
  std::string meaning;
};

std::array<Entry, 8> legendEntries(const OverlayParams& params) {
  const std::string full = formatted(params.slip_full_scale, 1);
  return {{{kEstimateColour, kEstimateColour, "estimate, 3 sigma"},
           {kTruthColour, kTruthColour, "truth (DGPS)"},
           {kDeadReckoningColour, kDeadReckoningColour, "wheels and gyro alone"},
           {kErrorColour, kErrorColour, "error"},
           {kStopColour, kStopColour, "stop: error before > after"},
           {kSkiddingColour, kNoSlipColour, "slip -" + full + " to 0"},
           {kNoSlipColour, kSpinningColour, "slip 0 to " + full},
           {kSafeColour, kLimitColour, "forecast: 0 to threshold"}}};
}

}  // namespace

std::string formatted(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

void drawPanel(const DrivePicture& picture, const OverlayMessages& messages, const OverlayParams& params,
               MarkerSketch& sketch) {
  std::string words = supervisorLine(picture, messages.stop.get());
  words += "\nslip " + (picture.slip() ? formatted(*picture.slip(), 2) : std::string("-"));
  words += "\ndistance " + formatted(picture.distance(), 1) + " m";
  words += "\n" + errorLine(picture);
  words += "\n3 sigma " + formatted(picture.horizontalBound(), 2) + " m";
  if (messages.error_forecast && !messages.error_forecast->horizontal_bound_m.empty()) {
    words += "\n" + forecastLine(*messages.error_forecast);
  }
  const Vector3 offset(params.panel_east_m, params.panel_north_m, kAboveGround_m);
  sketch.text("panel", 0, picture.newest()->position_enu_m + offset, params.text_height_m, kTextColour, words);
}

void drawLegend(const DrivePicture& picture, const OverlayParams& params, MarkerSketch& sketch) {
  const Vector3 offset(params.legend_east_m, params.legend_north_m, kAboveGround_m);
  const Vector3 corner = picture.newest()->position_enu_m + offset;
  // The pointer to the swatches is not kept: further markers move the array.
  visualization_msgs::Marker swatches;
  int row = 0;
  for (const Entry& entry : legendEntries(params)) {
    const Vector3 begin = corner - Vector3(0.0, kLineSpacing * params.text_height_m * row, 0.0);
    const Vector3 end = begin + Vector3(kSwatchLength_m, 0.0, 0.0);
    const double half_width_m = 0.5 * kLetterWidth * params.text_height_m * static_cast<double>(entry.meaning.size());
    swatches.points.insert(swatches.points.end(), {toPoint(begin), toPoint(end)});
    swatches.colors.insert(swatches.colors.end(), {toMessage(entry.from), toMessage(entry.to)});
    sketch.text("legend", row + 1, end + Vector3(params.text_height_m + half_width_m, 0.0, 0.0), params.text_height_m,
                kTextColour, entry.meaning);
    ++row;
  }
  visualization_msgs::Marker& lines =
      sketch.add("legend", 0, visualization_msgs::Marker::LINE_LIST, kSwatchWidth_m, kTextColour);
  lines.points = swatches.points;
  lines.colors = swatches.colors;
}

}  // namespace slipnav
