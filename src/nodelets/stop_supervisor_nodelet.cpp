/// slipnav/StopSupervisor: stands between the operator's commands and the rover.
///
/// In: nav_state, slip, error_forecast, forecast_progress, cmd_vel_in, diagnostics. Out: cmd_vel, stop, stop_cmd,
/// e_stop. Services, in its own namespace: stop_now, override, emergency_stop.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>
#include <std_msgs/Header.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/base/silence_watch.h"
#include "core/stopping/forecast_gate.h"
#include "core/stopping/obedience_watch.h"
#include "core/stopping/stop_reach.h"
#include "core/stopping/stop_verdict.h"
#include "ros/messages/conversions.h"
#include "ros/messages/stop_messages.h"
#include "ros/runtime/fit_to_drive.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/runtime/stop_latch_keeper.h"
#include "ros/runtime/topic_graph.h"

namespace slipnav {

class StopSupervisorNodelet : public NodeletBase {
 public:
  ~StopSupervisorNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    frames_ = config.frames;
    topics_ = config.topics;
    supervisor_.emplace(config.stop);
    gate_ = ForecastGate(patience());
    observer_.emplace(config.stationary.wheel_speed_mps);
    estimates_watch_.emplace(config.stop.estimate_timeout_s);
    commands_watch_.emplace(config.stop.command_timeout_s);
    keeper_.emplace(config.checkpoint, getName());
    fit_to_drive_.emplace(node().getNamespace());
    supervisor_->restore(keeper_->load());
  }

  /// A latched emergency stop must not wait for transforms.
  bool needsExtrinsics() const override { return false; }

  void subscribe(const Config& config) override {
    listen<NavState>(config.topics.nav_state, &StopSupervisorNodelet::onNavState);
    listen<Slip>(config.topics.slip, &StopSupervisorNodelet::onSlip);
    listen<ErrorForecast>(config.topics.error_forecast, &StopSupervisorNodelet::onForecast);
    listen<std_msgs::Header>(kForecastProgressTopic, &StopSupervisorNodelet::onForecastProgress);
    listen<diagnostic_msgs::DiagnosticArray>(config.topics.diagnostics, &StopSupervisorNodelet::onDiagnostics);
    serve("stop_now", &StopSupervisorNodelet::onStopNow);
    serve("override", &StopSupervisorNodelet::onOverride);
    serve("emergency_stop", &StopSupervisorNodelet::onEmergencyStop);
    if (config.stop.stopMode() != StopMode::kOff || supervisor_->latch().emergency_stop) {
      stepBetween();
    }
    offerTuning("StopSupervisor");
  }

  /// Between operator and rover. Once there, it stays: commands must not run dry when the mode becomes off.
  void stepBetween() {
    if (outputs_.hasCommands()) {
      return;
    }
    outputs_.advertiseCommands(node(), topics_);
    listen<geometry_msgs::Twist>(topics_.cmd_vel_in, &StopSupervisorNodelet::onCommand);
  }

  void retune(const Config& config) override {
    if (config.stop.stopMode() != StopMode::kOff) {
      stepBetween();
    }
    observer_->setWheelSpeedAtRest(config.stationary.wheel_speed_mps);
    estimates_watch_->setLimit(config.stop.estimate_timeout_s);
    commands_watch_->setLimit(config.stop.command_timeout_s);
    supervisor_->retune(config.stop);
    report();
  }

  void advertise(const Config& config) override {
    outputs_.advertise(node(), config.topics);
    status_publisher_ = publisher<StopStatus>(config.topics.stop);
    if (supervisor_->latch().emergency_stop) {
      NODELET_WARN("emergency stop, as before the restart: until the operator ends it by the service emergency_stop");
      enforceEmergencyStop();
    }
    if (supervisor_->latch().overridden) {
      NODELET_WARN("overridden, as before the restart: until the operator ends it by the service override");
    }
  }

  void onSlip(const Slip::ConstPtr& message) { observer_->add(*message); }

  void onNavState(const NavState::ConstPtr& message) {
    estimates_watch_->heard(clocks());
    estimates_lost_ = false;
    gate_.push(observer_->observe(*message), now());
    proceed();
  }

