/// Long sequences of everything that can happen to the supervisor, on a clock of tenths of a second: limits are met
/// exactly as often as they are missed. No change of a decision or of a command goes without being noticed.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "reference_trace.h"
#include "supervisor_rig.h"

namespace slipnav::test {
namespace {

constexpr int kLines = 60;
constexpr int kEventsPerLine = 25;

class DrawnStops {
 public:
  DrawnStops(const std::string& mode, std::uint64_t seed) : mode_(mode), dice_(seed), supervisor_(params()) {}

  /// What happened in a few events.
  void addLine(ReferenceTrace& trace) {
    double left_s = 0.0;
    double countdown_s = 0.0;
    double told_mps = 0.0;
    double commanded = 0.0;
    int states = 0;
    for (int i = 0; i < kEventsPerLine; ++i) {
      happen();
      const SupervisorStatus& status = supervisor_.status();
      const VelocityCommand out = supervisor_.command(command());
      left_s += std::min(status.time_left_s, 1e3);
      countdown_s += supervisor_.countdown_s().value_or(-1.0);
      told_mps += supervisor_.told_mps().value_or(-1.0);
      commanded += out.linear_mps.x() + 3.0 * out.angular_radps.z();
      states = 4 * (states % 1000) + static_cast<int>(status.state);
    }
    const SupervisorStatus& status = supervisor_.status();
    trace.note(states, left_s, countdown_s, told_mps, commanded, status.stops, status.refusals, status.overridden,
               status.emergency_stop, status.forecasts_stale, status.reason);
  }

 private:
  StopParams params() {
    StopParams params;
    params.mode = mode_;
    params.deceleration_mps2 = dice_.from<double>({0.5, 1.0});
    params.angular_deceleration_radps2 = dice_.from<double>({0.25, 1.0});
    params.max_stop_s = 6.0;
    params.max_hold_s = dice_.from<double>({1.0, 3.0});
    params.converged_speed_std_mps = 0.005;
    params.min_zero_updates = dice_.from<int>({2, 7});
    params.countdown_s = dice_.from<double>({2.0, 10.0});
    params.min_drive_s = dice_.from<double>({0.0, 2.0, 5.0});
    params.retry_after_slide_s = dice_.from<double>({1.0, 8.0});
    return params;
  }

  void happen() {
    const int event = dice_.roll(200);
    if (event < 130) {
      observe();
    } else if (event < 160) {
      supervisor_.setForecast({stamp_ + dice_.from<Nanoseconds>({0, 0, 0, 0, -5, 1}) * kInterval,
                               dice_.from<double>({-1.0, 0.0, 0.5, 1.6, 4.0, 8.0, 16.0, 1e6, kInfinity}),
                               dice_.from<double>({0.0, 0.0, 5.0, 20.0, 1e6})});
    } else if (event < 164) {
      supervisor_.stopNow();
    } else if (event < 168) {
      supervisor_.setOverride(dice_.oneIn(3));
    } else if (event < 172) {
      supervisor_.setEmergencyStop(dice_.oneIn(3));
    } else if (event < 176) {
      supervisor_.loseEstimates();
      lost_ = 6;
    } else if (event < 184) {
      supervisor_.passTime(dice_.roll(30) * kInterval);
    } else if (event < 186) {
      stamp_ -= dice_.from<Nanoseconds>({5, 10, 11, 1000}) * kInterval;
    } else if (event < 188) {
      mode_ = dice_.from<std::string>({mode_, mode_, "off", "advise", "active"});
      supervisor_.retune(params());
    }
  }

  void observe() {
    if (lost_ > 0) {
      --lost_;
      supervisor_.passTime(kInterval);
      return;
    }
    stamp_ += (1 + dice_.roll(3)) * kInterval;
    const bool stops = supervisor_.status().state >= StopState::kStopping;
    motion_ = dice_.oneIn(stops ? 6 : 25) ? dice_.roll(3) : motion_;
    const bool standing = motion_ == 1;
    const double speed_mps = motion_ == 0 ? dice_.from<double>({0.8, 0.8, 0.4, -0.8}) : 0.0;
    supervisor_.observe(
        {stamp_, speed_mps, dice_.from<double>({0.001, 0.005, 0.02}), standing, !dice_.oneIn(4), motion_ > 0});
  }

  VelocityCommand command() {
    return {{dice_.from<double>({0.8, 0.8, 0.8, 0.4, 0.0}), 0.0, 0.0}, {0.0, 0.0, dice_.from<double>({0.2, 0.2, 0.0})}};
  }

  std::string mode_;
  Dice dice_;
  StopSupervisor supervisor_;
  Nanoseconds stamp_ = 1000 * kSecond;
  int motion_ = 0;  ///< 0 driving, 1 standing, 2 sliding on wheels at rest
  int lost_ = 0;    ///< estimates that do not come
};

TEST(StopSupervisorReference, DecisionsAndCommandsAreTheSame) {
  ReferenceTrace trace("stop_supervisor");
  for (const char* mode : {"active", "advise", "off"}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      DrawnStops drawn(mode, seed);
      for (int line = 0; line < kLines; ++line) {
        drawn.addLine(trace);
      }
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
