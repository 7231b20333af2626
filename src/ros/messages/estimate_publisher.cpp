#include "ros/messages/estimate_publisher.h"

#include <boost/make_shared.hpp>

#include "core/slip/vehicle_slip.h"
#include "ros/messages/conversions.h"
#include "ros/messages/forecast_messages.h"
#include "ros/runtime/internal_topics.h"

namespace slipnav {

EstimatePublisher::EstimatePublisher(ros::NodeHandle& node, const Config& config)
    : config_(config),
      planet_(Planet::byName(config.planet)),
      geometry_(config.wheelGeometry()),
      odometry_(SharedPublisher<nav_msgs::Odometry>(node, config.topics.odometry)),
      nav_state_(SharedPublisher<NavState>(node, config.topics.nav_state)),
      slip_(SharedPublisher<Slip>(node, config.topics.slip)),
      forecast_input_(SharedPublisher<ForecastInput>(node, kForecastInputTopic)) {}

void EstimatePublisher::start(const Geodetic& origin, const Vector3& lever_imu_to_base_b, double gyro_noise_density) {
  output_.emplace(planet_, origin, lever_imu_to_base_b, gyro_noise_density);
}

void EstimatePublisher::publish(const Estimate& estimate, const ErrorCovariance& P) {
  if (estimate.has_wheels) {
    publishSlip(estimate);
    publishForecastInput(estimate, P);
  }
  const auto nav_state = boost::make_shared<NavState>();
  fill(estimate, P, output_->frame(), config_.frames, config_.filter.max_wheel_interval_s, *nav_state);
  nav_state_.publish(nav_state);

  const Output output = output_->make(estimate, P);
  const auto odometry = boost::make_shared<nav_msgs::Odometry>();
  fill(output, config_.frames, *odometry);
  odometry_.publish(odometry);
  if (config_.frames.publish_tf) {
    tf_.sendTransform(toTransform(output, config_.frames));
  }
}

void EstimatePublisher::publishForecastInput(const Estimate& estimate, const ErrorCovariance& P) {
  const auto input = boost::make_shared<ForecastInput>();
  fill(estimate, P, *input);
  forecast_input_.publish(input);
}

void EstimatePublisher::publishSlip(const Estimate& estimate) {
  const auto slip = boost::make_shared<Slip>();
  fill(vehicleSlip(estimate, geometry_), estimate.stationary, geometry_, config_.frames, *slip);
  slip_.publish(slip);
}

}  // namespace slipnav
