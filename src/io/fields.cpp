#include "io/fields.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "core/base/text.h"

namespace slipnav {
namespace {

constexpr std::size_t kDecimals = 9;

/// Digits of seconds whose nanoseconds fit 64 bits.
constexpr std::size_t kMaxWholeDigits = 9 + 1;
constexpr Nanoseconds kMaxWholeSeconds = 9'000'000'000;

bool allDigits(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::vector<std::string> splitFields(const std::string& line, const char* separators) {
  std::vector<std::string> fields;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return fields;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

bool startsWith(const std::string& text, const std::string& head) { return text.compare(0, head.size(), head) == 0; }

double numberField(const std::string& field) {
  if (const auto value = parseNumber(field)) {
    return *value;
  }
  throw std::invalid_argument("'" + field + "' is not a number");
}

int integerField(const std::string& field) {
  if (const auto value = parseInteger(field)) {
    return *value;
  }
  throw std::invalid_argument("'" + field + "' is not a whole number");
}

Nanoseconds secondsField(const std::string& field) {
  const bool is_negative = !field.empty() && field.front() == '-';
  const std::string digits = field.substr(is_negative ? 1 : 0);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::string whole = digits.substr(0, point);
  std::string decimals = digits.substr(std::min(point + 1, digits.size()));
  if (whole.empty() || whole.size() > kMaxWholeDigits || !allDigits(whole) || !allDigits(decimals)) {
    throw std::invalid_argument("'" + field + "' is not a time in seconds");
  }
  const Nanoseconds seconds = std::stoll(whole);
  if (seconds > kMaxWholeSeconds) {
    throw std::invalid_argument("time of '" + field + "' s is out of range");
  }
  decimals.append(kDecimals, '0');
  const Nanoseconds t = seconds * kSecond + std::stoll(decimals.substr(0, kDecimals));
  return is_negative ? -t : t;
}

std::string formatSeconds(Nanoseconds t) {
  const Nanoseconds magnitude = t < 0 ? -t : t;
  const std::string decimals = std::to_string(magnitude % kSecond);
  return (t < 0 ? "-" : "") + std::to_string(magnitude / kSecond) + "." +
         std::string(kDecimals - decimals.size(), '0') + decimals;
}

void writeVector(std::ostream& out, const Vector3& v) { out << ',' << v.x() << ',' << v.y() << ',' << v.z(); }

}  // namespace slipnav
