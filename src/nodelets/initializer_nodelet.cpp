/// slipnav/Initializer: finds where to start.
///
/// In: imu/data, joint_states or wheel_odometry, gps/fix, gps/velocity; hand_over, start_request. Out, latched:
/// initial_state, initialization, TF map → odom.
/// Services: `initialise`, reset.

#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <sensor_msgs/Imu.h>
#include <slipnav/StartState.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/text.h"
#include "core/navigation/patience.h"
#include "core/navigation/resumption.h"
#include "core/navigation/sample_merger.h"
#include "core/ordering/stamp_watch.h"
#include "ros/messages/conversions.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/internal_messages.h"
#include "ros/messages/start_reporter.h"
#include "ros/messages/wheel_input.h"
#include "ros/runtime/core_nodelet.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "slipnav/core/navigation/initializer.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

class InitializerNodelet : public CoreNodelet {
 public:
  ~InitializerNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    if (config.initialization.source == "truth") {
      throw std::invalid_argument("initialization.source: truth is for the evaluator only");
    }
    const NavigationSetup setup = config.navigation();
    imu_input_.emplace(config);
    inputs_.emplace(config.navigation().filter);
    fix_topic_ = config.topics.gps_fix;
    fix_stamp_offset_ = fromSeconds(config.initialization.fix_stamp_offset_s);
    stamps_.emplace(config.topics.imu);
    wheel_input_.emplace(config);
    clock_.emplace(setup.imu_input.gap_factor);
    screen_.emplace(setup.imu_input);
    merger_.emplace(config.filter.max_wait_s);
    trusted_ = TrustedStamp(patience());
    resumption_.emplace(Planet::byName(config.planet), config.checkpoint, setup.filter);
    for (const std::string& refused : resumption_->refused()) {
      NODELET_WARN("%s", refused.c_str());
    }
    initializer_.emplace(Planet::byName(config.planet), setup.initialization, setup.imu_input, setup.filter);
  }

  std::string usualThread() const override { return kNavigationThread; }

  void subscribe(const Config& config) override {
    listen<StartState>(kHandOverTopic, &InitializerNodelet::onHandOver);  // first: it decides whether to start at all
    listen<std_msgs::UInt32>(kStartRequestTopic, &InitializerNodelet::onStartRequest);
    listen<sensor_msgs::Imu>(config.topics.imu, &InitializerNodelet::onImu);
    listen<sensor_msgs::JointState>(config.topics.joint_states, &InitializerNodelet::onWheels<sensor_msgs::JointState>);
    listen<nav_msgs::Odometry>(config.topics.wheel_odometry, &InitializerNodelet::onWheels<nav_msgs::Odometry>);
    listen<sensor_msgs::NavSatFix>(config.topics.gps_fix, &InitializerNodelet::onFix);
    listen<geometry_msgs::TwistWithCovarianceStamped>(config.topics.gps_velocity, &InitializerNodelet::onVelocity);
    serve("initialise", &InitializerNodelet::initialise);
    serve("reset", &InitializerNodelet::reset);
  }

  void advertise(const Config& config) override {
    reporter_ = std::make_unique<StartReporter>(node(), config.frames);
    start_publisher_ = publisher<StartState>(kInitialStateTopic, true);
  }

  void retune(const Config& config) override { initializer_->retune(config.navigation().filter); }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    const std::optional<ImuSample> sample = imu_input_->take(*message);
    noteProblem(imu_input_->problem());
    if (!sample) {
      return;
    }
    stamps_->noteImu(sample->stamp);
    merger_->push(*sample);
    trusted_.push(merger_->newestImuStamp(), now());
    takeOver(merger_->newestImuTime());
    resume(merger_->newestImuTime());
    proceed();
  }

  void onHandOver(const StartState::ConstPtr& message) {
    if (start_ == 0) {
      running_ = message;
    } else if (message->known && message->start == start_ && message->session == session_) {
      resumption_->offer(fromMessage(*message));
    }
  }

  /// Loaded while an estimate is running: there is nothing to search for, unless it is from before the clock went
  /// back.
  void takeOver(Nanoseconds stamp) {
    if (stamp == 0) {
      return;
    }
    const StartState::ConstPtr running = std::exchange(running_, nullptr);
    if (start_ != 0 || !running || !running->known || stamp <= toNanoseconds(running->state.stamp) - kRestartBackstep) {
      return;
    }
    start_ = running->start;
    session_ = running->session;
    done_ = true;
    const InitialState state = fromMessage(*running);
    resumption_->offer(state);
    publishStart(state, running, "continued with the running estimate");
  }

  /// The filter was reloaded.
  void onStartRequest(const std_msgs::UInt32::ConstPtr& message) {
    if (!done_ || message->data != start_) {
      return;
    }
    done_ = false;
    resume(merger_->newestImuTime());
    if (!done_) {
      NODELET_WARN("the filter has lost the estimate: a new start");
      searchAnew();
    }
  }

  /// Resumes from where an estimate ended, if that is known and usable.
  void resume(Nanoseconds stamp) {
    if (done_ || stamp == 0 || !resumption_->isPossible()) {
      return;
    }
    try {
      const InitialState initial = resumption_->resume(stamp);
      done_ = true;
      const double unwatched_s = std::round(10.0 * resumption_->unwatched()) / 10.0;
      announce(initial, "resumed " + formatNumber(unwatched_s) + " s after the last known state");
    } catch (const std::invalid_argument& error) {
      NODELET_WARN("a new start: %s", error.what());
    }
  }

  template <class Message>
  void onWheels(const boost::shared_ptr<const Message>& message) {
    const std::optional<WheelMotion> motion = wheel_input_->take(*message);
    noteProblem(wheel_input_->problem());
    noteProblem(wheel_input_->remark());
    if (motion) {
      watch(wheel_input_->topic(), motion->stamp);
      merger_->push(*motion);
      proceed();
    }
  }

  /// About a rejected message; the start may be waiting for nothing else.
  void noteProblem(const std::string& problem) {
    if (!problem.empty()) {
      inputs_->note(problem, fromSeconds(now()));
      NODELET_WARN_THROTTLE(10.0, "%s", problem.c_str());
    }
  }

  void onFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    const std::string complaint = complaintOf(*message, fix_topic_);
    noteProblem(complaint);
    if (!complaint.empty()) {
      return;
    }
    if (std::optional<GnssFix> fix = toGnssFix(*message)) {
      fix->stamp += fix_stamp_offset_;
      watch(fix_topic_, fix->stamp);
      merger_->push(toPositionFix(*fix));
      proceed();
    }
  }

  void onVelocity(const geometry_msgs::TwistWithCovarianceStamped::ConstPtr& message) {
    if (std::optional<VelocityFix> fix = toVelocityFix(*message)) {
      fix->stamp += fix_stamp_offset_;
      merger_->push(*fix);
      proceed();
    }
  }

  /// Clocks that disagree cannot be corrected here, but are worth reporting.
  void watch(const std::string& topic, Nanoseconds stamp) {
    const std::string problem = stamps_->note(topic, stamp);
    noteProblem(problem);
  }

  void onTick() override {
    proceed();
    reportProgress();
  }

  void proceed() {
    merger_->advanceTrusting(trusted_.at(now()),
                             [this](const Sample& sample) { std::visit([this](const auto& s) { use(s); }, sample); });
  }

  void use(const ImuSample& sample) {
    clock_->push(sample);
    while (const std::optional<ImuSample> corrected = clock_->pop()) {
      judge(*corrected);
    }
  }
  void judge(const ImuSample& sample) {
    ImuVerdict verdict = screen_->check(sample).verdict;
    if (verdict == ImuVerdict::kTimeWentBack) {
      screen_->reset();
      initializer_->reset();
      resumption_->forget();
      ++session_;
      done_ = false;
      verdict = screen_->check(sample).verdict;
    }
    if (isAccepted(verdict)) {
      useWhileSearching(sample);
      watchWhenDone(sample);
    }
  }
  void use(const WheelMotion& wheels) {
    useWhileSearching(wheels);
    watchWhenDone(wheels);
  }
  void use(const AntennaFix& fix) { useWhileSearching(fix); }

  template <class CoreSample>
  void useWhileSearching(const CoreSample& sample) {
    if (done_) {
      return;
    }
    initializer_->push(sample);
    if (const std::optional<InitialState> initial = initializer_->result()) {
      done_ = true;
      announce(*initial, "done");
    }
  }

  template <class CoreSample>
  void watchWhenDone(const CoreSample& sample) {
    if (done_) {
      initializer_->watch(sample);
    }
    if (!initializer_->complaint().empty()) {
      NODELET_WARN_THROTTLE(10.0, "%s", initializer_->complaint().c_str());
    }
  }

  /// Ends the estimate and searches for a new start.
  void searchAnew() {
    initializer_->reset();
    resumption_->forget();
    done_ = false;
    start_publisher_.publish(nextStart());
    reportProgress();
  }

  void initialise(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    searchAnew();
    response.message = reporter_->progress();
  }

  void reset(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    resumption_->deleteFiles();
    searchAnew();
    response.message = reporter_->progress();
  }

  boost::shared_ptr<StartState> nextStart() {
    ++starts_;
    start_ = std::max(start_, first_start_) + 1;
    const auto message = boost::make_shared<StartState>();
    message->start = start_;
    message->session = session_;
    return message;
  }

  void announce(const InitialState& initial, const std::string& how) {
    const boost::shared_ptr<StartState> message = nextStart();
    fill(initial, *message);
    publishStart(initial, message, how);
  }

  void publishStart(const InitialState& initial, const StartState::ConstPtr& message, const std::string& how) {
    start_publisher_.publish(message);
    NODELET_INFO("%s", reporter_->end(initial, how).c_str());
  }

  void reportProgress() {
    const std::string line = done_ ? "" : reporter_->search(initializer_->progress(), screen_->newestStamp());
    if (!line.empty()) {
      NODELET_INFO("%s", line.c_str());
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(done_ ? DiagnosticStatus::OK : DiagnosticStatus::WARN, reporter_ ? reporter_->progress() : "");
    if (initializer_ && !initializer_->complaint().empty()) {
      status.summary(DiagnosticStatus::ERROR, initializer_->complaint());
    }
    if (inputs_) {
      alarms_.add(*inputs_, now(), status);
    }
    status.add("restarts of the clock", session_);
    status.add("starts", starts_);
    status.add("samples with a wrong stamp", merger_ ? merger_->leftOut() : 0);
  }

  std::optional<ImuInput> imu_input_;
  HealthReport alarms_;
  std::optional<HealthMonitor> inputs_;  ///< problems with messages, in real time
  std::string fix_topic_;
  Nanoseconds fix_stamp_offset_ = 0;
  std::optional<WheelInput> wheel_input_;
  std::optional<ImuClock> clock_;
  std::optional<ImuScreen> screen_;
  std::optional<SampleMerger> merger_;
  std::optional<Initializer> initializer_;
  std::optional<Resumption> resumption_;
  TrustedStamp trusted_;
  std::optional<StampWatch> stamps_;
  StartState::ConstPtr running_;  ///< of the estimate that was running before this nodelet
  std::uint32_t session_ = 0;     ///< restarts of the IMU clock
  std::uint32_t starts_ = 0;      ///< initial states announced, and searches restarted
  std::uint32_t start_ = 0;       ///< count of the newest of them
  /// Counts start here: beyond those of a previously unloaded initializer.
  const std::uint32_t first_start_ = static_cast<std::uint32_t>(now());
  bool done_ = false;
  SharedPublisher<StartState> start_publisher_;
  std::unique_ptr<StartReporter> reporter_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InitializerNodelet, nodelet::Nodelet)
