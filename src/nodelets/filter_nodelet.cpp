/// slipnav/Filter: the error-state Kalman filter.
///
/// In: ins_steps, initial_state, joint_states or wheel_odometry, gps/fix (with `gnss.use: always`), slip_forecast (for
/// checkpoints). Out: correction, odometry, nav_state, slip, hand_over, start_request, TF. Services: save_checkpoint,
/// set_state.

#include <slipnav/FilterCorrection.h>
#include <slipnav/InsSteps.h>
#include <slipnav/SetState.h>
#include <slipnav/SlipForecast.h>
#include <slipnav/StartState.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/navigation/look_ahead.h"
#include "core/navigation/patience.h"
#include "ros/messages/conversions.h"
#include "ros/messages/estimate_publisher.h"
#include "ros/messages/filter_wheels.h"
#include "ros/messages/fix_input.h"
#include "ros/messages/hand_over.h"
#include "ros/messages/internal_messages.h"
#include "ros/replay/latency_meter.h"
#include "ros/runtime/checkpoint_keeper.h"
#include "ros/runtime/core_nodelet.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/navigation/health.h"

namespace slipnav {

namespace {

/// [s] without a step of the mechanization.
constexpr double kStepSilence_s = 1.0;

}  // namespace

class FilterNodelet : public CoreNodelet {
 public:
  ~FilterNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    engine_.emplace(Planet::byName(config.planet), config.navigation().filter);
    wheels_.emplace(config, [this](const WheelMotion& wheels) { useWheels(wheels); });
    checkpoints_.emplace(config.checkpoint);
    health_.emplace(config.navigation().filter);
    const bool uses_wheels = !config.filter.updates.empty();
    gate_ = StepGate(uses_wheels ? std::optional<double>(config.filter.max_wait_s) : std::nullopt, patience());
    fix_input_.emplace(config);
    look_ahead_ = LookAhead(config.filter.max_wait_s);
    lever_imu_to_base_b_ = -config.imu.mount.position_b();
  }

  std::string usualThread() const override { return kNavigationThread; }

  void subscribe(const Config& config) override {
    listen<InsSteps>(kInsStepsTopic, &FilterNodelet::onSteps);
    listen<StartState>(kInitialStateTopic, &FilterNodelet::onInitialState);
    listen<sensor_msgs::JointState>(config.topics.joint_states, &FilterNodelet::onWheels<sensor_msgs::JointState>);
    listen<nav_msgs::Odometry>(config.topics.wheel_odometry, &FilterNodelet::onWheels<nav_msgs::Odometry>);
    if (config.gnss.always()) {
      listen<sensor_msgs::NavSatFix>(config.topics.gps_fix, &FilterNodelet::onFix);
    }
    listen<SlipForecast>(config.topics.slip_forecast, &FilterNodelet::onSlipForecast);
    serve("save_checkpoint", &FilterNodelet::saveCheckpoint);
    serve("set_state", &FilterNodelet::setState);
    offerTuning("Filter");
  }

  void advertise(const Config& config) override {
    estimates_ = std::make_unique<EstimatePublisher>(node(), config);
    hand_over_ = std::make_unique<HandOver>(node());
    request_publisher_ = publisher<std_msgs::UInt32>(kStartRequestTopic);
    correction_publisher_ = publisher<FilterCorrection>(kCorrectionTopic);
  }

  void retune(const Config& config) override { engine_->retune(config.navigation().filter); }

  void onInitialState(const StartState::ConstPtr& message) {
    if (message->start <= start_) {
      return;
    }
    start_ = message->start;
    if (!message->known) {
      end();
      return;
    }
    if (started_ && message->session == session_) {
      wheels_->pause();  // a new start without a new clock
    }
    started_ = true;
    has_steps_ = lost_ = false;
    session_ = message->session;
    const InitialState initial = fromMessage(*message);
    gate_.restart();
    health_->restart();
    look_ahead_.restart(initial.nav.stamp);
    latency_.restart();
    engine_->reset();
    wheels_->startNext();
    for (const PositionFix& fix : fix_input_->after(initial.nav.stamp)) {
      engine_->push(AntennaFix(fix));
    }
    engine_->initialise(initial);
    hand_over_->start(*message, initial.origin);
    checkpoints_->start(initial.origin, message->session);
    estimates_->start(initial.origin, lever_imu_to_base_b_, engine_->dynamics().gyroNoiseDensity());
    const std::vector<InsSteps::ConstPtr> early = std::move(early_steps_);
    early_steps_.clear();
    for (const InsSteps::ConstPtr& steps : early) {
      onSteps(steps);
    }
  }

