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

#include <algorithm>
#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/navigation/estimator.h"
#include "core/ordering/following_sequence.h"
#include "ros/messages/conversions.h"
#include "ros/messages/estimate_publisher.h"
#include "ros/messages/fix_input.h"
#include "ros/messages/internal_messages.h"
#include "ros/messages/wheel_input.h"
#include "ros/replay/latency_meter.h"
#include "ros/runtime/checkpoint_schedule.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/runtime/sensor_watch.h"
#include "slipnav/core/navigation/health.h"

namespace slipnav {

namespace {

/// [s] without a step of the mechanization.
constexpr double kStepSilence_s = 1.0;
/// [s] without a usable wheel sample, or `filter.max_wheel_interval_s` if that is longer.
constexpr double kWheelSilence_s = 0.5;

}  // namespace

class FilterNodelet : public NodeletBase {
 public:
  ~FilterNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    estimator_.emplace(Planet::byName(config.planet), config.navigation().filter, patience());
    wheel_input_.emplace(config);
    wheel_watch_.emplace("wheels", std::max(kWheelSilence_s, config.filter.max_wheel_interval_s));
    checkpoints_.emplace(config.checkpoint);
    health_.emplace(config.navigation().filter);
    fix_input_.emplace(config);
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
    hand_over_publisher_ = publisher<StartState>(kHandOverTopic, true);
    request_publisher_ = publisher<std_msgs::UInt32>(kStartRequestTopic);
    correction_publisher_ = publisher<FilterCorrection>(kCorrectionTopic);
  }

  void retune(const Config& config) override { estimator_->retune(config.navigation().filter); }

  void onInitialState(const StartState::ConstPtr& message) {
    const Start start = fromMessage(*message);
    if (!estimator_->take(start)) {
      return;
    }
    lost_ = false;
    if (!start.state) {
      handOver(start);
      return;
    }
    health_->restart();
    latency_.restart();
    checkpoints_->start(start.state->origin, start.session);
    estimates_->start(start.state->origin, lever_imu_to_base_b_, engine().dynamics().gyroNoiseDensity());
    const std::vector<InsSteps::ConstPtr> early = std::move(early_steps_);
    early_steps_.clear();
    for (const InsSteps::ConstPtr& steps : early) {
      onSteps(steps);
    }
  }

  void onSteps(const InsSteps::ConstPtr& message) {
    if (message->start > estimator_->start()) {  // overtook its initial state
      early_steps_.push_back(message);
      return;
    }
    if (message->start != estimator_->start()) {
      return;
    }
    learnTime(timeOf(*message));
    steps_watch_.heard(clocks());
    for (const InsInterval& interval : message->steps) {
      const StepVerdict verdict = estimator_->push(message->start, fromMessage(interval, message->epoch), now());
      if (verdict == StepVerdict::kLost) {
        requestStart();
        return;
      }
      if (verdict == StepVerdict::kRestarted) {
        NODELET_WARN("the mechanization restarts");
        wheels_.recount();
        fixes_.recount();
      }
      latency_.expect(toNanoseconds(interval.state.stamp), interval.came_s);
    }
    proceed();
  }

  /// This nodelet was reloaded: the steps from the initial state on are gone.
  void requestStart() {
    if (!lost_) {
      NODELET_WARN("the mechanization is ahead of this filter, which requests a new start");
    }
    lost_ = true;
    const auto message = boost::make_shared<std_msgs::UInt32>();
    message->data = estimator_->start();
    request_publisher_.publish(message);
  }

  template <class Message>
  void onWheels(const boost::shared_ptr<const Message>& message) {
    ++wheel_messages_;
    const std::optional<WheelMotion> motion = wheel_input_->take(*message);
    const std::string& problem = wheel_input_->problem();
    if (!problem.empty()) {
      ++rejected_;
      wheel_watch_->refused(problem, clocks());
      health_->note(problem, engine().state().stamp);
      complain("wheel message rejected: " + problem);
    }
    if (!wheel_input_->remark().empty()) {
      health_->note(wheel_input_->remark(), engine().state().stamp);
      NODELET_WARN("%s", wheel_input_->remark().c_str());
    }
    if (motion) {
      wheel_watch_->used(clocks());
      wheels_.push(*motion, [this](const WheelMotion& wheels) { useWheels(wheels); });
      proceed();
    }
  }

  /// The clock may have been set back before these steps.
  void learnTime(const ContinuousTime& time) {
    if (wheels_.learn(time, [this](const WheelMotion& wheels) { useWheels(wheels); })) {
      checkpoints_->setTime(time);
    }
    fixes_.learn(time, [this](const PositionFix& fix) { useFix(fix); });
  }

  void publish(const Estimate& estimate, const ErrorCovariance& P) {
    if (wheels_.time().steps().empty()) {
      estimates_->publish(estimate, P);
      return;
    }
    Estimate by_clock = estimate;
    by_clock.nav.stamp = wheels_.time().toClock(estimate.nav.stamp);
    by_clock.wheels.stamp = wheels_.time().toClock(estimate.wheels.stamp);
    estimates_->publish(by_clock, P);
  }

