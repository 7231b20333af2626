#pragma once
/// Fields of text files, independent of the locale.

#include <ostream>
#include <string>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Pieces of a line between the given separators; empty pieces are dropped.
std::vector<std::string> splitFields(const std::string& line, const char* separators = " \t\r");

/// With ASCII letters in lower case, in any locale.
std::string lowerCase(std::string text);
bool startsWith(const std::string& text, const std::string& head);

/// The finite number that fills the whole field. Throws std::invalid_argument that quotes anything else.
double numberField(const std::string& field);

/// As numberField(), for a whole number.
int integerField(const std::string& field);

/// Seconds in plain decimal notation to nanoseconds, exact to the ninth decimal; further ones are truncated. Throws
/// std::invalid_argument that quotes anything else.
Nanoseconds secondsField(const std::string& field);

/// Seconds with nine decimals, exact; the inverse of secondsField().
std::string formatSeconds(Nanoseconds t);

/// The components, each preceded by a comma.
void writeVector(std::ostream& out, const Vector3& v);

}  // namespace slipnav
