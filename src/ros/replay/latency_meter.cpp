#include "ros/replay/latency_meter.h"

#include <algorithm>

#include "core/base/statistics.h"

namespace slipnav {
namespace {

/// Samples may wait for late wheels, at up to 1000 Hz.
constexpr std::size_t kMaxRemembered = 1000;

}  // namespace

void Arrivals::note(Nanoseconds stamp, double now_s) {
  newest_.push_back({stamp, now_s});
  if (newest_.size() > kMaxRemembered) {
    newest_.pop_front();
  }
}

double Arrivals::of(Nanoseconds stamp) const {
  const auto arrival =
      std::find_if(newest_.rbegin(), newest_.rend(), [stamp](const Arrival& sample) { return sample.stamp == stamp; });
  return arrival == newest_.rend() ? 0.0 : arrival->time_s;
}

void LatencyMeter::expect(Nanoseconds stamp, double came_s) {
  if (came_s > 0.0) {
    expected_.emplace(stamp, came_s);
  }
}

void LatencyMeter::published(Nanoseconds stamp, double now_s) {
  const auto expected = expected_.find(stamp);
  if (expected != expected_.end()) {
    latencies_s_.push_back(now_s - expected->second);
    expected_.erase(expected_.begin(), std::next(expected));
  }
}

void LatencyMeter::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto add = [this, &status](const std::string& name, double p) {
    status.addf("latency from IMU to odometry, " + name + " [ms]", "%.2f", 1e3 * percentile(latencies_s_, p));
  };
  if (!latencies_s_.empty()) {
    add("p50", 50.0);
    add("p99", 99.0);
    add("longest", 100.0);
  }
  latencies_s_.clear();
}

}  // namespace slipnav