  void onFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    const std::optional<GnssFix> fix = fix_input_->take(*message);
    if (!fix_input_->problem().empty()) {
      health_->note(fix_input_->problem(), engine().state().stamp);
      complain(fix_input_->problem());
    }
    if (fix) {
      fixes_.push(toPositionFix(*fix), [this](const PositionFix& passed) { useFix(passed); });
      proceed();
    }
  }

  void useFix(const PositionFix& fix) {
    if (!estimator_->push(AntennaFix(fix))) {
      health_->note("satellite position too late", engine().state().stamp);
    }
  }

  void useWheels(const WheelMotion& wheels) {
    const bool taken = estimator_->push(wheels);
    health_->noteWheels(wheels, taken);
    rejected_ += taken ? 0 : 1;
  }

  double tickInterval_s() const override { return 0.5 * kPatience_s; }
  void onTick() override { proceed(); }

  /// Processes what has become certain, and informs the mechanization.
  void proceed() {
    const std::optional<Reply> reply = estimator_->advance(
        [this](const Estimate& estimate, const ErrorCovariance& P) {
          checkpoints_->offer(engine());
          if (const std::optional<Start> present = estimator_->handOver()) {
            handOver(*present);
          }
          publish(estimate, P);
          latency_.published(estimate.nav.stamp, now());
        },
        now());
    health_->noteFilter(engine());
    if (reply) {
      tell(*reply);
    }
  }

  void handOver(const Start& present) {
    const auto message = boost::make_shared<StartState>();
    fill(present, *message);
    hand_over_publisher_.publish(message);
  }

  void tell(const Reply& reply) {
    const auto message = boost::make_shared<FilterCorrection>();
    fill(reply, *message);
    correction_publisher_.publish(message);
  }

  void onSlipForecast(const SlipForecast::ConstPtr& message) {
    checkpoints_->setSlipHyperparameters({message->variance, message->length_scale_s, message->noise_variance});
  }

  void setState(const SetState::Request& request, SetState::Response& response) {
    if (!estimator_->isStarted()) {
      throw std::invalid_argument("there is no estimate yet");
    }
    tell(estimator_->place(toPoseOverride(request, estimates_->frame(), engine().state(), lever_imu_to_base_b_)));
    response.message = "the estimate was moved";
  }

  void saveCheckpoint(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    checkpoints_->save(engine());
    response.message = "written";
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool has_wheels = wheel_messages_ > 0;
    const bool has_steps = estimator_ && estimator_->hasSteps();
    status.summary(has_steps && has_wheels ? DiagnosticStatus::OK : DiagnosticStatus::WARN,
                   !estimator_ || !estimator_->isStarted() ? "waiting for the initial state"
                   : lost_                                 ? "reloaded, waiting for a new start"
                   : !has_steps                            ? "waiting for the mechanization"
                   : has_wheels                            ? "running"
                                                           : "no wheel samples");
    if (!estimator_) {
      return;
    }
    diagnoseInputs(status);
    status.add("wheel messages", wheel_messages_);
    status.add("rejected wheel messages", rejected_);
    status.add("wheel messages with a wrong stamp", wheels_.leftOut());
    latency_.report(status);
    checkpoints_->diagnose(status);
    alarms_.add(*health_, now(), status);
    for (int i = 0; i < kComponents; ++i) {
      const ComponentStatus& component = engine().status(static_cast<Component>(i));
      const std::string name = componentName(static_cast<Component>(i));
      status.add(name + " accepted", component.accepted);
      status.add(name + " rejected", component.rejected);
      status.addf(name + " last NIS", "%.2f", component.last_nis);
    }
  }

  /// Worst first. If steps are missing the cause is in the status of Ins, and nothing here is current.
  void diagnoseInputs(diagnostic_updater::DiagnosticStatusWrapper& status) const {
    using diagnostic_msgs::DiagnosticStatus;
    const std::string failure = wheel_watch_->problem(wheel_input_->topic(), clocks());
    if (!failure.empty()) {
      status.summary(DiagnosticStatus::ERROR, failure);
    } else if (!wheel_input_->problem().empty()) {
      status.mergeSummary(DiagnosticStatus::WARN, "wheel message rejected: " + wheel_input_->problem());
    } else if (estimator_->hasSteps() && steps_watch_.isSilent(clocks())) {
      status.summary(DiagnosticStatus::STALE, "the mechanization is silent");
    }
  }

  const FilterEngine& engine() const { return estimator_->engine(); }

  std::optional<Estimator> estimator_;
  SilenceWatch steps_watch_{kStepSilence_s};
  HealthReport alarms_;
  std::optional<WheelInput> wheel_input_;
  std::optional<SensorWatch> wheel_watch_;
  FollowingSequence<WheelMotion> wheels_;
  std::uint64_t wheel_messages_ = 0;
  std::optional<CheckpointSchedule> checkpoints_;
  std::optional<HealthMonitor> health_;
  std::unique_ptr<EstimatePublisher> estimates_;
  Vector3 lever_imu_to_base_b_ = Vector3::Zero();
  LatencyMeter latency_;
  std::optional<FixInput> fix_input_;
  FollowingSequence<PositionFix> fixes_{kFixJump};
  std::vector<InsSteps::ConstPtr> early_steps_;
  bool lost_ = false;  ///< the steps from the start on are gone
  std::uint64_t rejected_ = 0;
  SharedPublisher<StartState> hand_over_publisher_;
  SharedPublisher<std_msgs::UInt32> request_publisher_;
  SharedPublisher<FilterCorrection> correction_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::FilterNodelet, nodelet::Nodelet)
