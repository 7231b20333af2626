/// slipnav/Simulator: a simulated rover and its operator, driven through the real nodelets.
///
/// Out: imu/data, joint_states, gps/fix, truth/fix, truth/odometry, cmd_vel_in, /clock. In: cmd_vel, stop,
/// initial_state, odometry, nav_state, slip.
///
/// All nodelets are synchronized by stamps: an interval begins once everything that must follow from the last one has
/// come back. So the drive equals that of the offline simulation, whatever the load of the machine, and in whatever
/// process this nodelet runs; see doc/nodelets.md.

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

#include "evaluation/simulated_drive.h"
#include "nodelets/simulation_options.h"
#include "ros/bag/bag_writer.h"
#include "ros/messages/conversions.h"
#include "ros/messages/stop_messages.h"
#include "ros/replay/endurance_watch.h"
#include "ros/replay/node_process.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/simulation/sensor_publisher.h"
#include "ros/simulation/simulation_result.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav {
namespace {

/// [s] of real time after which a missing answer is given up.
constexpr double kPatienceLimit_s = 60.0;
/// While nobody answers, at most this much is simulated in one tick [s]: queues must not overflow.
constexpr double kBlindAdvance_s = 1.0;
/// The initial state may come this much later than offline [s], besides filter.max_wait_s: sensors are waited for.
constexpr double kStartLag_s = 1.0;

}  // namespace

class SimulatorNodelet : public NodeletBase {
 public:
  ~SimulatorNodelet() override { stop(); }

 private:
  enum class Waiting { kForNodelets, kForTime, kForCommand, kForEstimates, kForNothing };

  /// Without a simulator there is nothing to wait for: the process ends, and the launch with it.
  void begin(const Config& config) override {
    try {
      build(config);
    } catch (const std::exception&) {
      ros::requestShutdown();
      throw;
    }
  }

  void build(const Config& config) {
    config_ = config;
    geometry_.emplace(config.wheelGeometry());
    options_.emplace(privateNode());
    const bool autonomous = options_->policy == "autonomous";
    if (autonomous && config.stop.stopMode() != StopMode::kActive) {
      throw std::invalid_argument("policy autonomous needs stop.mode: active");
    }
    operator_ = makeStopPolicy(autonomous ? "none" : options_->policy, config.stop);
    const Planet planet = Planet::byName(config.planet);
    drive_ = std::make_unique<SimulatedDrive>(config.simulator, planet);
    twin_.emplace(planet, config.navigation(),
                  [this](const Estimate& estimate, const ErrorCovariance&) { twin_stamp_ = estimate.nav.stamp; });
    judge_ = makeJudge(config, planet);
    if (!options_->bag.empty()) {
      bag_.emplace(options_->bag, config);
    }
    allowed_until_ = drive_->truth().stamp;
  }

  std::unique_ptr<DriveEvaluator> makeJudge(const Config& config, const Planet& planet) {
    if (options_->endurance_h == 0.0) {
      return std::make_unique<SimulationResult>(config, options_->out, options_->report,
                                                options_->policy == "autonomous");
    }
    const std::string manager = node().resolveName(options_->manager);
    return std::make_unique<EnduranceWatch>(planet, options_->endurance_h, options_->out,
                                            [manager] { return usageOf(pidOf(manager)).memory_mb * 1e6 / 1024.0; });
  }

