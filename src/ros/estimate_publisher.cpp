#include "slipnav/ros/estimate_publisher.h"

#include <boost/make_shared.hpp>

#include "slipnav/ros/conversions.h"
#include "slipnav/ros/internal_messages.h"
#include "slipnav/ros/internal_topics.h"
#include "slipnav/slip/vehicle_slip.h"

namespace slipnav {
namespace {

constexpr std::uint32_t kQueueSize = 10000;

}  // namespace

EstimatePublisher::EstimatePublisher(ros::NodeHandle& node, const Config& config)
    : config_(config),
      planet_(Planet::byName(config.planet)),
      geometry_(config.wheelGeometry()),
      odometry_(node.advertise<nav_msgs::Odometry>(config.topics.odometry, kQueueSize)),
      nav_state_(node.advertise<NavState>(config.topics.nav_state, kQueueSize)),
      slip_(node.advertise<Slip>(config.topics.slip, kQueueSize)),
      forecast_input_(node.advertise<ForecastInput>(kForecastInputTopic, kQueueSize)) {}

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
  nav_state_.publish(NavState::ConstPtr(nav_state));

  const Output output = output_->make(estimate, P);
  const auto odometry = boost::make_shared<nav_msgs::Odometry>();
  fill(output, config_.frames, *odometry);
  odometry_.publish(nav_msgs::Odometry::ConstPtr(odometry));
  tf_.sendTransform(toTransform(output, config_.frames));
}

void EstimatePublisher::publishForecastInput(const Estimate& estimate, const ErrorCovariance& P) {
  const auto input = boost::make_shared<ForecastInput>();
  fill(estimate, P, *input);
  forecast_input_.publish(ForecastInput::ConstPtr(input));
}

void EstimatePublisher::publishSlip(const Estimate& estimate) {
  const auto slip = boost::make_shared<Slip>();
  fill(vehicleSlip(estimate, geometry_), estimate.stationary, geometry_, config_.frames, *slip);
  slip_.publish(Slip::ConstPtr(slip));
}

}  // namespace slipnav
