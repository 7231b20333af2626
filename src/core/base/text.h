#pragma once
/// Small text helpers of the configuration: numbers that survive a round trip, and the name that was probably meant.

#include <optional>
#include <string>
#include <vector>

namespace slipnav {

/// Shortest decimal text that reads back as the same double, whatever the process locale.
std::string formatNumber(double value);

/// A decimal number with or without a dot ("1e-9"), whatever the process locale; nothing unless all of `text` is a
/// finite number.
std::optional<double> parseNumber(const std::string& text);

/// A decimal integer; nothing unless all of `text` is one and it fits.
std::optional<int> parseInteger(const std::string& text);

/// "a, b or c".
std::string joinAlternatives(const std::vector<std::string>& names);

/// Levenshtein distance: insertions, deletions and substitutions that turn one text into the other.
std::size_t editDistance(const std::string& a, const std::string& b);

/// The candidate with the smallest edit distance to `name` (the first if tied), "" if there is none. Only the beginning
/// of an implausibly long name is compared.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace slipnav
