#include "evaluation/json_object.h"

#include <cmath>
#include <iomanip>

#include "core/base/text.h"
#include "io/fields.h"

namespace slipnav {
namespace {

/// In quotation marks. Anything but printable ASCII or UTF-8 is escaped.
std::string quoted(const std::string& text) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << '"' << std::hex << std::setfill('0');
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out << '\\' << c;
    } else if (byte < 0x20 || byte == 0x7F) {
      out << "\\u" << std::setw(4) << static_cast<int>(byte);
    } else {
      out << c;
    }
  }
  return out.str() + '"';
}

std::string numberOrNull(std::optional<double> value) {
  return value && std::isfinite(*value) ? formatNumber(*value) : "null";
}

}  // namespace

void JsonObject::addNumber(const char* key, std::optional<double> value) { begin(key) << numberOrNull(value); }

void JsonObject::addNumbers(const char* key, const Eigen::VectorXd& values) {
  std::ostream& out = begin(key) << '[';
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    out << (i == 0 ? "" : ", ") << numberOrNull(values(i));
  }
  out << ']';
}

void JsonObject::addText(const char* key, const std::string& value) { begin(key) << quoted(value); }

/// Its members are indented by one more level.
void JsonObject::addObject(const char* key, const JsonObject& value) {
  std::ostream& out = begin(key) << '{';
  std::istringstream members(value.out_.str());
  for (std::string line; std::getline(members, line);) {
    out << "\n  " << line;
  }
  out << "\n  }";
}

void JsonObject::addAlarms(const char* key, const Alarms& alarms) {
  std::ostream& out = begin(key);
  const char* separator = "[";
  for (const auto& [what, alarm] : inOrderOfAppearance(alarms)) {
    out << separator << "\n    {\"what\": " << quoted(what) << ", \"count\": " << alarm.count
        << ", \"first_s\": " << formatSeconds(alarm.first) << ", \"last_s\": " << formatSeconds(alarm.last) << "}";
    separator = ",";
  }
  out << (alarms.empty() ? "[]" : "\n  ]");
}

std::ostream& JsonObject::begin(const char* key) {
  out_ << (is_first_ ? "" : ",\n") << "  \"" << key << "\": ";
  is_first_ = false;
  return out_;
}

}  // namespace slipnav
