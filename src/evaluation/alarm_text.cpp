#include "evaluation/alarm_text.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace slipnav {

std::vector<std::pair<std::string, Alarm>> inOrderOfAppearance(const Alarms& alarms) {
  std::vector<std::pair<std::string, Alarm>> ordered(alarms.begin(), alarms.end());
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  return ordered;
}

std::string alarmLines(const std::string& prefix, const Alarms& alarms, Nanoseconds begin) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(1);
  for (const auto& [what, alarm] : inOrderOfAppearance(alarms)) {
    out << prefix << ": " << what << " (" << alarm.count << (alarm.count == 1 ? " time, " : " times, ")
        << toSeconds(alarm.first - begin) << " s";
    if (alarm.last != alarm.first) {
      out << " to " << toSeconds(alarm.last - begin) << " s";
    }
    out << ")\n";
  }
  return out.str();
}

}  // namespace slipnav
