#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>

namespace slipnav {
namespace {

/// With fewer, 50 would print as 5e+01.
constexpr int kUsualDigits = 6;

/// A corrupted file may contain a name of a megabyte, which would be compared with every candidate.
constexpr std::size_t kLongestName = 100;

template <class Value>
std::optional<Value> parseAll(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Value value{};
  if (!(stream >> std::noskipws >> value) || stream.peek() != std::istringstream::traits_type::eof()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

std::string formatNumber(double value) {
  std::string text;
  for (int digits = kUsualDigits; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    text = stream.str();
    if (parseNumber(text) == value) {
      break;
    }
  }
  return text;
}

std::optional<double> parseNumber(const std::string& text) {
  const std::optional<double> value = parseAll<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> parseInteger(const std::string& text) { return parseAll<int>(text); }

std::string joinAlternatives(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) {
      text += i + 1 == names.size() ? " or " : ", ";
    }
    text += names[i];
  }
  return text;
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min(substitution, std::min(row[j], row[j - 1]) + 1);
    }
  }
  return row[b.size()];
}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string start = name.substr(0, kLongestName);
  std::string nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(start.size(), candidate.size());
    const std::size_t shorter = std::min(start.size(), candidate.size());
    if (longer - shorter >= least) {  // and the distance is no less
      continue;
    }
    const std::size_t distance = editDistance(start, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace slipnav
