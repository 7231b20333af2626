#pragma once
/// Publishes what the filter finds: odometry, nav_state, slip and TF.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>

#include "slipnav/config/config.h"
#include "slipnav/filter/filter_data.h"
#include "slipnav/navigator/output.h"

namespace slipnav {

class EstimatePublisher {
 public:
  explicit EstimatePublisher(const Config& config);

  void advertise(ros::NodeHandle& node);

  /// A new map frame. @param gyro_noise_density [rad²/s]
  void start(const Geodetic& origin, double gyro_noise_density);

  /// One estimate. Call start() before.
  void publish(const Estimate& estimate, const ErrorCovariance& P);

 private:
  void publishSlip(const Estimate& estimate);

  Config config_;
  Planet planet_;
  WheelGeometry geometry_;
  std::optional<OutputMaker> output_;
  tf2_ros::TransformBroadcaster tf_;
  ros::Publisher odometry_;
  ros::Publisher nav_state_;
  ros::Publisher slip_;
};

}  // namespace slipnav
