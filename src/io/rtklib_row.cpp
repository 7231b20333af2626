#include "io/rtklib_row.h"

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "io/fields.h"
#include "io/gps_time.h"
#include "slipnav/core/earth/local_frame.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav::rtklib {
namespace {

constexpr Nanoseconds kJstAheadOfUtc = 9 * 3600 * kSecond;

/// Time, three coordinates, Q, ns and the six elements of the covariance.
constexpr std::size_t kMinColumns = 12;
/// The same, age and ratio. Velocities may follow, which baseline rows lack although their header names them.
constexpr std::size_t kMaxColumns = 14;
/// A time of one column takes two fields, an angle in degrees, minutes and seconds takes three.
constexpr std::size_t kTimeFields = 2;
constexpr std::size_t kAngleFields = 3;

/// Shorter than any distance from the center of the Earth, longer than any latitude, longitude or height.
constexpr double kLeastEcef_m = 1e6;

/// A position and the rotation from the axes of its covariance to north-east-down there.
struct Position {
  Geodetic geodetic;
  Matrix3 C_axes_to_ned;
};

Matrix3 enuToNed() {
  Matrix3 C;
  C << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return C;
}

std::optional<TimeSystem> timeSystemOf(const std::string& name) {
  if (name == "gpst") {
    return TimeSystem::kGpst;
  }
  if (name == "utc") {
    return TimeSystem::kUtc;
  }
  return name == "jst" ? std::optional<TimeSystem>(TimeSystem::kJst) : std::nullopt;
}

Layout layoutOf(const std::string& first_coordinate) {
  if (first_coordinate == "latitude(deg)") {
    return Layout::kDegrees;
  }
  if (startsWith(first_coordinate, "latitude(d'")) {
    return Layout::kDegreesMinutesSeconds;
  }
  if (first_coordinate == "x-ecef(m)") {
    return Layout::kEcef;
  }
  if (first_coordinate == "e-baseline(m)") {
    return Layout::kBaseline;
  }
  throw std::invalid_argument("unknown coordinates '" + first_coordinate + "'");
}

Nanoseconds parseCalendar(const std::string& date_text, const std::string& time_text) {
  const Fields date = splitFields(date_text, "/");
  const Fields time = splitFields(time_text, ":");
  if (date.size() != 3 || time.size() != 3) {
    throw std::invalid_argument("'" + date_text + " " + time_text + "' is not a date and time");
  }
  return calendarNanoseconds({integerField(date[0]), integerField(date[1]), integerField(date[2]),
                              integerField(time[0]), integerField(time[1]), secondsField(time[2])});
}

Nanoseconds parseStamp(const Header& header, const Fields& fields) {
  const bool is_date = fields[0].find('/') != std::string::npos;
  const Nanoseconds calendar = is_date ? parseCalendar(fields[0], fields[1])
                                       : calendarNanoseconds(integerField(fields[0]), secondsField(fields[1]));
  switch (header.time_system) {
    case TimeSystem::kGpst:
      return unixFromGpst(calendar);
    case TimeSystem::kJst:
      return calendar - kJstAheadOfUtc;
    case TimeSystem::kUtc:
      break;
  }
  return calendar;
}

Vector3 parseVector(const Fields& fields, std::size_t at) {
  return {numberField(fields[at]), numberField(fields[at + 1]), numberField(fields[at + 2])};
}

/// Degrees from degrees, minutes and seconds; the sign precedes the degrees, which may be -0.
double parseDms(const Fields& fields, std::size_t at) {
  const double degrees = std::abs(numberField(fields[at]));
  const double magnitude = degrees + numberField(fields[at + 1]) / 60.0 + numberField(fields[at + 2]) / 3600.0;
  return fields[at].front() == '-' ? -magnitude : magnitude;
}

/// Latitude [°], longitude [°] and height [m], both angles in degrees, minutes and seconds.
Vector3 parseDmsVector(const Fields& fields, std::size_t at) {
  return {parseDms(fields, at), parseDms(fields, at + kAngleFields), numberField(fields[at + 2 * kAngleFields])};
}

Position fromDegrees(const Vector3& degrees) {
  if (std::abs(degrees.x()) > 90.0 || std::abs(degrees.y()) > 360.0) {
    throw std::invalid_argument("latitude or longitude is out of range");
  }
  // the covariance comes as north, east, up
  return {{degToRad(degrees.x()), degToRad(degrees.y()), degrees.z()},
          Vector3(1.0, 1.0, -1.0).asDiagonal().toDenseMatrix()};
}

Position fromEcef(const Vector3& position_m) {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  std::vector<double> m(9);
  GeographicLib::Geocentric::WGS84().Reverse(position_m.x(), position_m.y(), position_m.z(), latitude_deg,
                                             longitude_deg, height_m, m);
  Matrix3 C_enu_to_ecef;
  C_enu_to_ecef << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  return {{degToRad(latitude_deg), degToRad(longitude_deg), height_m}, enuToNed() * C_enu_to_ecef.transpose()};
}

/// From a comment "ref pos : ...": degrees if the solutions are so or are baselines, ECEF if the solutions are.
Geodetic parseReference(const Fields& fields) {
  if (fields.size() == 2 * kAngleFields + 1) {
    return fromDegrees(parseDmsVector(fields, 0)).geodetic;
  }
  if (fields.size() != 3) {
    throw std::invalid_argument("the line '% ref pos' has " + std::to_string(fields.size()) +
                                " numbers instead of latitude, longitude, height");
  }
  const Vector3 reference = parseVector(fields, 0);
  return (reference.norm() > kLeastEcef_m ? fromEcef(reference) : fromDegrees(reference)).geodetic;
}

Position fromBaseline(const Vector3& baseline_enu_m, const Fields& reference) {
  if (reference.empty()) {
    throw std::invalid_argument(
        "a baseline, and no line '% ref pos : LATITUDE LONGITUDE HEIGHT' [deg, m] above it says where its base is: "
        "write one into the file");
  }
  const LocalFrame frame(Planet::byName("earth"), parseReference(reference));
  const Geodetic geodetic = frame.toGeodetic(baseline_enu_m);
  return {geodetic, frame.C_n_to_enu(geodetic).transpose()};
}

Position parsePosition(const Header& header, const Fields& fields, const Fields& reference) {
  switch (header.layout) {
    case Layout::kDegreesMinutesSeconds:
      return fromDegrees(parseDmsVector(fields, kTimeFields));
    case Layout::kEcef:
      return fromEcef(parseVector(fields, kTimeFields));
    case Layout::kBaseline:
      return fromBaseline(parseVector(fields, kTimeFields), reference);
    case Layout::kDegrees:
      break;
  }
  return fromDegrees(parseVector(fields, kTimeFields));
}

/// Covariance in the file's axes 1, 2, 3 from its roots in the order 11, 22, 33, 12, 23, 31; those of the off-diagonal
/// elements carry the sign of the element.
Matrix3 parseCovariance(const Fields& fields, std::size_t at) {
  std::array<double, 6> element{};
  for (std::size_t i = 0; i < element.size(); ++i) {
    const double root = numberField(fields[at + i]);
    element[i] = root * std::abs(root);
  }
  Matrix3 covariance;
  covariance << element[0], element[3], element[5], element[3], element[1], element[4], element[5], element[4],
      element[2];
  return covariance;
}

RtklibQuality parseQuality(const std::string& field) {
  const int value = integerField(field);
  if (value < static_cast<int>(RtklibQuality::kFix) || value > static_cast<int>(RtklibQuality::kDeadReckoning)) {
    throw std::invalid_argument("quality '" + field + "' is not in 1 to 7");
  }
  return static_cast<RtklibQuality>(value);
}

std::size_t qualityField(const Header& header) {
  const bool is_dms = header.layout == Layout::kDegreesMinutesSeconds;
  return kTimeFields + (is_dms ? 2 * kAngleFields + 1 : 3);
}

bool isNotFinite(const std::string& field) {
  const std::string text = lowerCase(field);
  return text.find("nan") != std::string::npos || text.find("inf") != std::string::npos;
}

/// What is wrong with a row without a position, or "". An event file marks a time mark with "Q=0, ...".
std::string flawOf(const Header& header, const Fields& fields) {
  const std::size_t quality_at = qualityField(header);
  if ((fields.size() > quality_at && fields[quality_at] == "0") ||
      (fields.size() > kTimeFields && fields[kTimeFields] == "Q=0")) {
    return "of quality 0, without a solution";
  }
  const auto used = fields.begin() + static_cast<std::ptrdiff_t>(std::min(fields.size(), quality_at + 8));
  return std::any_of(fields.begin(), used, isNotFinite) ? "with numbers that are not finite" : "";
}

}  // namespace

