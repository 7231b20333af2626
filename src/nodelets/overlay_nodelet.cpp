/// slipnav/Overlay: what rviz shows of a drive.
///
/// In: odometry, slip, initialization, error_forecast; imu/data and the wheels for dead reckoning; truth/fix,
/// truth/odometry or truth/pose. Out: path, truth/path, wheel_path, markers, figures, model/joint_states, TF of
/// overlay.frame.

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/NavSatFix.h>
#include <slipnav/Initialization.h>
#include <slipnav/Slip.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <optional>

#include "ros/messages/conversions.h"
#include "ros/messages/imu_input.h"
#include "ros/messages/wheel_input.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"
#include "ros/rviz/model_joints.h"
#include "ros/rviz/overlay_markers.h"

namespace slipnav {

namespace {

/// A start with the same origin, at most this long before the newest estimate [s], continues the same drive. After a
/// clock that has gone back it is a new one.
constexpr double kSameDrive_s = 5.0;
/// A transform from another node counts as published for this long [s] of real time.
constexpr double kForeignTransform_s = 2.0;
/// After this long without an estimate [s], the drawing of the present is stale.
constexpr double kSilence_s = 2.0;

}  // namespace

class OverlayNodelet : public NodeletBase {
 public:
  ~OverlayNodelet() override {
    transforms_.shutdown();
    stop();
  }

 private:
  void begin(const Config& config) override {
    params_ = config.overlay;
    map_ = config.frames.map;
    base_ = config.frames.base;
    planet_.emplace(Planet::byName(config.planet));
    imu_input_.emplace(config);
    wheel_input_.emplace(config);
    const MountParams& antenna = config.truth_mount;
    picture_.emplace(params_, config.truth, Vector3(antenna.x_m, antenna.y_m, antenna.z_m));
    markers_.emplace(params_, map_);
  }

  void subscribe(const Config& config) override {
    listen<Initialization>(kInitializationTopic, &OverlayNodelet::onInitialization);
    listen<nav_msgs::Odometry>(config.topics.odometry, &OverlayNodelet::onEstimate);
    listen<Slip>(config.topics.slip, &OverlayNodelet::onSlip);
    listen<ErrorForecast>(config.topics.error_forecast, &OverlayNodelet::onErrorForecast);
    listen<sensor_msgs::Imu>(config.topics.imu, &OverlayNodelet::onImu);
    listen<sensor_msgs::JointState>(config.topics.joint_states, &OverlayNodelet::onWheels<sensor_msgs::JointState>);
    listen<nav_msgs::Odometry>(config.topics.wheel_odometry, &OverlayNodelet::onWheels<nav_msgs::Odometry>);
    listen<sensor_msgs::NavSatFix>(config.topics.truth_fix, &OverlayNodelet::onTruthFix);
    listen<nav_msgs::Odometry>(config.topics.truth_odometry,
                               &OverlayNodelet::onTruthPose<nav_msgs::Odometry, TruthSource::kOdometry>);
    listen<geometry_msgs::PoseStamped>(config.topics.truth_pose,
                                       &OverlayNodelet::onTruthPose<geometry_msgs::PoseStamped, TruthSource::kPose>);
    if (config.frames.publish_tf) {
      const boost::function<void(const TransformEvent&)> watch = [this](const TransformEvent& event) {
        watchTransforms(event);
      };
      transforms_ = node().subscribe<tf2_msgs::TFMessage>("/tf", kQueueSize, watch);
    }
  }

  using TransformEvent = ros::MessageEvent<tf2_msgs::TFMessage const>;

  /// Two nodes must not both publish the vehicle's pose.
  void watchTransforms(const TransformEvent& event) {
    if (event.getPublisherName() == ros::this_node::getName()) {
      return;
    }
    const auto& transforms = event.getConstMessage()->transforms;
    if (std::any_of(transforms.begin(), transforms.end(),
                    [this](const auto& transform) { return transform.child_frame_id == base_; })) {
      foreign_publisher_ = event.getPublisherName();
      foreign_transform_s_ = now();
    }
  }

  void advertise(const Config& config) override {
    path_publisher_ = publisher<nav_msgs::Path>(config.topics.path, true);
    truth_publisher_ = publisher<nav_msgs::Path>(config.topics.truth_path, true);
    wheel_publisher_ = publisher<nav_msgs::Path>(config.topics.wheel_path, true);
    markers_publisher_ = publisher<visualization_msgs::MarkerArray>(config.topics.markers, true);
    figures_publisher_ = publisher<std_msgs::String>(kFiguresTopic);
    joints_publisher_ = publisher<sensor_msgs::JointState>(kModelJointsTopic);
  }

  void onInitialization(const Initialization::ConstPtr& message) {
    const bool goes_on = message->done && goesOn(*message);
    drive_ = message;
    if (goes_on) {
      return;
    }
    if (!message->done) {
      picture_->clear();
      messages_ = {};
      return;
    }
    const Geodetic origin{degToRad(message->latitude_deg), degToRad(message->longitude_deg), message->height_m};
    picture_->start(LocalFrame(*planet_, origin), toNanoseconds(message->header.stamp));
  }

  bool goesOn(const Initialization& start) const {
    return drive_ && drive_->done && picture_->newest() && start.latitude_deg == drive_->latitude_deg &&
           start.longitude_deg == drive_->longitude_deg && start.height_m == drive_->height_m &&
           toSeconds(picture_->newest()->stamp - toNanoseconds(start.header.stamp)) < kSameDrive_s;
  }