  void subscribe(const Config& config) override {
    listen<StopStatus>(config.topics.stop, &SimulatorNodelet::onStatus);
    if (supervisorIsWired(config)) {
      listen<geometry_msgs::Twist>(config.topics.cmd_vel, &SimulatorNodelet::onCommand);
    }
    listen<nav_msgs::Odometry>(config.topics.odometry, &SimulatorNodelet::judge<nav_msgs::Odometry>);
    listen<Initialization>(kInitializationTopic, &SimulatorNodelet::judge<Initialization>);
    if (options_->endurance_h == 0.0) {
      listen<NavState>(config.topics.nav_state, &SimulatorNodelet::judge<NavState>);
      listen<Slip>(config.topics.slip, &SimulatorNodelet::judge<Slip>);
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

  /// Each nodelet advertises its own topics after it has subscribed to everything else.
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
    awaited_ = missing.empty() ? "connection to the nodelets" : "nodelet that publishes " + *missing.begin();
    if (missing.empty() && isConnectedToNodelets()) {
      allowed_until_ = drive_->truth().stamp;
      waitFor(Waiting::kForTime);
    }
  }

  /// Connecting to another process takes a moment, and anything published before is lost.
  bool isConnectedToNodelets() const {
    return isConnected() && sensors_->areHeard() &&
           (!supervisorIsWired(config_) || command_publisher_.hasSubscribers());
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

  /// @return false if something else must come first
  bool goOn() {
    switch (waiting_) {
      case Waiting::kForTime:
        if (!mayGoOn()) {
          return false;
        }
        drive_->finished() || judge_->hasSeenEnough() ? finish() : command();
        return true;
      case Waiting::kForEstimates:
        if (!isCaughtUp()) {
          return false;
        }
        waitFor(Waiting::kForTime);
        return true;
      default:
        return false;
    }
  }

  bool estimatesCome() const { return newest_status_ != 0; }

  bool mayGoOn() const { return (options_->rate == 0.0 && estimatesCome()) || drive_->truth().stamp < allowed_until_; }

  /// The operator commands; with a supervisor, its answer will be executed.
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
    if (twin_stamp_ == 0) {
      twin_start_ = drive_->truth().stamp;
    }
    pushMeasurements(measurements, *geometry_, *twin_);
    judge_->add(measurements, drive_->truth());
    if (bag_) {
      bag_->write(measurements, drive_->truth());
    }
    waitFor(Waiting::kForEstimates);
    awaited_ = config_.topics.stop + " or " + config_.topics.odometry;
    sensors_->publish(measurements, drive_->truth());
  }

  /// Whether the nodelets have come as far as the pipeline has with the same samples.
  bool isCaughtUp() const {
    if (twin_stamp_ == 0) {
      return true;
    }
    if (!estimatesCome()) {
      return drive_->truth().stamp < twin_start_ + fromSeconds(config_.filter.max_wait_s + kStartLag_s);
    }
    return newest_status_ >= twin_stamp_ && judge_->newestStamp() >= twin_stamp_;
  }

  void onStatus(const StopStatus::ConstPtr& message) {
    newest_status_ = toNanoseconds(message->header.stamp);
    judge_->add(*message);
    proceed();
  }

  template <class Message>
  void judge(const boost::shared_ptr<const Message>& message) {
    judge_->add(*message);
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
    std::cout << judge_->verdict() << std::flush;
    ros::requestShutdown();
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
  std::optional<WheelGeometry> geometry_;
  std::optional<SimulationOptions> options_;
  std::unique_ptr<StopPolicy> operator_;
  std::unique_ptr<SimulatedDrive> drive_;
  /// The same samples in one thread: shows how far the nodelets must come.
  std::optional<Pipeline> twin_;
  Nanoseconds twin_stamp_ = 0;  ///< of its newest estimate
  Nanoseconds twin_start_ = 0;  ///< when it had its first one
  std::unique_ptr<DriveEvaluator> judge_;
  std::optional<BagWriter> bag_;
  Waiting waiting_ = Waiting::kForNodelets;
  double waiting_since_s_ = now();
  std::string awaited_;
  Nanoseconds allowed_until_ = 0;  ///< unless simulated as fast as possible
  double tick_s_ = 0.0;
  Nanoseconds newest_status_ = 0;  ///< 0: no estimate so far
  std::unique_ptr<SensorPublisher> sensors_;
  SharedPublisher<geometry_msgs::Twist> command_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::SimulatorNodelet, nodelet::Nodelet)
