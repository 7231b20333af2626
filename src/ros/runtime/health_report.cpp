#include "ros/runtime/health_report.h"

namespace slipnav {

void HealthReport::add(const HealthMonitor& health, double now_s, diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::string active;
  for (const auto& [name, alarm] : health.alarms()) {
    status.addf(name, "%lu times from %.3f s to %.3f s", static_cast<unsigned long>(alarm.count),
                toSeconds(alarm.first), toSeconds(alarm.last));
    Seen& seen = seen_[name];
    if (alarm.count != seen.count) {
      seen = {alarm.count, now_s};
    }
    if (now_s - seen.time_s < kAlarmLifetime_s) {
      active += (active.empty() ? "" : ", ") + name;
    }
  }
  if (!active.empty()) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, active);
  }
}

}  // namespace slipnav
