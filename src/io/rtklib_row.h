#pragma once
/// Rows of RTKLIB solution files, and the header line that names their columns. Parts of rtklib_pos.h.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/rtklib_pos.h"

namespace slipnav::rtklib {

using Fields = std::vector<std::string>;

/// Of the stamps.
enum class TimeSystem { kGpst, kUtc, kJst };
/// How a position is written.
enum class Layout { kDegrees, kDegreesMinutesSeconds, kEcef, kBaseline };

/// What the header line says.
struct Header {
  TimeSystem time_system = TimeSystem::kGpst;
  Layout layout = Layout::kDegrees;
  std::size_t field_count = 0;  ///< fields of a row
};

/// Fields between any of the separators that RTKLIB offers.
Fields fieldsOf(const std::string& line);

/// The header line from its columns in lower case; nothing for other comments. Throws std::invalid_argument for columns
/// that are not those of a solution.
std::optional<Header> parseHeader(const Fields& columns);

/// One row. @param reference fields of the comment "ref pos", the origin of baselines; empty if there was none.
/// Throws std::invalid_argument that says what cannot be understood.
RtklibSolution parseRow(const Header& header, const Fields& fields, const Fields& reference);

}  // namespace slipnav::rtklib
