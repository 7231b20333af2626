#include "slipnav/ros/health_report.h"

namespace slipnav {

void report(const HealthMonitor& health, Nanoseconds now, diagnostic_updater::DiagnosticStatusWrapper& status) {
  for (const auto& [name, alarm] : health.alarms()) {
    status.addf(name, "%lu times from %.3f s to %.3f s", static_cast<unsigned long>(alarm.count),
                toSeconds(alarm.first), toSeconds(alarm.last));
  }
  const std::string active = health.active(now);
  if (!active.empty()) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, active);
  }
}

}  // namespace slipnav
