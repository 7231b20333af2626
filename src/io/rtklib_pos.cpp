#include "io/rtklib_pos.h"

#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/fields.h"
#include "io/rtklib_row.h"

namespace slipnav {
namespace {

using rtklib::Fields;
using rtklib::fieldsOf;

constexpr char kByteOrderMark[] = "\xEF\xBB\xBF";

/// "% (lat/lon/height=Tokyo/geodetic,...)": heights above the geoid, tens of meters from those above the ellipsoid;
/// another datum, hundreds of meters from WGS84.
void refuseOtherDatum(const Fields& fields) {
  for (const std::string& field : fields) {
    if (field.find("height=") == std::string::npos) {
      continue;
    }
    if (field.find("tokyo") != std::string::npos) {
      throw std::invalid_argument(
          "positions use the Tokyo datum: write the solution again with WGS84 (rtkpost: Options, Output, "
          "Datum/Height)");
    }
    if (field.find("geodetic") != std::string::npos) {
      throw std::invalid_argument(
          "heights are geodetic, above the geoid, and the geoid is not known here: write the solution again with "
          "ellipsoidal heights (rtkpost: Options, Output, Datum/Height)");
    }
  }
}

class Reader {
 public:
  void readLine(const std::string& line) {
    const Fields fields = fieldsOf(line);
    if (fields.empty()) {
      return;
    }
    if (fields.front().front() == '%') {
      readComment(line.substr(line.find('%') + 1));
    } else if (fields.front().front() == '$') {
      throw std::invalid_argument(
          "NMEA sentences: write the solution as Lat/Lon/Height (rtkpost: Options, Output, Solution Format)");
    } else if (!header_) {
      throw std::invalid_argument("a solution before the header line that names the columns");
    } else {
      solutions_.push_back(rtklib::parseRow(*header_, fields, reference_));
    }
  }

  std::vector<RtklibSolution> takeSolutions() { return std::move(solutions_); }

 private:
  void readComment(const std::string& comment) {
    const Fields fields = fieldsOf(lowerCase(comment));
    if (fields.empty()) {
      return;
    }
    refuseOtherDatum(fields);
    if (const std::optional<rtklib::Header> header = rtklib::parseHeader(fields)) {
      header_ = header;
    } else if (fields.size() > 1 && fields[0] == "ref" && startsWith(fields[1], "pos")) {
      // a number of full width follows the colon without a space
      reference_ = fieldsOf(comment.substr(comment.find(':') + 1));
    }
  }

  std::optional<rtklib::Header> header_;
  Fields reference_;
  std::vector<RtklibSolution> solutions_;
};

}  // namespace

std::vector<RtklibSolution> readRtklibPos(std::istream& in, const std::string& name) {
  Reader reader;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1 && startsWith(line, kByteOrderMark)) {
      line.erase(0, sizeof kByteOrderMark - 1);
    }
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
  return name.size() > ending.size() && lowerCase(name.substr(name.size() - ending.size())) == ending;
}

std::vector<RtklibSolution> readRtklibPos(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw std::runtime_error("cannot read " + path);
  }
  return readRtklibPos(file, path);
}

}  // namespace slipnav
