/// slipnav/Initializer: finds where to start.
///
/// In: imu/data, joint_states or wheel_odometry, gps/fix, gps/velocity; hand_over, start_request. Out, latched:
/// initial_state, initialization, TF map → odom.
/// Services: initialize, reset.

#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <sensor_msgs/Imu.h>
#include <slipnav/StartState.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/navigation/sample_merger.h"
#include "core/navigation/settled_stamp.h"
#include "core/navigation/starter.h"
#include "core/ordering/stamp_watch.h"
#include "ros/messages/conversions.h"
#include "ros/messages/fix_input.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/internal_messages.h"
#include "ros/messages/start_reporter.h"
#include "ros/messages/wheel_input.h"
#include "ros/runtime/health_report.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "slipnav/core/navigation/health.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

class InitializerNodelet : public NodeletBase {
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
    fix_input_.emplace(config);
    stamps_.emplace(config.topics.imu);
    wheel_input_.emplace(config);
    clock_.emplace(setup.imu_input.gap_factor);
    merger_.emplace(config.filter.max_wait_s);
    trusted_ = SettledStamp(patience());
    // Beyond the numbers of a previously unloaded initializer.
    starter_.emplace(Planet::byName(config.planet), setup, config.checkpoint, static_cast<std::uint32_t>(now()));
    publishNews();
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
    serve("initialize", &InitializerNodelet::initialize);
    serve("initialise", &InitializerNodelet::initializeByFormerName);
    serve("reset", &InitializerNodelet::reset);
  }

  void advertise(const Config& config) override {
    reporter_ = std::make_unique<StartReporter>(node(), config.frames);
    start_publisher_ = publisher<StartState>(kInitialStateTopic, true);
  }

  void retune(const Config& config) override { starter_->retune(config.navigation().filter); }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    const std::optional<ImuSample> sample = imu_input_->take(*message);
    noteProblem(imu_input_->problem());
    if (!sample) {
      return;
    }
    stamps_->noteImu(sample->stamp);
    merger_->push(*sample);
    trusted_.push(merger_->newestImuStamp(), now());
    starter_->resumeAt(merger_->newestImuTime());
    publishNews();
    proceed();
  }

  void onHandOver(const StartState::ConstPtr& message) { starter_->offer(fromMessage(*message)); }

  /// The filter was reloaded.
  void onStartRequest(const std_msgs::UInt32::ConstPtr& message) {
    starter_->replace(message->data, merger_->newestImuTime());
    publishNews();
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
      complain(problem);
    }
  }

  void onFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    const std::optional<GnssFix> fix = fix_input_->take(*message);
    noteProblem(fix_input_->problem());
    if (fix) {
      watch(fix_input_->topic(), fix->stamp);
      merger_->push(toPositionFix(*fix));
      proceed();
    }
  }

  void onVelocity(const geometry_msgs::TwistWithCovarianceStamped::ConstPtr& message) {
    if (std::optional<VelocityFix> fix = toVelocityFix(*message)) {
      fix->stamp += fix_input_->stampOffset();
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
      take(*corrected);
    }
  }
  void use(const WheelMotion& wheels) { take(wheels); }
  void use(const AntennaFix& fix) { take(fix); }

  template <class CoreSample>
  void take(const CoreSample& sample) {
    starter_->push(sample);
    publishNews();
    if (!initializer().complaint().empty()) {
      complain(initializer().complaint());
    }
  }

  void searchAgain(bool forget_files, std_srvs::Trigger::Response& response) {
    starter_->searchAgain(forget_files);
    publishNews();
    response.message = reporter_->progress();
  }

  void initialize(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    searchAgain(false, response);
  }

  void initializeByFormerName(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    NODELET_WARN_ONCE("called by its former name, which works in this release only: the service is now initialize");
    searchAgain(false, response);
  }

  void reset(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) { searchAgain(true, response); }

  void publishNews() {
    for (const std::string& warning : starter_->takeWarnings()) {
      NODELET_WARN("%s", warning.c_str());
    }
    const std::optional<Starter::News> news = starter_->takeNews();
    if (!news) {
      return;
    }
    const auto message = boost::make_shared<StartState>();
    fill(news->start, *message);
    start_publisher_.publish(message);
    if (news->start.state) {
      NODELET_INFO("%s", reporter_->end(*news->start.state, news->how).c_str());
    } else {
      reportProgress();
    }
  }

  void reportProgress() {
    const std::string line =
        starter_->isDone() ? "" : reporter_->search(initializer().progress(), starter_->newestStamp());
    if (!line.empty()) {
      NODELET_INFO("%s", line.c_str());
    }
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool done = starter_ && starter_->isDone();
    status.summary(done ? DiagnosticStatus::OK : DiagnosticStatus::WARN, reporter_ ? reporter_->progress() : "");
    if (starter_ && !initializer().complaint().empty()) {
      status.summary(DiagnosticStatus::ERROR, initializer().complaint());
    }
    if (inputs_) {
      alarms_.add(*inputs_, now(), status);
    }
    status.add("restarts of the clock", starter_ ? starter_->session() : 0);
    status.add("starts", starter_ ? starter_->starts() : 0);
    status.add("samples with a wrong stamp", merger_ ? merger_->leftOut() : 0);
  }

  const Initializer& initializer() const { return starter_->initializer(); }

  std::optional<ImuInput> imu_input_;
  HealthReport alarms_;
  std::optional<HealthMonitor> inputs_;  ///< problems with messages, in real time
  std::optional<FixInput> fix_input_;
  std::optional<WheelInput> wheel_input_;
  std::optional<ImuClock> clock_;
  std::optional<SampleMerger> merger_;
  std::optional<Starter> starter_;
  SettledStamp trusted_;
  std::optional<StampWatch> stamps_;
  SharedPublisher<StartState> start_publisher_;
  std::unique_ptr<StartReporter> reporter_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InitializerNodelet, nodelet::Nodelet)
