/// Content of the messages that the nodelets exchange, and of commands: whatever ROS takes for one, through conversion
/// into the engines behind the nodelets. Forecasts and commands that come out must be finite.

#include <slipnav/ErrorForecast.h>
#include <slipnav/InsSteps.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "fuzz_target.h"
#include "message_reader.h"
#include "slipnav/config/config.h"
#include "slipnav/filter/filter_engine.h"
#include "slipnav/forecast/forecaster.h"
#include "slipnav/ros/conversions.h"
#include "slipnav/ros/forecast_gate.h"
#include "slipnav/ros/internal_messages.h"
#include "slipnav/ros/look_ahead.h"
#include "slipnav/ros/patience.h"
#include "slipnav/ros/stop_messages.h"

namespace {

using namespace slipnav;

Config makeConfig() {
  Config config;
  config.stop.mode = "active";
  config.forecast.slip.min_samples = 3;
  config.forecast.horizon_s = 5.0;
  config.forecast.interval_s = 0.1;
  return config;
}

const Config& config() {
  static const Config config = makeConfig();
  return config;
}

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// The engines behind the nodelets Ins, Filter, Forecast and StopSupervisor.
class Engines {
 public:
  static constexpr int kTypes = 9;

  void handle(int type, fuzz::MessageReader& reader) {
    now_s_ += 0.1;
    switch (type) {
      case 0:
        use<StartState>(reader, [this](const StartState& m) { start(m); });
        break;
      case 1:
        use<InsSteps>(reader, [this](const InsSteps& m) { step(m); });
        break;
      case 2:
        use<FilterCorrection>(reader, [this](const FilterCorrection& m) { ins_.correct(fromMessage(m)); });
        break;
      case 3:
        use<ForecastInput>(reader, [this](const ForecastInput& m) { forecast(m); });
        break;
      case 4:
        use<SetStateRequest>(reader, [this](const SetStateRequest& m) { place(m); });
        break;
      case 5:
        use<Slip>(reader, [this](const Slip& m) { observer_.add(m); });
        break;
      case 6:
        use<NavState>(reader, [this](const NavState& m) { gate_.push(observer_.observe(m), now_s_); });
        break;
      case 7:
        use<ErrorForecast>(reader, [this](const ErrorForecast& m) {
          gate_.push(StopForecast{toNanoseconds(m.header.stamp), m.time_to_stop_s});
          gate_.dealtWith(toNanoseconds(m.header.stamp));
        });
        break;
      default:
        use<geometry_msgs::Twist>(reader, [this](const geometry_msgs::Twist& m) { command(m); });
        break;
    }
    mechanise();
    gate_.release(
        now_s_, [this](const RoverObservation& observation) { supervisor_.observe(observation); },
        [this](const StopForecast& forecast) { supervisor_.setForecast(forecast); });
  }

 private:
  template <class Message, class Use>
  static void use(fuzz::MessageReader& reader, const Use& use) {
    if (const std::optional<Message> message = reader.take<Message>()) {
      use(*message);
    }
  }

  void start(const StartState& message) {
    const InitialState initial = fromMessage(message);
    frame_ = LocalFrame(planet_, initial.origin);
    gate_steps_.restart();
    look_ahead_.restart(initial.nav.stamp);
    filter_.reset();
    filter_.initialise(initial);
    ins_.initialise(initial.nav);
    started_ = true;
  }

  void step(const InsSteps& message) {
    if (!started_) {
      return;
    }
    for (const InsInterval& interval : message.steps) {
      gate_steps_.push(fromMessage(interval, message.epoch), now_s_);
      look_ahead_.addStep(toNanoseconds(interval.state.stamp));
    }
  }

  void mechanise() {
    if (!started_) {
      return;
    }
    gate_steps_.release(filter_.wheelsKnownUntil(), now_s_, [this](const InsStep& step) { filter_.push(step); });
    filter_.advance(
        [this](const Estimate& estimate, const ErrorCovariance&) { look_ahead_.processed(estimate.nav.stamp); });
    static_cast<void>(look_ahead_.runUntil());
  }

  void forecast(const ForecastInput& message) {
    const std::optional<Forecast> forecast = forecaster_.push(estimateOf(message), covarianceOf(message));
    if (forecast) {
      require(forecast->slip.mean.allFinite() && forecast->slip.stddev.allFinite());
      const std::vector<double>& bound = forecast->error.horizontal_bound_m;
      require(std::all_of(bound.begin(), bound.end(), [](double m) { return std::isfinite(m) && m >= 0.0; }));
      require(!std::isnan(forecast->error.time_to_stop_s));
    }
  }

  void place(const SetStateRequest& message) {
    if (!started_) {
      return;
    }
    try {
      filter_.place(toPlacement(message, frame_, filter_.state(), Vector3::Zero()));
    } catch (const std::invalid_argument&) {
    }
  }

  void command(const geometry_msgs::Twist& message) {
    const VelocityCommand out = supervisor_.command(toVelocityCommand(message));
    require(out.isFinite());
    require(!std::isnan(supervisor_.status().time_left_s));
  }

  Planet planet_ = Planet::byName(config().planet);
  LocalFrame frame_{planet_, Geodetic{}};
  InsEngine ins_{planet_, config().navigation().imu_input};
  FilterEngine filter_{planet_, config().navigation().filter};
  StepGate gate_steps_{config().filter.max_wait_s};
  LookAhead look_ahead_{config().filter.max_wait_s};
  Forecaster forecaster_{planet_, config().navigation().filter, config().forecast};
  RoverObserver observer_{config().stationary.wheel_speed_mps};
  ForecastGate gate_;
  StopSupervisor supervisor_{config().stop};
  double now_s_ = 0.0;
  bool started_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Engines engines;
  fuzz::MessageReader reader(data, size);
  while (const std::optional<int> type = reader.nextType(Engines::kTypes)) {
    engines.handle(*type, reader);
  }
  return 0;
}