Fields fieldsOf(const std::string& line) { return splitFields(line, " \t\r,;"); }

std::optional<Header> parseHeader(const Fields& columns) {
  const std::optional<TimeSystem> time_system = timeSystemOf(columns.front());
  if (!time_system) {
    return std::nullopt;
  }
  if (columns.size() < kMinColumns) {
    throw std::invalid_argument("the header names " + std::to_string(columns.size()) + " columns, fewer than " +
                                std::to_string(kMinColumns));
  }
  Header header;
  header.time_system = *time_system;
  header.layout = layoutOf(columns[1]);
  header.field_count = std::min(columns.size(), kMaxColumns) + kTimeFields - 1;
  if (header.layout == Layout::kDegreesMinutesSeconds) {
    header.field_count += 2 * (kAngleFields - 1);
  }
  return header;
}

RtklibSolution parseRow(const Header& header, const Fields& fields, const Fields& reference) {
  RtklibSolution solution;
  solution.flaw = flawOf(header, fields);
  if (!solution.solved()) {
    solution.quality = RtklibQuality::kNone;
    return solution;
  }
  if (fields.size() < header.field_count) {
    throw std::invalid_argument(std::to_string(fields.size()) + " fields instead of " +
                                std::to_string(header.field_count));
  }
  const std::size_t quality_at = qualityField(header);
  const Position position = parsePosition(header, fields, reference);
  solution.fix.stamp = parseStamp(header, fields);
  solution.fix.latitude_deg = radToDeg(position.geodetic.latitude_rad);
  solution.fix.longitude_deg = radToDeg(position.geodetic.longitude_rad);
  solution.fix.height_m = position.geodetic.height_m;
  solution.fix.covariance_ned_m2 =
      position.C_axes_to_ned * parseCovariance(fields, quality_at + 2) * position.C_axes_to_ned.transpose();
  solution.quality = parseQuality(fields[quality_at]);
  solution.satellites = integerField(fields[quality_at + 1]);
  return solution;
}

}  // namespace slipnav::rtklib
