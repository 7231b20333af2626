/// A rover that crawls, turns on the spot, or stops and goes: there is a forecast at every second of driving, and no
/// stop that the bound does not ask for.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "config/config.h"
#include "evaluation/simulated_run.h"

namespace slipnav::test {
namespace {

constexpr double kCrawl_mps = 0.04;  // a rover on Mars
constexpr double kTurns = 10.0;
constexpr std::size_t kUnknownSpeed_s = 2;  // after the start
constexpr double kTurnRate_radps = 0.4;

/// The operator's command, changed by what the test wants; then the stop supervisor, which is watched.
class Watched : public StopPolicy {
 public:
  /// @param change of a command, by the time on the route [s]
  using Change = std::function<VelocityCommand(const VelocityCommand&, double)>;

  Watched(StopParams params, Change change) : supervisor_(active(params)), change_(std::move(change)) {}

  VelocityCommand command(const VelocityCommand& in, const DriveMoment& moment) override {
    if (!moment.on_route) {
      return supervisor_.command(in);
    }
    begin_ = begin_ == 0 ? moment.stamp : begin_;
    return supervisor_.command(change_(in, toSeconds(moment.stamp - begin_)));
  }

  void observe(const RoverObservation& observation) override {
    supervisor_.observe(observation);
    const bool stops = supervisor_.status().state >= StopState::kStopping;
    if (stops && !stopped_) {
      ++stops_;
      if (!(due_s_ <= toSeconds(observation.stamp) + kBraking_s)) {
        unasked_.push_back(supervisor_.status().reason);
      }
    }
    stopped_ = stops;
    const Nanoseconds second = observation.stamp / fromSeconds(1.0);
    if (observation.stationary) {
      resting_.insert(second);
    } else if (observation.has_wheels) {
      moving_.insert(second);
    }
  }

  void setForecast(const StopForecast& forecast) override {
    supervisor_.setForecast(forecast);
    due_s_ = toSeconds(forecast.stamp) + forecast.time_to_stop_s;
    forecast_.insert(forecast.stamp / fromSeconds(1.0));
  }

  int stops() const { return stops_; }
  /// Reasons of the stops for which the newest bound gave none.
  const std::vector<std::string>& unasked() const { return unasked_; }
  /// Number of seconds in which the rover moved all the time.
  std::size_t secondsMoved() const {
    return count([](Nanoseconds) { return true; });
  }
  /// Those of them without a forecast.
  std::size_t secondsUnforecast() const {
    return count([this](Nanoseconds second) { return forecast_.count(second) == 0; });
  }

 private:
  static constexpr double kBraking_s = 2.0;

  static StopParams active(StopParams params) {
    params.mode = "active";
    return params;
  }

  std::size_t count(const std::function<bool(Nanoseconds)>& counts) const {
    std::size_t seconds = 0;
    for (const Nanoseconds second : moving_) {
      const bool whole = second != *moving_.begin() && second != *moving_.rbegin() && resting_.count(second) == 0;
      seconds += whole && counts(second) ? 1 : 0;
    }
    return seconds;
  }

  StopSupervisor supervisor_;
  Change change_;
  Nanoseconds begin_ = 0;
  double due_s_ = std::numeric_limits<double>::infinity();
  bool stopped_ = false;
  int stops_ = 0;
  std::vector<std::string> unasked_;
  std::set<Nanoseconds> moving_;
  std::set<Nanoseconds> resting_;
  std::set<Nanoseconds> forecast_;
};

Config configOf(const std::string& terrain, double distance_m) {
  Config config;
  config.simulator.terrain = terrain;
  config.simulator.seed = 11;
  config.simulator.drive.distance_m = distance_m;
  return config;
}

void drive(const Config& config, Watched& watched) { simulateAndMeasure(config, watched); }

/// The same way at another speed.
VelocityCommand scaled(const VelocityCommand& in, double factor) {
  return {factor * in.linear_mps, factor * in.angular_radps};
}

void expectForecastsAndNoOtherStops(const Watched& watched, std::size_t seconds) {
  EXPECT_GE(watched.secondsMoved(), seconds);
  EXPECT_LE(watched.secondsUnforecast(), kUnknownSpeed_s);
  EXPECT_TRUE(watched.unasked().empty()) << watched.unasked().size() << " stops: " << watched.unasked().front();
}

class SlowDrive : public ::testing::TestWithParam<const char*> {};

TEST_P(SlowDrive, CrawlIsForecastAndNotStoppedByAClock) {
  const Config config = configOf(GetParam(), 10.0);
  const double factor = kCrawl_mps / config.simulator.drive.speed_mps;
  Watched watched(config.stop, [factor](const VelocityCommand& in, double) { return scaled(in, factor); });
  drive(config, watched);
  expectForecastsAndNoOtherStops(watched, 200);
  EXPECT_LE(watched.stops(), 2);
}

TEST_P(SlowDrive, TurnsOnTheSpotAreForecastAndNotStoppedByAClock) {
  const Config config = configOf(GetParam(), 5.0);
  Watched watched(config.stop, [](const VelocityCommand& in, double time_s) {
    return time_s < kTurns * 2.0 * kPi / kTurnRate_radps
               ? VelocityCommand{Vector3::Zero(), Vector3(0.0, 0.0, kTurnRate_radps)}
               : in;
  });
  drive(config, watched);
  expectForecastsAndNoOtherStops(watched, 150);
  EXPECT_LE(watched.stops(), 2);
}

TEST_P(SlowDrive, StopAndGoIsForecast) {
  const Config config = configOf(GetParam(), 10.0);
  Watched watched(config.stop, [](const VelocityCommand& in, double time_s) {
    return std::fmod(time_s, 6.0) < 4.0 ? scaled(in, 0.25) : VelocityCommand{};
  });
  drive(config, watched);
  expectForecastsAndNoOtherStops(watched, 30);
  EXPECT_LE(watched.stops(), 2);
}

INSTANTIATE_TEST_SUITE_P(Terrains, SlowDrive, ::testing::Values("paved", "rough"),
                         [](const auto& terrain) { return std::string(terrain.param); });

}  // namespace
}  // namespace slipnav::test
