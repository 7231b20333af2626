#pragma once
/// Reader of RTKLIB solution files (`.pos`), RTKLIB manual 2.4.2, appendix B.1, and as its functions outsolheads(),
/// outsols() and outrpos() write them.
///
/// Understood: latitude/longitude/height in degrees or degrees-minutes-seconds, ECEF, and east-north-up baselines with
/// a `% ref pos` line in degrees, degrees-minutes-seconds or ECEF; time as date or as week and seconds, in GPST, UTC or
/// JST; any of the field separators space, tab, comma, semicolon; names of columns in capitals or not; velocity
/// columns, including those of baselines, which the header names and the rows lack. Heights must be ellipsoidal and
/// positions WGS84: a file whose header says that they are geodetic (above the geoid) or use the Tokyo datum is
/// rejected, since neither is known here; so are NMEA sentences.

#include <istream>
#include <string>
#include <vector>

#include "slipnav/core/base/sensors.h"

namespace slipnav {

/// RTKLIB's quality flag Q.
enum class RtklibQuality {
  kNone = 0,
  kFix = 1,
  kFloat = 2,
  kSbas = 3,
  kDgps = 4,
  kSingle = 5,
  kPpp = 6,
  kDeadReckoning = 7
};

/// One row of a solution file.
struct RtklibSolution {
  bool solved() const { return flaw.empty(); }

  std::string flaw;  ///< what a row is that holds no position, as in "rows of quality 0"; "" for all others
  GnssFix fix;       ///< stamp is UNIX (UTC) time
  RtklibQuality quality = RtklibQuality::kSingle;
  int satellites = 0;
};

/// Whether the name has the ending of an RTKLIB solution file, in capitals or not.
bool isRtklibFile(const std::string& name);

/// Reads a file. Throws std::runtime_error that names the file, and the line if one cannot be understood: a bad
/// number or date, a row with fewer fields than the header names up to the ratio, rows without a header. Blank lines
/// are skipped. For a row of quality 0 (an epoch without solution, an invalid time mark) or with numbers that
/// are not finite only the flaw is set.
std::vector<RtklibSolution> readRtklibPos(const std::string& path);

/// The same from a stream; `name` stands for the file in messages.
std::vector<RtklibSolution> readRtklibPos(std::istream& in, const std::string& name);

}  // namespace slipnav
