#pragma once
/// Fields of text files, independent of the locale.

#include <string>
#include <vector>

#include "slipnav/types.h"

namespace slipnav {

/// Pieces of a line between the given separators; empty pieces are left out.
std::vector<std::string> splitFields(const std::string& line, const char* separators = " \t\r");

/// The finite number that makes up the whole field. Throws std::invalid_argument that quotes anything else.
double parseNumber(const std::string& field);

/// As parseNumber(), for a whole number.
int parseInteger(const std::string& field);

/// Seconds in plain decimal notation to nanoseconds, exact to the ninth decimal; further ones are cut off. Throws
/// std::invalid_argument that quotes anything else.
Nanoseconds parseSeconds(const std::string& field);

/// Seconds with nine decimals, exact; the inverse of parseSeconds().
std::string formatSeconds(Nanoseconds t);

}  // namespace slipnav
