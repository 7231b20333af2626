/// slipnav/Initializer: finds where to start.
///
/// In: imu/data, joint_states or wheel_odometry, gps/fix. Out, latched: initial_state, initialization, TF map → odom.

#include <sensor_msgs/Imu.h>
#include <slipnav/Initialization.h>
#include <slipnav/StartState.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "slipnav/math/rotation.h"
#include "slipnav/navigator/initializer.h"
#include "slipnav/navigator/sample_merger.h"
#include "slipnav/ros/conversions.h"
#include "slipnav/ros/core_nodelet.h"
#include "slipnav/ros/internal_messages.h"
#include "slipnav/ros/internal_topics.h"
#include "slipnav/ros/patience.h"
#include "slipnav/ros/wheel_input.h"

namespace slipnav {

class InitializerNodelet : public CoreNodelet {
 private:
  void begin(const Config& config) override {
    if (config.initialization.source == "truth") {
      throw std::invalid_argument("initialization.source: truth is for the evaluator only");
    }
    const NavigationSetup setup = config.navigation();
    frames_ = config.frames;
    mount_.emplace(config.imu.mount);
    wheel_input_.emplace(config);
    screen_.emplace(setup.imu_input);
    merger_.emplace(config.filter.max_wait_s);
    initializer_.emplace(Planet::byName(config.planet), setup.initialization, setup.imu_input, setup.filter);
  }

  void subscribe(const Config& config) override {
    listen<sensor_msgs::Imu>(config.topics.imu, &InitializerNodelet::onImu);
    listen<sensor_msgs::JointState>(config.topics.joint_states, &InitializerNodelet::onWheels<sensor_msgs::JointState>);
    listen<nav_msgs::Odometry>(config.topics.wheel_odometry, &InitializerNodelet::onWheels<nav_msgs::Odometry>);
    listen<sensor_msgs::NavSatFix>(config.topics.gps_fix, &InitializerNodelet::onFix);
  }

  void advertise(const Config&) override {
    progress_publisher_ = publisher<Initialization>(kInitializationTopic, true);
    start_publisher_ = publisher<StartState>(kInitialStateTopic, true);
  }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    const ImuSample sample = toImuSample(*message, *mount_);
    trusted_.push(sample.stamp, now());
    merger_->push(sample);
    proceed();
  }

  template <class Message>
  void onWheels(const boost::shared_ptr<const Message>& message) {
    if (const std::optional<WheelMotion> motion = wheel_input_->take(*message)) {
      merger_->push(*motion);
      proceed();
    }
  }

  void onFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    if (const std::optional<GnssFix> fix = toGnssFix(*message)) {
      merger_->push(toPositionFix(*fix));
      proceed();
    }
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
    ImuVerdict verdict = screen_->check(sample).verdict;
    if (verdict == ImuVerdict::kTimeWentBack) {
      screen_->reset();
      initializer_->reset();
      ++session_;
      done_ = false;
      verdict = screen_->check(sample).verdict;
    }
    if (isAccepted(verdict)) {
      useWhileSearching(sample);
    }
  }
  void use(const WheelMotion& wheels) { useWhileSearching(wheels); }
  void use(const PositionFix& fix) { useWhileSearching(fix); }

  template <class CoreSample>
  void useWhileSearching(const CoreSample& sample) {
    if (done_) {
      return;
    }
    initializer_->push(sample);
    if (const std::optional<InitialState> initial = initializer_->result()) {
      done_ = true;
      announce(*initial);
    }
  }

  void announce(const InitialState& initial) {
    const auto message = boost::make_shared<StartState>();
    message->session = session_;
    fill(initial, *message);
    start_publisher_.publish(StartState::ConstPtr(message));

    geometry_msgs::TransformStamped map_to_odom;
    map_to_odom.header.stamp = message->state.stamp;
    map_to_odom.header.frame_id = frames_.map;
    map_to_odom.child_frame_id = frames_.odom;
    map_to_odom.transform.rotation.w = 1.0;
    tf_.sendTransform(map_to_odom);
    reportEnd(initial);
  }

  void reportEnd(const InitialState& initial) {
    const auto report = boost::make_shared<Initialization>();
    report->header.stamp = toRosTime(initial.nav.stamp);
    report->header.frame_id = frames_.map;
    report->done = true;
    report->progress = progress_ = "done";
    report->latitude_deg = radToDeg(initial.origin.latitude_rad);
    report->longitude_deg = radToDeg(initial.origin.longitude_rad);
    report->height_m = initial.origin.height_m;
    report->heading_deg = radToDeg(eulerFrom_q_b_to_n(initial.nav.q_b_to_n).z());
    report->heading_std_deg = radToDeg(std::sqrt(initial.P(kAttitude + 2, kAttitude + 2)));
    progress_publisher_.publish(Initialization::ConstPtr(report));
    NODELET_INFO("initialisation done at %.3f s: %.7f deg, %.7f deg, %.2f m, heading %.2f deg (1 sigma %.2f deg)",
                 report->header.stamp.toSec(), report->latitude_deg, report->longitude_deg, report->height_m,
                 report->heading_deg, report->heading_std_deg);
  }

  void reportProgress() {
    if (done_ || initializer_->progress() == progress_) {
      return;
    }
    progress_ = initializer_->progress();
    const auto report = boost::make_shared<Initialization>();
    report->header.stamp = toRosTime(screen_->newestStamp());
    report->header.frame_id = frames_.map;
    report->progress = progress_;
    progress_publisher_.publish(Initialization::ConstPtr(report));
    NODELET_INFO("initialisation: %s", progress_.c_str());
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(done_ ? DiagnosticStatus::OK : DiagnosticStatus::WARN, progress_);
    status.add("restarts", session_);
  }

  FrameNames frames_;
  std::optional<ImuMount> mount_;
  std::optional<WheelInput> wheel_input_;
  std::optional<ImuScreen> screen_;
  std::optional<SampleMerger> merger_;
  std::optional<Initializer> initializer_;
  TrustedStamp trusted_;
  std::uint32_t session_ = 0;  ///< restarts of the IMU's clock
  bool done_ = false;
  std::string progress_;
  tf2_ros::StaticTransformBroadcaster tf_;
  ros::Publisher start_publisher_;
  ros::Publisher progress_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::InitializerNodelet, nodelet::Nodelet)
