#pragma once
/// Writes the members of one JSON object, independent of the locale.

#include <Eigen/Core>
#include <cstdint>
#include <locale>
#include <optional>
#include <sstream>
#include <string>

#include "evaluation/alarm_text.h"

namespace slipnav {

/// Writes one JSON object, member by member, in the order of the calls.
class JsonObject {
 public:
  JsonObject() { out_.imbue(std::locale::classic()); }

  void addCount(const char* key, std::int64_t value) { begin(key) << value; }
  /// `null` if unknown or not finite.
  void addNumber(const char* key, std::optional<double> value);
  void addNumbers(const char* key, const Eigen::VectorXd& values);
  void addText(const char* key, const std::string& value);
  void addObject(const char* key, const JsonObject& value);
  /// A list of one object per alarm: what, count, first_s, last_s.
  void addAlarms(const char* key, const Alarms& alarms);

  std::string text() const { return "{\n" + out_.str() + "\n}\n"; }

 private:
  std::ostream& begin(const char* key);

  std::ostringstream out_;
  bool is_first_ = true;
};

}  // namespace slipnav