  void onForecast(const ErrorForecast::ConstPtr& message) {
    gate_.push(StopForecast{toNanoseconds(message->header.stamp), message->time_to_stop_s, message->kept_s});
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
          watchObedience(observation);
          report();
        },
        [this](const StopForecast& forecast) {
          supervisor_->setForecast(forecast);
          report();
          announce();
        });
  }

  /// A rover that keeps driving must be reported at once.
  void watchObedience(const RoverObservation& observation) {
    const bool ignored = obedience_.isIgnored();
    obedience_.observe(supervisor_->told_mps(), observation);
    if (ignored != obedience_.isIgnored()) {
      reportNow();
    }
  }

  void onDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    fit_to_drive_->take(*message, now());
  }

  void addDiagnoses(diagnostic_updater::Updater& updater) override {
    updater.add(fit_to_drive_->name(), [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      const FitToDrive::Verdict verdict = fit_to_drive_->verdict(now());
      status.summary(static_cast<unsigned char>(verdict.level), verdict.message);
    });
  }

  /// One command in, one command out: it never speaks for a silent operator.
  void onCommand(const geometry_msgs::Twist::ConstPtr& message) {
    commands_watch_->heard(clocks());
    watchEstimates();
    const VelocityCommand in = toVelocityCommand(*message);
    if (!in.isFinite()) {
      ++refused_commands_;
      NODELET_WARN_THROTTLE(1.0, "a command that is not finite is rejected: the rover is told to stop");
    }
    outputs_.command(supervisor_->command(in));
  }

  void onStopNow(const std_srvs::TriggerRequest&, std_srvs::TriggerResponse& response) {
    const std::string limit = whyNoStop(supervisor_->mode(), outputs_.listeners());
    const bool unheard = supervisor_->mode() == StopMode::kActive && !limit.empty();
    const std::string refusal = unheard ? limit : supervisor_->stopNow();
    if (!refusal.empty()) {
      throw std::runtime_error("no stop: " + refusal);
    }
    response.message = limit.empty() ? "stopping" : "stop advised: " + limit;
    report();
  }

  void onOverride(const std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
    const bool wanted = request.data != 0;
    const std::string loss = keeper_->save({supervisor_->latch().emergency_stop, wanted});
    supervisor_->setOverride(wanted);
    response.message = withLoss(wanted ? "commands pass, no stops" : "stops again", loss);
    report();
  }

  void onEmergencyStop(const std_srvs::SetBoolRequest& request, std_srvs::SetBoolResponse& response) {
    const bool wanted = request.data != 0;
    supervisor_->setEmergencyStop(wanted);  // before waiting for the disk
    if (wanted) {
      stepBetween();
      enforceEmergencyStop();
    } else {
      outputs_.lock(false);
    }
    const std::string loss = keeper_->save(supervisor_->latch());
    reach_ = wanted ? whyNoEmergencyStop(supervisor_->mode(), outputs_.listeners()) : "";
    report();
    announce();
    if (!reach_.empty()) {
      throw std::runtime_error(
          withLoss("no stop: " + reach_ + "; cmd_vel and stop_cmd say zero, e_stop is locked", loss));
    }
    response.message = withLoss(
        wanted ? "every command becomes zero: " + outputs_.listenersInWords() : "commands pass, by a ramp", loss);
  }

  static std::string withLoss(const std::string& answer, const std::string& loss) {
    return loss.empty() ? answer : answer + "; not kept over a restart: " + loss;
  }

  /// At once and repeatedly: new listeners hear it, and a base does not act on an older command.
  void enforceEmergencyStop() {
    outputs_.command(supervisor_->command({}));
    outputs_.lock(true);
    report();
    announce();
  }

  void onTick() override {
    proceed();
    watchEstimates();
    if (supervisor_->latch().emergency_stop) {
      enforceEmergencyStop();
    }
  }

  void watchEstimates() {
    passTime();
    if (estimates_lost_ || !estimates_watch_->isSilent(clocks())) {
      return;
    }
    estimates_lost_ = true;
    NODELET_WARN("no estimates: commands pass, and no stop begins");
    supervisor_->loseEstimates();
    report();
  }

  /// Without estimates, as much as both clocks agree on.
  void passTime() {
    const SilenceWatch::Now time = clocks();
    const double elapsed_s = std::min(time.ros_s - last_time_.ros_s, time.real_s - last_time_.real_s);
    last_time_ = time;
    if (estimates_lost_ || !estimates_watch_->hasHeard()) {
      supervisor_->passTime(fromSeconds(std::clamp(elapsed_s, 0.0, kLongestTick_s)));
      reportChange();
    }
  }

  /// Without estimates nothing else reports the end of a stop.
  void reportChange() {
    if (supervisor_->status().state != reported_) {
      report();
    }
  }

  void report() {
    const SupervisorStatus& status = supervisor_->status();
    const auto message = boost::make_shared<StopStatus>();
    fill(status, supervisor_->mode(), frames_, *message);
    if (status.emergency_stop && !reach_.empty()) {
      message->reason += ", but " + reach_;
    }
    status_publisher_.publish(message);
    if (status.state == reported_) {
      return;
    }
    if (status.state >= StopState::kStopping || reported_ >= StopState::kStopping) {
      NODELET_INFO("%s: %s", nameOf(status.state), status.reason.c_str());
    }
    reported_ = status.state;
    announce();
  }

  /// For nodes that only need the seconds.
  void announce() {
    if (const std::optional<double> seconds = supervisor_->countdown_s()) {
      outputs_.countDown(*seconds);
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& diagnostics) override {
    using diagnostic_msgs::DiagnosticStatus;
    const SupervisorStatus& status = supervisor_->status();
    const StopVerdict verdict = judgeStops(status, supervisor_->mode(), signs());
    diagnostics.summary(verdict.concern == StopConcern::kDanger    ? DiagnosticStatus::ERROR
                        : verdict.concern == StopConcern::kProblem ? DiagnosticStatus::WARN
                                                                   : DiagnosticStatus::OK,
                        verdict.words);
    diagnostics.add("state", nameOf(status.state));
    diagnostics.add("stops", status.stops);
    diagnostics.add("stops given up", status.refusals);
    diagnostics.add("rejected commands", refused_commands_);
    diagnostics.add("emergency stop is kept in", keeper_->file());
  }

  StopSigns signs() {
    reach_ = supervisor_->latch().emergency_stop ? whyNoEmergencyStop(supervisor_->mode(), outputs_.listeners()) : "";
    StopSigns signs;
    signs.unheard = reach_;
    signs.ignored = obedience_.isIgnored();
    signs.not_kept = keeper_->problem();
    signs.rivals = publishersOf(topics_.nav_state) > 1 ? estimators() : "";
    signs.estimates_missing = estimates_lost_ || !estimates_watch_->hasHeard();
    signs.commands_unheard = !outputs_.hasListenersToCommands();
    signs.commands_silent = commands_watch_->isSilent(clocks());
    signs.forecaster_silent = gate_.forecasterIsSilent();
    return signs;
  }

  std::string estimators() { return joined(endsOf(node().resolveName(topics_.nav_state)).publishers); }

  static constexpr double kLongestTick_s = 1.0;  ///< between two ticks; more means that a clock was set

  FrameNames frames_;
  TopicNames topics_;
  std::optional<StopSupervisor> supervisor_;
  std::optional<StopLatchKeeper> keeper_;
  std::optional<FitToDrive> fit_to_drive_;
  std::optional<RoverObserver> observer_;
  ObedienceWatch obedience_;
  ForecastGate gate_;
  std::optional<SilenceWatch> estimates_watch_;
  std::optional<SilenceWatch> commands_watch_;
  SilenceWatch::Now last_time_ = clocks();
  bool estimates_lost_ = false;
  std::string reach_;  ///< why an emergency stop that is set does not reach the rover
  std::uint64_t refused_commands_ = 0;
  StopState reported_ = StopState::kDriving;
  StopOutputs outputs_;
  SharedPublisher<StopStatus> status_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::StopSupervisorNodelet, nodelet::Nodelet)
