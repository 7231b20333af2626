#include "text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace slipnav {
namespace {

constexpr std::size_t kDecimals = 9;
constexpr Nanoseconds kSecond = 1'000'000'000;

/// Digits of seconds whose nanoseconds fit 64 bits.
constexpr std::size_t kMaxWholeDigits = 9 + 1;
constexpr Nanoseconds kMaxWholeSeconds = 9'000'000'000;

bool allDigits(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

template <class Number>
Number parse(const std::string& field, const char* kind) {
  std::istringstream in(field);
  in.imbue(std::locale::classic());
  Number value{};
  in >> value;
  if (in.fail() || in.peek() != std::istringstream::traits_type::eof()) {
    throw std::invalid_argument("'" + field + "' is not " + kind);
  }
  return value;
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

double parseNumber(const std::string& field) {
  const auto value = parse<double>(field, "a number");
  if (!std::isfinite(value)) {
    throw std::invalid_argument("'" + field + "' is not a finite number");
  }
  return value;
}

int parseInteger(const std::string& field) { return parse<int>(field, "a whole number"); }

Nanoseconds parseSeconds(const std::string& field) {
  const bool is_negative = !field.empty() && field.front() == '-';
  const std::string digits = field.substr(is_negative ? 1 : 0);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::string whole = digits.substr(0, point);
  std::string decimals = digits.substr(std::min(point + 1, digits.size()));
  if (whole.empty() || whole.size() > kMaxWholeDigits || !allDigits(whole) || !allDigits(decimals)) {
    throw std::invalid_argument("'" + field + "' is not a time in seconds");
  }
  const auto seconds = parse<Nanoseconds>(whole, "a time in seconds");
  if (seconds > kMaxWholeSeconds) {
    throw std::invalid_argument("time of '" + field + "' s is out of range");
  }
  decimals.resize(kDecimals, '0');
  const Nanoseconds t = seconds * kSecond + parse<Nanoseconds>(decimals, "a time in seconds");
  return is_negative ? -t : t;
}

std::string formatSeconds(Nanoseconds t) {
  const Nanoseconds magnitude = t < 0 ? -t : t;
  const std::string decimals = std::to_string(magnitude % kSecond);
  return (t < 0 ? "-" : "") + std::to_string(magnitude / kSecond) + "." +
         std::string(kDecimals - decimals.size(), '0') + decimals;
}

}  // namespace slipnav
