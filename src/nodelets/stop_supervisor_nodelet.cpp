/// slipnav/StopSupervisor: stands between the operator's commands and the rover.
///
/// In: nav_state, slip, error_forecast, forecast_progress, cmd_vel_in. Out: cmd_vel, stop, stop_cmd.
/// Services, in its own namespace: stop_now, override, emergency_stop.

#include <geometry_msgs/Twist.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Header.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "slipnav/ros/conversions.h"
#include "slipnav/ros/core_nodelet.h"
#include "slipnav/ros/forecast_gate.h"
#include "slipnav/ros/internal_topics.h"
#include "slipnav/ros/silence_watch.h"
#include "slipnav/ros/stop_messages.h"

namespace slipnav {

class StopSupervisorNodelet : public CoreNodelet {
 public:
  ~StopSupervisorNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    frames_ = config.frames;
    supervisor_.emplace(config.stop);
    gate_ = ForecastGate(patience());
    observer_.emplace(config.stationary.wheel_speed_mps);
    estimates_watch_.emplace(config.stop.estimate_timeout_s);
    commands_watch_.emplace(config.stop.command_timeout_s);
  }

  void subscribe(const Config& config) override {
    listen<NavState>(config.topics.nav_state, &StopSupervisorNodelet::onNavState);
    listen<Slip>(config.topics.slip, &StopSupervisorNodelet::onSlip);
    listen<ErrorForecast>(config.topics.error_forecast, &StopSupervisorNodelet::onForecast);
    listen<std_msgs::Header>(kForecastProgressTopic, &StopSupervisorNodelet::onForecastProgress);
    stepBetweenIfWanted(config);
    offerTuning("StopSupervisor");
  }

  /// Once there, it stays there: commands must not run dry when the mode becomes off.
  void stepBetweenIfWanted(const Config& config) {
    if (config.stop.stopMode() == StopMode::kOff || stands_between_) {
      return;
    }
    stands_between_ = true;
    command_publisher_ = publisher<geometry_msgs::Twist>(config.topics.cmd_vel);
    listen<geometry_msgs::Twist>(config.topics.cmd_vel_in, &StopSupervisorNodelet::onCommand);
    serve("stop_now", &StopSupervisorNodelet::onStopNow);
    serve("override", &StopSupervisorNodelet::onOverride);
    serve("emergency_stop", &StopSupervisorNodelet::onEmergencyStop);
  }

  void retune(const Config& config) override {
    stepBetweenIfWanted(config);
    observer_->setWheelSpeedAtRest(config.stationary.wheel_speed_mps);
    estimates_watch_->setLimit(config.stop.estimate_timeout_s);
    commands_watch_->setLimit(config.stop.command_timeout_s);
    supervisor_->retune(config.stop);
    report();
  }

  void advertise(const Config& config) override {
    countdown_publisher_ = publisher<std_msgs::Float64>(config.topics.stop_cmd);
    status_publisher_ = publisher<StopStatus>(config.topics.stop);
  }

  static SilenceWatch::Now clocks() { return {ros::Time::now().toSec(), now()}; }

  void onSlip(const Slip::ConstPtr& message) { observer_->add(*message); }

  void onNavState(const NavState::ConstPtr& message) {
    estimates_watch_->heard(clocks());
    estimates_lost_ = false;
    gate_.push(observer_->observe(*message), now());
    proceed();
  }

  void onForecast(const ErrorForecast::ConstPtr& message) {
    gate_.push(StopForecast{toNanoseconds(message->header.stamp), message->time_to_stop_s});
    proceed();
  }

  void onForecastProgress(const std_msgs::Header::ConstPtr& message) {
    gate_.dealtWith(toNanoseconds(message->stamp));
    proceed();
  }

  void proceed() {
    gate_.release(
        now(),
        [this](const RoverObservation& observation) {
          supervisor_->observe(observation);
          report();
        },
        [this](const StopForecast& forecast) {
          supervisor_->setForecast(forecast);
          report();
          announce();
        });
  }

  /// One command in, one command out: a silent operator is never spoken for.
  void onCommand(const geometry_msgs::Twist::ConstPtr& message) {
    commands_watch_->heard(clocks());
    watchEstimates();
    const VelocityCommand in = toVelocityCommand(*message);
    if (!in.isFinite()) {
      ++refused_commands_;
      NODELET_WARN_THROTTLE(1.0, "a command that is not finite is refused: the rover is told to stop");
    }
    give(supervisor_->command(in));
  }