  /// Ends the estimate; the search for a new start begins.
  void end() {
    started_ = has_steps_ = lost_ = false;
    engine_->reset();
    wheels_->pause();
    hand_over_->end(start_);
  }

  void onSteps(const InsSteps::ConstPtr& message) {
    if (message->start > start_) {  // overtook its initial state
      early_steps_.push_back(message);
      return;
    }
    if (!started_ || message->start != start_ || message->steps.empty()) {
      return;
    }
    if (!has_steps_ && !isBeginning(*message)) {
      requestStart();
      return;
    }
    learnTime(timeOf(*message));
    const Nanoseconds first_end = toNanoseconds(message->steps.front().state.stamp);
    if (!has_steps_) {
      first_end_ = first_end;
    } else if (isBeginning(*message) && first_end > first_end_) {
      first_end_ = first_end;
      restartMechanisation();
    }
    has_steps_ = true;
    steps_watch_.heard(clocks());
    const double now_s = now();
    for (const InsInterval& interval : message->steps) {
      gate_.push(fromMessage(interval, message->epoch), now_s);
      look_ahead_.addStep(toNanoseconds(interval.state.stamp));
      latency_.expect(toNanoseconds(interval.state.stamp), interval.came_s);
    }
    proceed();
  }

  static bool isBeginning(const InsSteps& steps) { return steps.epoch == 0 && steps.steps.front().sequence == 0; }

  /// This nodelet was reloaded: the steps from the initial state on are gone.
  void requestStart() {
    if (!lost_) {
      NODELET_WARN("the mechanization is ahead of this filter, which requests a new start");
    }
    lost_ = true;
    const auto message = boost::make_shared<std_msgs::UInt32>();
    message->data = start_;
    request_publisher_.publish(message);
  }

  /// The mechanization was reloaded: its first steps are void, and it resumes from the filter's state.
  void restartMechanisation() {
    NODELET_WARN("the mechanization restarts");
    gate_.clear();
    look_ahead_.forgetSteps();
    wheels_->recount();
    if (const std::optional<Correction> correction = engine_->reissue()) {
      tell(correction);
    }
  }

  template <class Message>
  void onWheels(const boost::shared_ptr<const Message>& message) {
    const std::optional<WheelMotion> motion = wheels_->read(*message, clocks());
    const std::string& problem = wheels_->problem();
    if (!problem.empty()) {
      ++rejected_;
      health_->note(problem, engine_->state().stamp);
      NODELET_WARN_THROTTLE(1.0, "wheel message at %.3f s rejected: %s", message->header.stamp.toSec(),
                            problem.c_str());
    }
    if (!wheels_->remark().empty()) {
      health_->note(wheels_->remark(), engine_->state().stamp);
      NODELET_WARN("%s", wheels_->remark().c_str());
    }
    if (motion) {
      wheels_->push(*motion);
      proceed();
    }
  }

  /// The clock may have been set back before these steps.
  void learnTime(const ContinuousTime& time) {
    if (wheels_->learn(time)) {
      checkpoints_->setTime(time);
    }
  }

  void publish(const Estimate& estimate, const ErrorCovariance& P) {
    if (wheels_->time().steps().empty()) {
      estimates_->publish(estimate, P);
      return;
    }
    Estimate by_clock = estimate;
    by_clock.nav.stamp = wheels_->time().toClock(estimate.nav.stamp);
    by_clock.wheels.stamp = wheels_->time().toClock(estimate.wheels.stamp);
    estimates_->publish(by_clock, P);
  }