  void onEstimate(const nav_msgs::Odometry::ConstPtr& message) {
    estimates_watch_.heard(clocks());
    picture_->add(toEstimateSample(*message));
    sendFrame(*message);
  }

  /// At the rover, but aligned with the map: panel and legend neither turn nor rock.
  void sendFrame(const nav_msgs::Odometry& message) {
    geometry_msgs::TransformStamped transform;
    transform.header = message.header;
    transform.child_frame_id = params_.frame;
    transform.transform.translation.x = message.pose.pose.position.x;
    transform.transform.translation.y = message.pose.pose.position.y;
    transform.transform.translation.z = message.pose.pose.position.z;
    transform.transform.rotation.w = 1.0;
    tf_.sendTransform(transform);
  }

  void onSlip(const Slip::ConstPtr& message) {
    const bool defined = std::isfinite(message->mean_ratio);
    picture_->addSlip(toNanoseconds(message->header.stamp),
                      defined ? std::optional<double>(message->mean_ratio) : std::nullopt, message->stationary);
  }

  void onErrorForecast(const ErrorForecast::ConstPtr& message) { messages_.error_forecast = message; }

  void onImu(const sensor_msgs::Imu::ConstPtr& message) {
    if (const std::optional<ImuSample> sample = imu_input_->take(*message)) {
      picture_->wheelInput().add(*sample);
    }
  }

  template <class Message>
  void onWheels(const boost::shared_ptr<const Message>& message) {
    if (const std::optional<WheelMotion> wheels = wheel_input_->take(*message)) {
      picture_->wheelInput().add(SpeedSample{wheels->stamp, wheels->motion.forward_mps});
      joints_.add(*wheels);
      if (joints_publisher_.hasSubscribers()) {
        joints_publisher_.publish(boost::make_shared<sensor_msgs::JointState>(joints_.message()));
      }
    }
  }

  void onTruthFix(const sensor_msgs::NavSatFix::ConstPtr& message) {
    if (const std::optional<GnssFix> fix = toGnssFix(*message)) {
      picture_->truthInput().add(*fix);
    }
  }

  template <class Message, TruthSource source>
  void onTruthPose(const boost::shared_ptr<const Message>& message) {
    if (const std::optional<TruthSample> truth = toTruthSample(*message)) {
      picture_->truthInput().add(source, *truth);
    }
  }

  void onTick() override {
    const bool due = now() >= published_at_s_ + params_.publish_period_s;
    const bool stale = estimates_watch_.isSilent(clocks());
    if (due && (picture_->revision() != published_revision_ || stale != messages_.stale)) {
      messages_.stale = stale;
      published_at_s_ = now();
      published_revision_ = picture_->revision();
      publishAll();
    }
  }

  /// The topics are latched: late subscribers get the newest.
  void publishAll() {
    path_publisher_.publish(boost::make_shared<nav_msgs::Path>(toPath(picture_->track(), map_)));
    truth_publisher_.publish(boost::make_shared<nav_msgs::Path>(toPath(picture_->truth(), map_)));
    wheel_publisher_.publish(boost::make_shared<nav_msgs::Path>(toPath(picture_->wheels(), map_)));
    markers_publisher_.publish(
        boost::make_shared<visualization_msgs::MarkerArray>(markers_->make(*picture_, messages_)));
    const auto figures = boost::make_shared<std_msgs::String>();
    figures->data = picture_->newest() && !messages_.stale ? figuresOf(*picture_) : "";
    figures_publisher_.publish(figures);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const bool showing = picture_ && picture_->newest();
    status.summary(DiagnosticStatus::OK, showing ? "drawing" : "waiting for the estimate");
    if (!foreign_publisher_.empty() && now() - foreign_transform_s_ < kForeignTransform_s) {
      status.summary(DiagnosticStatus::ERROR,
                     "another node publishes the transform of " + base_ + ": " + foreign_publisher_);
    }
    if (picture_) {
      status.add("points of the path", picture_->track().points().size());
      status.add("points of the truth", picture_->truth().points().size());
      status.add("points of the wheel path", picture_->wheels().points().size());
      status.add("stops", picture_->stops().stops().size());
    }
  }

  OverlayParams params_;
  std::string map_;
  std::string base_;
  ros::Subscriber transforms_;
  std::string foreign_publisher_;  ///< of a transform that belongs to this package
  double foreign_transform_s_ = 0.0;
  std::optional<Planet> planet_;
  std::optional<ImuInput> imu_input_;
  std::optional<WheelInput> wheel_input_;
  std::optional<DriveView> picture_;
  std::optional<OverlayMarkers> markers_;
  OverlayMessages messages_;
  SilenceWatch estimates_watch_{kSilence_s};
  Initialization::ConstPtr drive_;  ///< where the present drive started
  ModelJoints joints_;
  tf2_ros::TransformBroadcaster tf_;
  double published_at_s_ = 0.0;
  std::uint64_t published_revision_ = 0;
  SharedPublisher<nav_msgs::Path> path_publisher_;
  SharedPublisher<nav_msgs::Path> truth_publisher_;
  SharedPublisher<nav_msgs::Path> wheel_publisher_;
  SharedPublisher<visualization_msgs::MarkerArray> markers_publisher_;
  SharedPublisher<std_msgs::String> figures_publisher_;
  SharedPublisher<sensor_msgs::JointState> joints_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::OverlayNodelet, nodelet::Nodelet)
