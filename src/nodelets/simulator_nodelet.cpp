/// slipnav/Simulator: a simulated rover and its operator, driven through the real nodelets.
///
/// Out: imu/data, joint_states, gps/fix, truth/fix, truth/odometry, cmd_vel_in, /clock. In: cmd_vel, stop,
/// initial_state, odometry, nav_state, slip.
///
/// Everybody keeps in step by stamps: an interval begins when all that the last one must lead to has come back. So the
/// drive is that of the offline simulation, whatever the machine is busy with; see doc/nodelets.md.

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulation_options.h"
#include "slipnav/eval/simulated_run.h"
#include "slipnav/eval/track_comparison.h"
#include "slipnav/ros/bag_evaluation.h"
#include "slipnav/ros/bag_writer.h"
#include "slipnav/ros/conversions.h"
#include "slipnav/ros/core_nodelet.h"
#include "slipnav/ros/estimate_recorder.h"
#include "slipnav/ros/internal_topics.h"
#include "slipnav/ros/sensor_publisher.h"
#include "slipnav/ros/stop_messages.h"

namespace slipnav {
namespace {

/// [s] of real time after which somebody who is waited for will not answer any more.
constexpr double kPatienceLimit_s = 60.0;
/// As long as nobody answers, so much is simulated at most in one tick [s]: queues must not overflow.
constexpr double kBlindAdvance_s = 1.0;
/// The initial state may come so much later than offline [s], beside filter.max_wait_s: sensors are waited for.
constexpr double kStartLag_s = 1.0;

}  // namespace

class SimulatorNodelet : public CoreNodelet {
 public:
  ~SimulatorNodelet() override { stop(); }

 private:
  enum class Waiting { kForNodelets, kForTime, kForCommand, kForStatus, kForEstimates, kForNothing };

  void begin(const Config& config) override {
    config_ = config;
    options_.emplace(privateNode());
    const bool autonomous = options_->policy == "autonomous";
    if (autonomous && config.stop.stopMode() != StopMode::kActive) {
      throw std::invalid_argument("policy autonomous needs stop.mode: active");
    }
    operator_ = makeStopPolicy(autonomous ? "none" : options_->policy, config.stop);
    drive_ = std::make_unique<SimulatedDrive>(config.simulator, Planet::byName(config.planet));
    run_ = std::make_unique<SimulatedRun>(config);
    if (!options_->bag.empty()) {
      bag_.emplace(options_->bag, config);
    }
    allowed_until_ = drive_->truth().stamp;
  }

  void subscribe(const Config& config) override {
    listen<StopStatus>(config.topics.stop, &SimulatorNodelet::onStatus);
    listen<nav_msgs::Odometry>(config.topics.odometry, &SimulatorNodelet::record<nav_msgs::Odometry>);
    listen<NavState>(config.topics.nav_state, &SimulatorNodelet::record<NavState>);
    listen<Slip>(config.topics.slip, &SimulatorNodelet::record<Slip>);
    if (supervisorIsWired(config)) {
      listen<geometry_msgs::Twist>(config.topics.cmd_vel, &SimulatorNodelet::onCommand);
    }
  }

  void advertise(const Config& config) override {
    sensors_ = std::make_unique<SensorPublisher>(node(), config);
    command_publisher_ = publisher<geometry_msgs::Twist>(config.topics.cmd_vel_in);
  }

  static bool supervisorIsWired(const Config& config) { return config.stop.stopMode() != StopMode::kOff; }

  double tickInterval_s() const override { return 0.05; }
  void onTick() override {
    const double tick_s = lastTickWas();
    if (waiting_ == Waiting::kForNodelets) {
      lookForNodelets();
    } else if (options_->rate > 0.0) {
      allowed_until_ += fromSeconds(options_->rate * tick_s);
    } else {
      allowed_until_ = drive_->truth().stamp + fromSeconds(kBlindAdvance_s);
    }
    proceed();
    losePatience();
  }

  double lastTickWas() {
    const double before_s = tick_s_;
    tick_s_ = now();
    return before_s > 0.0 ? tick_s_ - before_s : 0.0;
  }

  /// Each nodelet announces its own topics when it has subscribed to everything else.
  void lookForNodelets() {
    std::set<std::string> missing;
    for (const std::string& topic : expectedTopics()) {
      missing.insert(node().resolveName(topic));
    }
    ros::master::V_TopicInfo published;
    ros::master::getTopics(published);
    for (const ros::master::TopicInfo& topic : published) {
      missing.erase(topic.name);
    }
    awaited_ = missing.empty() ? "" : "nodelet that publishes " + *missing.begin();
    if (missing.empty()) {
      begun_s_ = now();
      allowed_until_ = drive_->truth().stamp;
      waitFor(Waiting::kForTime);
    }
  }

  std::vector<std::string> expectedTopics() const {
    std::vector<std::string> topics = {kInsStepsTopic, kCorrectionTopic, kInitialStateTopic, config_.topics.stop};
    if (supervisorIsWired(config_)) {
      topics.push_back(config_.topics.cmd_vel);
    }
    if (options_->policy == "autonomous") {
      topics.push_back(kForecastProgressTopic);
    }
    return topics;
  }

  void waitFor(Waiting what) {
    waiting_ = what;
    waiting_since_s_ = now();
  }

  void proceed() {
    while (goOn()) {
    }
  }

