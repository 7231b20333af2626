#pragma once
/// Reader of RTKLIB solution files (`.pos`), RTKLIB manual 2.4.2, appendix B.1.
///
/// Understood: latitude/longitude/height in degrees or degrees-minutes-seconds, ECEF, and east-north-up baselines with
/// a `% ref pos` line in degrees or ECEF; time as date or as week and seconds, in GPST, UTC or JST; any of the field
/// separators space, tab, comma, semicolon. Heights have to be
/// ellipsoidal: a file whose header says that they are geodetic (above the geoid) is refused, since no geoid is known
/// here.

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
  bool solved() const { return quality != RtklibQuality::kNone; }

  GnssFix fix;  ///< stamp is UNIX (UTC) time
  RtklibQuality quality = RtklibQuality::kSingle;
  int satellites = 0;
};

/// Whether a name is that of an RTKLIB solution file, by its ending, in capitals or not.
bool isRtklibFile(const std::string& name);

/// Reads a file. Throws std::runtime_error that names the file, and the line where one cannot be understood: a bad
/// number or date, a row with fewer fields than the header names, rows without a header. Blank lines are skipped. Of a
/// row of quality 0, an epoch without solution, only that is said.
std::vector<RtklibSolution> readRtklibPos(const std::string& path);

/// The same from a stream; `name` stands for the file in messages.
std::vector<RtklibSolution> readRtklibPos(std::istream& in, const std::string& name);

}  // namespace slipnav
