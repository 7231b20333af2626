#include "ros/rviz/overlay_legend.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace slipnav {
namespace {

using visualization_msgs::Marker;

constexpr double kLineSpacing = 1.5;   ///< of text, as a multiple of its height
constexpr double kLetterWidth = 0.42;  ///< mean, as a multiple of the height
constexpr double kSwatchLength_m = 1.6;
constexpr double kSwatchWidth_m = 0.25;
constexpr double kAboveGround_m = 1.5;  ///< all words float above whatever lies on the ground

/// Approximate width of a line of text: rviz centers it, and does not report its length.
double widthOf(const std::string& words, double letter_height_m) {
  return kLetterWidth * letter_height_m * static_cast<double>(words.size());
}

std::string errorLine(const DriveView& picture) {
  const std::optional<double> error_m = picture.horizontalError();
  if (!error_m) {
    return "";
  }
  std::string line = "    error " + formatted(*error_m, 2) + " m";
  if (picture.distance() > 1.0) {
    line += " = " + formatted(100.0 * *error_m / picture.distance(), 2) + " %";
  }
  return line;
}

/// One line of the legend: a swatch that blends one color into another, and its meaning.
struct Entry {
  Color from;
  Color to;
  std::string meaning;
};

std::array<Entry, 8> legendEntries(const OverlayParams& params) {
  const std::string full = formatted(params.slip_full_scale, 1);
  return {{{kEstimateColor, kEstimateColor, "estimate, 3 sigma"},
           {kTruthColor, kTruthColor, "truth"},
           {kDeadReckoningColor, kDeadReckoningColor, "wheels and gyro alone"},
           {kErrorColor, kErrorColor, "error"},
           {kStopColor, kStopColor, "stop: error before > after"},
           {kSkiddingColor, kNoSlipColor, "slip -" + full + " to 0"},
           {kNoSlipColor, kSpinningColor, "slip 0 to " + full},
           {kSafeColor, kLimitColor, "forecast: 0 to threshold"}}};
}

}  // namespace

std::string formatted(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const double unit = std::pow(10.0, decimals);
  const double rounded = std::round(value * unit) / unit;
  out << std::fixed << std::setprecision(decimals) << rounded + 0.0;  // no negative zero
  return out.str();
}

std::string figuresOf(const DriveView& picture) {
  return "distance " + formatted(picture.distance(), 1) + " m" + errorLine(picture) + "    3σ " +
         formatted(picture.horizontalBound(), 2) + " m";
}

void drawLegend(const OverlayParams& params, MarkerBuilder& sketch) {
  Marker lines;
  int row = 0;
  for (const Entry& entry : legendEntries(params)) {
    const double north_m = params.legend_north_m - kLineSpacing * params.text_height_m * row;
    const Vector3 begin(params.legend_east_m, north_m, kAboveGround_m);
    const Vector3 end = begin + Vector3(kSwatchLength_m, 0.0, 0.0);
    lines.points.insert(lines.points.end(), {toPoint(begin), toPoint(end)});
    lines.colors.insert(lines.colors.end(), {toMessage(entry.from), toMessage(entry.to)});
    const double half_width_m = 0.5 * widthOf(entry.meaning, params.text_height_m);
    sketch.text("legend", row + 1, end + Vector3(params.text_height_m + half_width_m, 0.0, 0.0), params.text_height_m,
                kTextColor, entry.meaning);
    ++row;
  }
  Marker& swatches = sketch.add("legend", 0, Marker::LINE_LIST, kSwatchWidth_m, kTextColor);
  swatches.points = lines.points;
  swatches.colors = lines.colors;
}

}  // namespace slipnav
