#include "io/rtklib_pos.h"

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "io/fields.h"
#include "io/gps_time.h"
#include "slipnav/core/earth/local_frame.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav {
namespace {

using Fields = std::vector<std::string>;

enum class TimeSystem { kGpst, kUtc, kJst };
enum class Layout { kDegrees, kDegreesMinutesSeconds, kEcef, kBaseline };

constexpr Nanoseconds kJstAheadOfUtc = 9 * 3600 * kSecond;

/// Time, three coordinates, Q, ns and the six elements of the covariance.
constexpr std::size_t kMinColumns = 12;
/// A time of one column takes two fields, an angle in degrees, minutes and seconds takes three.
constexpr std::size_t kTimeFields = 2;
constexpr std::size_t kAngleFields = 3;

struct Header {
  TimeSystem time_system = TimeSystem::kGpst;
  Layout layout = Layout::kDegrees;
  std::size_t field_count = 0;  ///< fields of a row
};

/// A position and the rotation from the axes of its covariance to north-east-down there.
struct Position {
  Geodetic geodetic;
  Matrix3 C_axes_to_ned;
};

Fields fieldsOf(const std::string& line) { return splitFields(line, " \t\r,;"); }

bool startsWith(const std::string& text, const std::string& head) { return text.compare(0, head.size(), head) == 0; }

Matrix3 enuToNed() {
  Matrix3 C;
  C << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return C;
}

std::optional<TimeSystem> timeSystemOf(const std::string& name) {
  if (name == "GPST") {
    return TimeSystem::kGpst;
  }
  if (name == "UTC") {
    return TimeSystem::kUtc;
  }
  return name == "JST" ? std::optional<TimeSystem>(TimeSystem::kJst) : std::nullopt;
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

Header parseHeader(TimeSystem time_system, const Fields& columns) {
  if (columns.size() < kMinColumns) {
    throw std::invalid_argument("the header names " + std::to_string(columns.size()) + " columns, fewer than " +
                                std::to_string(kMinColumns));
  }
  Header header;
  header.time_system = time_system;
  header.layout = layoutOf(columns[1]);
  header.field_count = columns.size() + kTimeFields - 1;
  if (header.layout == Layout::kDegreesMinutesSeconds) {
    header.field_count += 2 * (kAngleFields - 1);
  }
  return header;
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

/// Degrees from degrees, minutes and seconds; the sign stands before the degrees, which may be -0.
double parseDms(const Fields& fields, std::size_t at) {
  const double degrees = std::abs(numberField(fields[at]));
  const double magnitude = degrees + numberField(fields[at + 1]) / 60.0 + numberField(fields[at + 2]) / 3600.0;
  return fields[at].front() == '-' ? -magnitude : magnitude;
}

Vector3 parseVector(const Fields& fields, std::size_t at) {
  return {numberField(fields[at]), numberField(fields[at + 1]), numberField(fields[at + 2])};
}

Position fromDegrees(double latitude_deg, double longitude_deg, double height_m) {
  if (std::abs(latitude_deg) > 90.0 || std::abs(longitude_deg) > 360.0) {
    throw std::invalid_argument("latitude or longitude is out of range");
  }
  // the covariance comes as north, east, up
  return {{degToRad(latitude_deg), degToRad(longitude_deg), height_m},
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

Position fromBaseline(const Vector3& baseline_enu_m, const std::optional<Vector3>& reference_ecef_m) {
  if (!reference_ecef_m) {
    throw std::invalid_argument("a baseline without a '% ref pos' line before it");
  }
  const LocalFrame frame(Planet::byName("earth"), fromEcef(*reference_ecef_m).geodetic);
  const Geodetic geodetic = frame.toGeodetic(baseline_enu_m);
  return {geodetic, frame.C_n_to_enu(geodetic).transpose()};
}

Position parsePosition(const Header& header, const Fields& fields, const std::optional<Vector3>& reference_ecef_m) {
  switch (header.layout) {
    case Layout::kDegreesMinutesSeconds:
      return fromDegrees(parseDms(fields, kTimeFields), parseDms(fields, kTimeFields + kAngleFields),
                         numberField(fields[kTimeFields + 2 * kAngleFields]));
    case Layout::kEcef:
      return fromEcef(parseVector(fields, kTimeFields));
    case Layout::kBaseline:
      return fromBaseline(parseVector(fields, kTimeFields), reference_ecef_m);
    case Layout::kDegrees:
      break;
  }
  const Vector3 degrees = parseVector(fields, kTimeFields);
  return fromDegrees(degrees.x(), degrees.y(), degrees.z());
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

/// Rows of epochs that could not be solved.
bool hasNoSolution(const Header& header, const Fields& fields) {
  const std::size_t at = qualityField(header);
  return fields.size() > at && fields[at] == "0";
}

/// "% (lat/lon/height=WGS84/geodetic,...)": heights above the geoid, tens of meters from those above the ellipsoid.
void refuseGeodeticHeights(const Fields& fields) {
  for (const std::string& field : fields) {
    if (field.find("height=") != std::string::npos && field.find("geodetic") != std::string::npos) {
      throw std::invalid_argument(
          "heights are geodetic, above the geoid, and the geoid is not known here: write the solution again with "
          "ellipsoidal heights (rtkpost: Options, Output, Datum/Height)");
    }
  }
}

RtklibSolution parseRow(const Header& header, const Fields& fields, const std::optional<Vector3>& reference_ecef_m) {
  if (fields.size() < header.field_count) {
    throw std::invalid_argument(std::to_string(fields.size()) + " fields instead of " +
                                std::to_string(header.field_count));
  }
  const std::size_t quality_at = qualityField(header);
  const Position position = parsePosition(header, fields, reference_ecef_m);
  RtklibSolution solution;
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

class Reader {
 public:
  void readLine(const std::string& line) {
    Fields fields = fieldsOf(line);
    if (fields.empty()) {
      return;
    }
    if (fields.front().front() == '%') {
      readComment(fieldsOf(line.substr(line.find('%') + 1)));
    } else if (!header_) {
      throw std::invalid_argument("a solution before the header line that names the columns");
    } else if (hasNoSolution(*header_, fields)) {
      solutions_.emplace_back();
      solutions_.back().quality = RtklibQuality::kNone;
    } else {
      solutions_.push_back(parseRow(*header_, fields, reference_ecef_m_));
    }
  }

  std::vector<RtklibSolution> takeSolutions() { return std::move(solutions_); }

 private:
  void readComment(const Fields& fields) {
    if (fields.empty()) {
      return;
    }
    refuseGeodeticHeights(fields);
    if (const auto time_system = timeSystemOf(fields.front())) {
      header_ = parseHeader(*time_system, fields);
    } else if (fields.size() == 6 && fields[0] == "ref" && fields[1] == "pos") {
      reference_ecef_m_ = parseVector(fields, 3);
    }
  }

  std::optional<Header> header_;
  std::optional<Vector3> reference_ecef_m_;
  std::vector<RtklibSolution> solutions_;
};

}  // namespace

std::vector<RtklibSolution> readRtklibPos(std::istream& in, const std::string& name) {
  Reader reader;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    try {
      reader.readLine(line);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return reader.takeSolutions();
}

bool isRtklibFile(const std::string& name) {
  const std::string ending = ".pos";
  if (name.size() <= ending.size()) {
    return false;
  }
  return std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char wanted, char c) { return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
}

std::vector<RtklibSolution> readRtklibPos(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  return readRtklibPos(file, path);
}

}  // namespace slipnav
