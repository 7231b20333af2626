#pragma once
/// Publishes the filter's results: odometry, nav_state, slip and TF.

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <slipnav/ForecastInput.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>

#include "config/config.h"
#include "ros/runtime/shared_publisher.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/navigation/output.h"

namespace slipnav {

/// The publishers of the nodelet Filter.
class EstimatePublisher {
 public:
  EstimatePublisher(ros::NodeHandle& node, const Config& config);

  /// A new map frame.
  /// @param lever_imu_to_base_b from the IMU to base_link, body axes [m]; @param gyro_noise_density [rad²/s]
  void start(const Geodetic& origin, const Vector3& lever_imu_to_base_b, double gyro_noise_density);

  /// The map frame. Call start() before.
  const LocalFrame& frame() const { return output_->frame(); }

  /// One estimate. Call start() before.
  void publish(const Estimate& estimate, const ErrorCovariance& P);

 private:
  void publishSlip(const Estimate& estimate);
  void publishForecastInput(const Estimate& estimate, const ErrorCovariance& P);

  Config config_;
  Planet planet_;
  WheelGeometry geometry_;
  std::optional<OutputMaker> output_;
  tf2_ros::TransformBroadcaster tf_;
  SharedPublisher<nav_msgs::Odometry> odometry_;
  SharedPublisher<NavState> nav_state_;
  SharedPublisher<Slip> slip_;
  SharedPublisher<ForecastInput> forecast_input_;
};

}  // namespace slipnav