  /// @return false when something has to come first
  bool goOn() {
    switch (waiting_) {
      case Waiting::kForTime:
        if (!mayGoOn()) {
          return false;
        }
        drive_->finished() ? waitFor(Waiting::kForEstimates) : command();
        return true;
      case Waiting::kForStatus:
        if (!isCaughtUp()) {
          return false;
        }
        waitFor(Waiting::kForTime);
        return true;
      case Waiting::kForEstimates:
        if (recorder_.newestStamp() < run_->newestStamp()) {
          return false;
        }
        finish();
        return true;
      default:
        return false;
    }
  }

  bool estimatesCome() const { return newest_status_ != 0; }

  bool mayGoOn() const { return (options_->rate == 0.0 && estimatesCome()) || drive_->truth().stamp < allowed_until_; }

  /// The operator commands; with a supervisor, what comes back will be executed.
  void command() {
    const DriveMoment moment = drive_->moment();
    const VelocityCommand wanted = operator_->command(drive_->operatorCommand(), moment);
    const VelocityCommand in_users_axes{swapFrdFlu(wanted.linear_mps), swapFrdFlu(wanted.angular_radps)};
    if (supervisorIsWired(config_)) {
      waitFor(Waiting::kForCommand);
      awaited_ = config_.topics.cmd_vel;
    }
    command_publisher_.publish(boost::make_shared<geometry_msgs::Twist>(toTwist(in_users_axes)));
    if (!supervisorIsWired(config_)) {
      execute(wanted);
    }
  }

  void onCommand(const geometry_msgs::Twist::ConstPtr& message) {
    if (waiting_ != Waiting::kForCommand) {
      return;
    }
    const VelocityCommand command = toVelocityCommand(*message);
    execute({swapFrdFlu(command.linear_mps), swapFrdFlu(command.angular_radps)});
    proceed();
  }

  void execute(const VelocityCommand& command) {
    const sim::Measurements measurements = drive_->execute(command);
    const Nanoseconds known_until = run_->newestStamp();
    run_->add(measurements, drive_->truth());
    if (known_until == 0) {
      offline_start_ = drive_->truth().stamp;
    }
    if (bag_) {
      bag_->write(measurements, drive_->truth());
    }
    waitFor(Waiting::kForStatus);
    awaited_ = config_.topics.stop;
    sensors_->publish(measurements, drive_->truth());
  }

  /// Whether the nodelets have come as far as the offline run of the same samples.
  bool isCaughtUp() const {
    if (run_->newestStamp() == 0) {
      return true;
    }
    if (!estimatesCome()) {
      return drive_->truth().stamp < offline_start_ + fromSeconds(config_.filter.max_wait_s + kStartLag_s);
    }
    return newest_status_ >= run_->newestStamp();
  }

  void onStatus(const StopStatus::ConstPtr& message) {
    newest_status_ = toNanoseconds(message->header.stamp);
    proceed();
  }

  template <class Message>
  void record(const boost::shared_ptr<const Message>& message) {
    recorder_.add(*message);
    proceed();
  }

  void losePatience() {
    const bool idle = waiting_ == Waiting::kForTime || waiting_ == Waiting::kForNothing;
    if (idle || now() - waiting_since_s_ < kPatienceLimit_s) {
      return;
    }
    NODELET_ERROR("the simulation ends: no %s since %.0f s", awaited_.c_str(), kPatienceLimit_s);
    waitFor(Waiting::kForNothing);
    ros::requestShutdown();
  }

  void finish() {
    waitFor(Waiting::kForNothing);
    if (bag_) {
      bag_->close();
    }
    const RunReport offline = run_->finish();
    const RunReport report = withEstimates(offline, recorder_.track(), now() - begun_s_);
    if (!options_->out.empty()) {
      writeRunReport(options_->out, report);
    }
    if (!options_->out.empty() && options_->report) {
      plotReport(options_->out);
    }
    const std::string name = config_.simulator.terrain + " " + std::to_string(config_.simulator.seed);
    std::cout << comparisonText("simulate", report.estimates, offline.estimates) << tableHeader()
              << tableRow(name, thresholdInForce(), report.metrics) << std::flush;
    ros::requestShutdown();
  }

  std::optional<double> thresholdInForce() const {
    return options_->policy == "autonomous" ? std::optional(config_.forecast.threshold_m) : std::nullopt;
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool waits = waiting_ == Waiting::kForNodelets || !drive_;
    status.summary(waits ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                   waits ? "waiting for the other nodelets" : "driving");
    if (drive_) {
      status.addf("distance [m]", "%.1f", drive_->truth().distance_m);
    }
  }

  Config config_;
  std::optional<SimulationOptions> options_;
  std::unique_ptr<StopPolicy> operator_;
  std::unique_ptr<SimulatedDrive> drive_;
  std::unique_ptr<SimulatedRun> run_;  ///< the same samples offline: how far the nodelets must come, and the metrics
  std::optional<BagWriter> bag_;
  EstimateRecorder recorder_;
  Waiting waiting_ = Waiting::kForNodelets;
  double waiting_since_s_ = now();
  std::string awaited_;
  Nanoseconds allowed_until_ = 0;  ///< unless it is simulated as fast as it goes
  double tick_s_ = 0.0;
  double begun_s_ = 0.0;
  Nanoseconds offline_start_ = 0;
  Nanoseconds newest_status_ = 0;  ///< 0: there has been no estimate so far
  std::unique_ptr<SensorPublisher> sensors_;
  SharedPublisher<geometry_msgs::Twist> command_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::SimulatorNodelet, nodelet::Nodelet)
