/// Content of the messages that the nodelets exchange, and of commands: whatever ROS takes for one, through conversion
/// into the engines behind the nodelets. Forecasts and commands that come out must be finite.

#include <slipnav/ErrorForecast.h>
#include <slipnav/InsSteps.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "config/config.h"
#include "core/forecast/forecaster.h"
#include "core/navigation/estimator.h"
#include "core/navigation/mechanizer.h"
#include "core/stopping/forecast_gate.h"
#include "fuzz_target.h"
#include "message_reader.h"
#include "ros/messages/conversions.h"
#include "ros/messages/forecast_messages.h"
#include "ros/messages/internal_messages.h"
#include "ros/messages/stop_messages.h"

namespace {

using namespace slipnav;

constexpr int kSamplesForForecast = 4;

Config makeConfig() {
  Config config;
  config.stop.mode = "active";
  config.forecast.slip.min_samples = kSamplesForForecast;
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

/// One for all inputs, as it cannot be copied; each begins with a reset.
Forecaster& forecaster() {
  static Forecaster forecaster(Planet::byName(config().planet), config().navigation().filter, config().forecast);
  return forecaster;
}

/// What is behind the nodelets Ins, Filter, Forecast and StopSupervisor.
class Engines {
 public:
  static constexpr int kTypes = 9;

  void handle(int type, fuzz::MessageReader& reader) {
    switch (type) {
      case 0:
        return use<StartState>(reader);
      case 1:
        return use<InsSteps>(reader);
      case 2:
        return use<FilterCorrection>(reader);
      case 3:
        return use<ForecastInput>(reader);
      case 4:
        return use<SetStateRequest>(reader);
      case 5:
        return use<Slip>(reader);
      case 6:
        return use<NavState>(reader);
      case 7:
        return use<ErrorForecast>(reader);
      default:
        return use<geometry_msgs::Twist>(reader);
    }
  }

  template <class Message>
  void receive(const Message& message) {
    now_s_ += 0.1;
    take(message);
    estimator_.advance([](const Estimate&, const ErrorCovariance&) {}, now_s_);
    gate_.release(
        now_s_, [this](const RoverObservation& observation) { supervisor_.observe(observation); },
        [this](const StopForecast& forecast) { supervisor_.setForecast(forecast); });
  }

 private:
  template <class Message>
  void use(fuzz::MessageReader& reader) {
    if (const std::optional<Message> message = reader.take<Message>()) {
      receive(*message);
    }
  }

  void take(const StartState& message) {
    const Start start = fromMessage(message);
    mechanizer_.take(start, now_s_);
    estimator_.take(start);
    if (start.state) {
      frame_ = LocalFrame(planet_, start.state->origin);
    }
  }

  void take(const InsSteps& message) {
    for (const InsInterval& interval : message.steps) {
      estimator_.push(message.start, fromMessage(interval, message.epoch), now_s_);
    }
  }

  void take(const FilterCorrection& message) { mechanizer_.take(fromMessage(message)); }
  void take(const Slip& message) { observer_.add(message); }
  void take(const NavState& message) { gate_.push(observer_.observe(message), now_s_); }

  void take(const ErrorForecast& message) {
    const Nanoseconds stamp = toNanoseconds(message.header.stamp);
    gate_.push(StopForecast{stamp, message.time_to_stop_s, message.kept_s});
    gate_.dealtWith(stamp);
  }

  void take(const ForecastInput& message) {
    const std::optional<Forecast> forecast = forecaster().push(estimateOf(message), covarianceOf(message));
    if (forecast) {
      require(forecast->slip.mean.allFinite() && forecast->slip.stddev.allFinite());
      const std::vector<double>& bound = forecast->error.horizontal_bound_m;
      require(std::all_of(bound.begin(), bound.end(), [](double m) { return std::isfinite(m) && m >= 0.0; }));
      require(!std::isnan(forecast->error.time_to_stop_s));
    }
  }

  void take(const SetStateRequest& message) {
    if (!estimator_.isStarted()) {
      return;
    }
    try {
      estimator_.place(toPoseOverride(message, frame_, estimator_.engine().state(), Vector3::Zero()));
    } catch (const std::invalid_argument&) {
    }
  }

  void take(const geometry_msgs::Twist& message) {
    const VelocityCommand out = supervisor_.command(toVelocityCommand(message));
    require(out.isFinite());
    require(!std::isnan(supervisor_.status().time_left_s));
  }

  Planet planet_ = Planet::byName(config().planet);
  LocalFrame frame_{planet_, Geodetic{}};
  Mechanizer mechanizer_{planet_, config().navigation().imu_input};
  Estimator estimator_{planet_, config().navigation().filter, kPatience_s};
  RoverObserver observer_{config().stationary.wheel_speed_mps};
  ForecastGate gate_;
  StopSupervisor supervisor_{config().stop};
  double now_s_ = 0.0;
};

constexpr double kStart_s = 100.0;
constexpr double kNow_s = 100.5;  // how far the driving rover has come
constexpr double kStep_s = 0.02;
constexpr double kWheelInterval_s = 0.1;
constexpr double kSpeed_mps = 0.8;

NavigationState drivingState(double time_s) {
  NavigationState state;
  state.stamp = fromSeconds(time_s);
  state.v_eb_n = {kSpeed_mps, 0.0, 0.0};
  state.position = {0.69, -1.39, 300.0};
  return state;
}

InsSteps drivingSteps(double begin_s, double end_s) {
  InsSteps message;
  message.start = 1;
  for (double time_s = begin_s; time_s < end_s - 0.5 * kStep_s; time_s += kStep_s) {
    InsStep step;
    step.start = fromSeconds(time_s);
    step.state = drivingState(time_s + kStep_s);
    step.f_ib_b = {0.0, 0.0, -9.8};
    message.steps.push_back(toMessage(step));
  }
  return message;
}

ForecastInput drivingInput(double time_s, double slip) {
  Estimate estimate;
  estimate.nav = drivingState(time_s);
  estimate.has_wheels = estimate.wheel_speed_used = true;
  estimate.wheels.stamp = estimate.nav.stamp;
  estimate.wheels.motion.forward_mps = kSpeed_mps / (1.0 - slip);
  estimate.motion.duration_s = kWheelInterval_s;
  estimate.motion.v_eb_b = {kSpeed_mps, 0.0, 0.0};
  ForecastInput message;
  fill(estimate, 1e-3 * ErrorCovariance::Identity(), message);
  return message;
}

/// The engines of a rover that drives, so that a single message reaches much.
Engines makeDrivingEngines() {
  Engines engines;
  InitialState initial;
  initial.nav = drivingState(kStart_s);
  initial.P = 1e-3 * ErrorCovariance::Identity();
  initial.origin = initial.nav.position;
  StartState start;
  fill(Start{1, 0, initial}, start);
  engines.receive(start);
  engines.receive(drivingSteps(kStart_s, kNow_s));
  return engines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Engines fresh;
  static const Engines driving = makeDrivingEngines();
  fuzz::MessageReader reader(data, size);
  const bool drives = reader.nextType(2) == 0;
  Engines engines = drives ? driving : fresh;
  forecaster().reset();
  for (int left = drives ? kSamplesForForecast - 1 : 0; left > 0; --left) {
    engines.receive(drivingInput(kNow_s - kWheelInterval_s * left, 0.01 * left));
  }
  while (const std::optional<int> type = reader.nextType(Engines::kTypes)) {
    engines.handle(*type, reader);
  }
  return 0;
}