  void give(const VelocityCommand& command) {
    command_publisher_.publish(boost::make_shared<geometry_msgs::Twist>(toTwist(command)));
  }

  void onStopNow(const std_srvs::TriggerRequest&, std_srvs::TriggerResponse& response) {
    const std::string refusal = supervisor_->stopNow();
    if (!refusal.empty()) {
      throw std::runtime_error("no stop: " + refusal);
    }
    response.message = "stopping";
    report();
  }

  void onOverride(const std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
    supervisor_->setOverride(request.data != 0);
    response.message = request.data != 0 ? "commands pass, no stops" : "stops again";
    report();
  }

  void onEmergencyStop(const std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
    supervisor_->setEmergencyStop(request.data != 0);
    if (request.data != 0) {
      give({});  // at once, not with the operator's next command
    }
    response.message = request.data != 0 ? "every command becomes zero" : "commands pass";
    report();
  }

  void onTick() override {
    proceed();
    watchEstimates();
  }

  void watchEstimates() {
    if (estimates_lost_ || !estimates_watch_->isSilent(clocks())) {
      return;
    }
    estimates_lost_ = true;
    NODELET_WARN("no estimates: commands pass, and there are no stops");
    supervisor_->loseEstimates();
    report();
  }

  void report() {
    const SupervisorStatus& status = supervisor_->status();
    const auto message = boost::make_shared<StopStatus>();
    fill(status, supervisor_->mode(), frames_, *message);
    status_publisher_.publish(message);
    if (status.state == reported_) {
      return;
    }
    if (status.state >= StopState::kStopping || reported_ >= StopState::kStopping) {
      NODELET_INFO("%s: %s", name(status.state), status.reason.c_str());
    }
    reported_ = status.state;
    announce();
  }

  /// For those who only want to know the seconds.
  void announce() {
    const auto message = boost::make_shared<std_msgs::Float64>();
    const SupervisorStatus& status = supervisor_->status();
    message->data = status.state >= StopState::kStopping ? 0.0 : status.time_left_s;
    countdown_publisher_.publish(message);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& diagnostics) override {
    using diagnostic_msgs::DiagnosticStatus;
    if (!supervisor_) {
      diagnostics.summary(DiagnosticStatus::WARN, "waiting for extrinsics");
      return;
    }
    const SupervisorStatus& status = supervisor_->status();
    const std::string problem = problemOf(status);
    diagnostics.summary(problem.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                        problem.empty() ? status.reason : problem);
    diagnostics.add("state", name(status.state));
    diagnostics.add("stops", status.stops);
    diagnostics.add("stops given up", status.refusals);
    diagnostics.add("refused commands", refused_commands_);
  }

  std::string problemOf(const SupervisorStatus& status) const {
    if (supervisor_->mode() == StopMode::kOff) {
      return "";
    }
    if (status.emergency_stop) {
      return "emergency stop";
    }
    if (estimates_lost_ || !estimates_watch_->hasHeard()) {
      return "no estimates";
    }
    if (commands_watch_->isSilent(clocks())) {
      return "cmd_vel_in is silent";
    }
    return status.forecasts_stale || gate_.forecasterIsSilent() ? "no forecasts: periodic stops" : "";
  }

  static const char* name(StopState state) {
    switch (state) {
      case StopState::kDriving:
        return "driving";
      case StopState::kCountingDown:
        return "counting down";
      case StopState::kStopping:
        return "stopping";
      case StopState::kHolding:
        break;
    }
    return "holding";
  }

  FrameNames frames_;
  std::optional<StopSupervisor> supervisor_;
  std::optional<RoverObserver> observer_;
  ForecastGate gate_;
  std::optional<SilenceWatch> estimates_watch_;
  std::optional<SilenceWatch> commands_watch_;
  bool stands_between_ = false;  ///< operator and rover
  bool estimates_lost_ = false;
  std::uint64_t refused_commands_ = 0;
  StopState reported_ = StopState::kDriving;
  SharedPublisher<geometry_msgs::Twist> command_publisher_;
  SharedPublisher<StopStatus> status_publisher_;
  SharedPublisher<std_msgs::Float64> countdown_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::StopSupervisorNodelet, nodelet::Nodelet)
