#include "slipnav/core/navigation/health.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace slipnav {
namespace {

/// A measurement rejected for this long contradicts; single ones are outliers.
constexpr double kRejected_s = 1.5;
/// Wheels and vehicle that are both faster than this, in opposite directions, for this long.
constexpr double kClearSpeed_mps = 0.2;
constexpr double kAgainst_s = 0.3;
/// A magnitude is reported again when it has grown by this factor.
constexpr double kGrowth = 1.25;

std::string formatSize(double value) {
  std::ostringstream text;
  text << std::setprecision(2) << value;
  return text.str();
}

}  // namespace

HealthMonitor::HealthMonitor(const FilterSetup& setup) : max_wheel_interval_s_(setup.filter.max_wheel_interval_s) {
  for (std::size_t i = 0; i < setup.wheels.size(); ++i) {
    const std::string& name = setup.wheels[i].name;
    wheel_names_.push_back(name.empty() ? "wheel " + std::to_string(i) : name);
  }
}

void HealthMonitor::note(const std::string& name, Nanoseconds stamp) {
  Alarm& alarm = alarms_[name];
  if (alarm.count++ == 0) {
    alarm.first = stamp;
  }
  alarm.last = stamp;
}

void HealthMonitor::noteSized(const std::string& name, double size, const std::string& unit, Nanoseconds stamp) {
  const auto nameOf = [&name, &unit](double value) { return name + ' ' + formatSize(value) + ' ' + unit; };
  const auto [known, is_new] = sizes_.emplace(name, size);
  if (!is_new && size > kGrowth * known->second) {
    auto grown = alarms_.extract(nameOf(known->second));
    known->second = size;
    grown.key() = nameOf(size);
    alarms_.insert(std::move(grown));
  }
  note(nameOf(known->second), stamp);
}

void HealthMonitor::noteStamps(const StampFaults& faults, Nanoseconds stamp) {
  if (faults.scatters() && faults.scatter_s != stamp_faults_.scatter_s) {
    noteSized("IMU stamps scatter by", 1e3 * faults.scatter_s, "ms", stamp);
  }
  for (std::uint64_t i = stamp_faults_.equal; i < faults.equal; ++i) {
    note("IMU stamps equal", stamp);
  }
  for (std::uint64_t i = stamp_faults_.lost; i < faults.lost; ++i) {
    note("IMU samples lost", stamp);
  }
  stamp_faults_ = faults;
}

void HealthMonitor::noteSetBack(double step_s, Nanoseconds stamp) {
  note("clock set back by " + formatSize(step_s) + " s", stamp);
}

void HealthMonitor::noteImu(Nanoseconds stamp, ImuVerdict verdict) {
  if (verdict == ImuVerdict::kAfterGap) {
    note("IMU gap", stamp);
  } else if (verdict != ImuVerdict::kAccepted) {
    note(std::string("IMU sample ") + complaintOf(verdict), stamp);
  }
}

void HealthMonitor::noteWheels(const WheelMotion& wheels, bool taken) {
  if (!taken) {
    note("wheel sample repeated or too late", wheels.stamp);
  }
  if (wheels.stamp >= newest_wheels_) {
    newest_wheels_ = wheels.stamp;
    wheel_speed_mps_ = wheels.motion.forward_mps;
  }
}

void HealthMonitor::noteFilter(const FilterEngine& filter) {
  if (!filter.isInitialized()) {
    return;
  }
  const Nanoseconds now = filter.state().stamp;
  noteSilence(now);
  noteDirection(filter.state());
  noteRejections(filter);
  if (filter.recoveries() != std::exchange(recoveries_, filter.recoveries())) {
    note("faster than any slip explains: velocity and tilt restarted from wheels and gravity", now);
  }
  if (filter.unexpectedSlips() != std::exchange(unexpected_slips_, filter.unexpectedSlips())) {
    note("slip unnoticed for meters: velocity and position corrected", now);
  }
  if (filter.isStuck()) {
    note("stuck: the wheels turn but the rover does not move", now);
  }
  for (std::size_t i = 0; i < wheel_names_.size(); ++i) {
    if (filter.wheelMonitor().isFaulty(i)) {
      note(wheel_names_[i] + " contradicts the other wheels", now);
    }
  }
}

void HealthMonitor::noteSilence(Nanoseconds now) {
  if (newest_wheels_ == 0) {
    newest_wheels_ = now;  // monitored from here on
  } else if (toSeconds(now - newest_wheels_) > max_wheel_interval_s_) {
    note("wheels silent", now);
  }
}

/// Beyond any slip: a sign error, or a vehicle that slides back while its wheels drive forward. Until the filter trusts
/// the wheels again.
void HealthMonitor::noteDirection(const NavigationState& state) {
  const double forward_mps = (state.q_b_to_n.conjugate() * state.v_eb_n).x();
  const bool against = std::min(std::abs(forward_mps), std::abs(wheel_speed_mps_)) > kClearSpeed_mps &&
                       forward_mps * wheel_speed_mps_ < 0.0;
  if (!against) {
    against_since_ = 0;
  } else if (against_since_ == 0) {
    against_since_ = state.stamp;
  } else if (toSeconds(state.stamp - against_since_) > kAgainst_s) {
    note("wheels turn against the motion", state.stamp);
  }
}

void HealthMonitor::noteRejections(const FilterEngine& filter) {
  const Nanoseconds now = filter.state().stamp;
  for (int i = 0; i < kComponents; ++i) {
    const Component component = static_cast<Component>(i);
    const ComponentStatus& status = filter.status(component);
    const bool rejected_again =
        status.rejected != std::exchange(rejected_[static_cast<std::size_t>(i)], status.rejected);
    // A measurement that is no longer made contradicts nothing.
    if (rejected_again && status.rejected_since != 0 && toSeconds(now - status.rejected_since) > kRejected_s) {
      note(std::string(componentName(component)) + " contradicts", now);
    }
  }
}

}  // namespace slipnav