  void onFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    const std::vector<PositionFix> fixes = fix_input_->take(*message, wheels_->time());
    if (!fix_input_->problem().empty()) {
      health_->note(fix_input_->problem(), engine_->state().stamp);
      NODELET_WARN_THROTTLE(10.0, "%s", fix_input_->problem().c_str());
    }
    for (const PositionFix& fix : fixes) {
      if (started_ && !engine_->push(AntennaFix(fix))) {
        health_->note("satellite position too late", engine_->state().stamp);
      }
    }
    proceed();
  }

  void useWheels(const WheelMotion& wheels) {
    const bool taken = engine_->push(wheels);
    health_->noteWheels(wheels, taken);
    if (taken) {
      look_ahead_.addWheels(wheels.stamp);
    } else {
      ++rejected_;
    }
  }

  double tickInterval_s() const override { return 0.5 * kPatience_s; }
  void onTick() override { proceed(); }

  /// Processes what has become certain, and informs the mechanization.
  void proceed() {
    if (!has_steps_) {  // the mechanization may be loaded later
      return;
    }
    gate_.release(
        engine_->wheelsKnownUntil(), now(), [this](const InsStep& step) { engine_->push(step); },
        fix_input_->decidedAt(engine_->fixesKnownUntil()));
    const std::optional<Correction> correction =
        engine_->advance([this](const Estimate& estimate, const ErrorCovariance& P) {
          look_ahead_.processed(estimate.nav.stamp);
          checkpoints_->offer(*engine_);
          hand_over_->offer(*engine_);
          publish(estimate, P);
          latency_.published(estimate.nav.stamp, now());
        });
    health_->noteFilter(*engine_);
    if (correction) {
      takeCorrection(*correction);
    } else if (look_ahead_.isStalled()) {
      tell(std::nullopt);
    }
  }

  void takeCorrection(const Correction& correction) {
    gate_.clear();
    look_ahead_.forgetSteps();
    tell(correction);
  }

  void tell(const std::optional<Correction>& correction) {
    const auto message = boost::make_shared<FilterCorrection>();
    message->start = start_;
    if (correction) {
      fill(*correction, *message);
    }
    message->run_until = toRosTime(look_ahead_.runUntil());
    look_ahead_.told(look_ahead_.runUntil());
    correction_publisher_.publish(message);
  }

  void onSlipForecast(const SlipForecast::ConstPtr& message) {
    checkpoints_->setSlipHyperparameters({message->variance, message->length_scale_s, message->noise_variance});
  }

  void setState(const SetState::Request& request, SetState::Response& response) {
    if (!started_) {
      throw std::invalid_argument("there is no estimate yet");
    }
    takeCorrection(engine_->place(toPlacement(request, estimates_->frame(), engine_->state(), lever_imu_to_base_b_)));
    response.message = "the estimate was moved";
  }

  void saveCheckpoint(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    checkpoints_->save(*engine_);
    response.message = "written";
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool has_wheels = wheels_ && wheels_->messages() > 0;
    status.summary(has_steps_ && has_wheels ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   !started_     ? "waiting for the initial state"
                   : lost_       ? "reloaded, waiting for a new start"
                   : !has_steps_ ? "waiting for the mechanization"
                   : has_wheels  ? "running"
                                 : "no wheel samples");
    if (!engine_) {
      return;
    }
    diagnoseInputs(status);
    status.add("wheel messages", wheels_->messages());
    status.add("rejected wheel messages", rejected_);
    status.add("wheel messages with a wrong stamp", wheels_->leftOut());
    latency_.report(status);
    checkpoints_->diagnose(status);
    alarms_.add(*health_, now(), status);
    for (int i = 0; i < kComponents; ++i) {
      const ComponentStatus& component = engine_->status(static_cast<Component>(i));
      const std::string name = componentName(static_cast<Component>(i));
      status.add(name + " accepted", component.accepted);
      status.add(name + " rejected", component.rejected);
      status.addf(name + " last NIS", "%.2f", component.last_nis);
    }
  }

  /// Worst first. If steps are missing the cause is in the status of Ins, and nothing here is current.
  void diagnoseInputs(diagnostic_updater::DiagnosticStatusWrapper& status) const {
    using diagnostic_msgs::DiagnosticStatus;
    const std::string failure = wheels_->failure(clocks());
    if (!failure.empty()) {
      status.summary(DiagnosticStatus::ERROR, failure);
    } else if (!wheels_->problem().empty()) {
      status.mergeSummary(DiagnosticStatus::WARN, "wheel message rejected: " + wheels_->problem());
    } else if (has_steps_ && steps_watch_.isSilent(clocks())) {
      status.summary(DiagnosticStatus::STALE, "the mechanization is silent");
    }
  }

  std::optional<FilterEngine> engine_;
  SilenceWatch steps_watch_{kStepSilence_s};
  HealthReport alarms_;
  std::optional<FilterWheels> wheels_;
  std::optional<CheckpointKeeper> checkpoints_;
  std::optional<HealthMonitor> health_;
  std::unique_ptr<EstimatePublisher> estimates_;
  Vector3 lever_imu_to_base_b_ = Vector3::Zero();
  StepGate gate_{std::nullopt};
  LookAhead look_ahead_{0.0};
  LatencyMeter latency_;
  std::optional<FixInput> fix_input_;
  std::vector<InsSteps::ConstPtr> early_steps_;
  bool started_ = false;
  bool has_steps_ = false;     ///< since the start
  bool lost_ = false;          ///< the steps from the start on are gone
  Nanoseconds first_end_ = 0;  ///< of the first step since the start
  std::uint32_t start_ = 0;    ///< count of the initial state in use
  std::uint32_t session_ = 0;  ///< of that state
  std::uint64_t rejected_ = 0;
  std::unique_ptr<HandOver> hand_over_;
  SharedPublisher<std_msgs::UInt32> request_publisher_;
  SharedPublisher<FilterCorrection> correction_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::FilterNodelet, nodelet::Nodelet)
