/// Content of messages: any bytes that ROS takes for one, through conversion and pipeline.

#include <ros/serialization.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "fuzz_target.h"
#include "slipnav/navigator/pipeline.h"
#include "slipnav/navigator/sample_merger.h"
#include "slipnav/ros/conversions.h"
#include "slipnav/ros/wheel_input.h"

namespace {

using namespace slipnav;

/// Reads messages one after another off the input.
class Reader {
 public:
  Reader(const std::uint8_t* data, std::size_t size)
      : stream_(const_cast<std::uint8_t*>(data), static_cast<std::uint32_t>(size)) {}

  template <class Message>
  std::optional<Message> take() {
    Message message;
    try {
      ros::serialization::deserialize(stream_, message);
    } catch (const ros::serialization::StreamOverrunException&) {
      return std::nullopt;
    }
    return message;
  }

 private:
  ros::serialization::IStream stream_;
};

void check(const Estimate& estimate, const ErrorCovariance& P) {
  if (!isFinite(estimate.nav) || !P.allFinite()) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Config config;
  config.initialization.source = "given";
  config.initialization.levelling_window_s = 0.5;
  const ImuMount mount(config.imu.mount);
  WheelInput wheels(config);
  SampleMerger merger(config.filter.max_wait_s);
  Pipeline pipeline(Planet::byName(config.planet), config.navigation(), check);
  const SampleMerger::Sink pass = [&pipeline](const Sample& sample) {
    std::visit([&pipeline](const auto& s) { pipeline.push(s); }, sample);
  };
  Reader reader(data, size);
  bool more = true;
  while (more) {
    const auto imu = reader.take<sensor_msgs::Imu>();
    const auto joints = reader.take<sensor_msgs::JointState>();
    const auto fix = reader.take<sensor_msgs::NavSatFix>();
    more = imu && joints && fix;
    if (imu) {
      merger.push(toImuSample(*imu, mount));
    }
    const std::optional<WheelMotion> motion = joints ? wheels.take(*joints) : std::nullopt;
    if (motion) {
      merger.push(*motion);
    }
    const std::optional<GnssFix> converted = fix ? toGnssFix(*fix) : std::nullopt;
    if (converted) {
      merger.push(toPositionFix(*converted));
    }
    merger.advance(pass);
  }
  merger.flush(pass);
  return 0;
}
