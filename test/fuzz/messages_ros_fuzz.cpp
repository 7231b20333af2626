/// Content of the messages of sensors and truth: whatever ROS takes for one, through conversion and pipeline, up to the
/// messages that come out. All of those must be finite.

#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/navigation/sample_merger.h"
#include "core/slip/vehicle_slip.h"
#include "fuzz_target.h"
#include "message_reader.h"
#include "ros/messages/conversions.h"
#include "ros/messages/forecast_messages.h"
#include "ros/messages/wheel_input.h"
#include "slipnav/core/navigation/output.h"
#include "slipnav/core/navigation/pipeline.h"

namespace {

using namespace slipnav;

Config makeConfig() {
  Config config;
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 0.5;
  return config;
}

const Config& config() {
  static const Config config = makeConfig();
  return config;
}

const Planet& planet() {
  static const Planet planet = Planet::byName(config().planet);
  return planet;
}

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

/// What nodelets publish of an estimate.
void examine(const Estimate& estimate, const ErrorCovariance& P) {
  static const OutputMaker output(planet(), {degToRad(39.65), degToRad(-79.9), 300.0}, Vector3::Zero(), 1e-6);
  require(isFinite(estimate.nav) && P.allFinite());
  const Output out = output.make(estimate, P);
  require(out.position_enu_m.allFinite() && out.q_flu_to_enu.coeffs().allFinite() && out.pose_covariance.allFinite());
  require(out.velocity_flu_mps.allFinite() && out.angular_rate_flu_radps.allFinite() &&
          out.twist_covariance.allFinite());
  NavState state;
  fill(estimate, P, output.frame(), config().frames, config().filter.max_wheel_interval_s, state);
  require(std::isfinite(state.position.x) && std::isfinite(state.orientation.w) && std::isfinite(state.side_slip_rad));
  if (estimate.has_wheels) {
    static const WheelGeometry geometry = config().wheelGeometry();
    const VehicleSlip slip = vehicleSlip(estimate, geometry);
    require(std::abs(slip.mean_ratio.value_or(0.0)) <= 1.0 && std::isfinite(slip.forward_mps));
    ForecastInput input;
    fill(estimate, P, input);
    require(isFinite(estimateOf(input).nav) && covarianceOf(input) == P);
  }
}

sensor_msgs::Imu restingImu(double time_s) {
  sensor_msgs::Imu message;
  message.header.stamp.fromSec(time_s);
  message.linear_acceleration.z = 9.8;
  message.linear_acceleration.x = 1e-3 * std::sin(100.0 * time_s);
  message.angular_velocity.z = 1e-4 * std::cos(100.0 * time_s);
  return message;
}

/// The pipeline of a rover that has stood for a second, so that most inputs meet a running filter.
Pipeline makeRunningPipeline() {
  Pipeline pipeline(planet(), config().navigation(), examine);
  const ImuMount mount(config().imu.mount);
  for (int i = 1; i <= 20; ++i) {
    pipeline.push(toImuSample(restingImu(100.0 + 0.05 * i), mount));
  }
  require(pipeline.initial().has_value());
  return pipeline;
}

/// Everything that messages reach.
class Rover {
 public:
  explicit Rover(const Pipeline& pipeline) : pipeline_(pipeline) {}

  void handle(int type, fuzz::MessageReader& reader) {
    switch (type) {
      case 0:
        use<sensor_msgs::Imu>(reader, [this](const auto& m) { take(toImuSample(m, mount_)); });
        break;
      case 1:
        use<sensor_msgs::JointState>(reader, [this](const auto& m) { takeIfAny(wheels_.take(m)); });
        break;
      case 2:
        use<nav_msgs::Odometry>(reader, [this](const auto& m) {
          takeIfAny(wheels_.take(m));
          checkTruth(toTruthSample(m));
        });
        break;
      case 3:
        use<sensor_msgs::NavSatFix>(reader, [this](const auto& m) {
          if (const std::optional<GnssFix> fix = toGnssFix(m)) {
            take(toPositionFix(*fix));
          }
        });
        break;
      case 4:
        use<geometry_msgs::TwistWithCovarianceStamped>(reader, [this](const auto& m) {
          if (const std::optional<VelocityFix> fix = toVelocityFix(m)) {
            take(*fix);
          }
        });
        break;
      default:
        use<geometry_msgs::PoseStamped>(reader, [](const auto& m) { checkTruth(toTruthSample(m)); });
        break;
    }
    merger_.advance(pass_);
  }

  void finish() { merger_.flush(pass_); }

  static constexpr int kTypes = 6;

 private:
  template <class Message, class Use>
  static void use(fuzz::MessageReader& reader, const Use& use) {
    if (const std::optional<Message> message = reader.take<Message>()) {
      use(*message);
    }
  }

  void take(const Sample& sample) { merger_.push(sample); }

  void takeIfAny(const std::optional<WheelMotion>& motion) {
    if (motion) {
      take(*motion);
    }
  }

  static void checkTruth(const std::optional<TruthSample>& truth) {
    if (truth) {
      require(truth->position_enu_m.allFinite() && (!truth->q_flu_to_enu || truth->q_flu_to_enu->coeffs().allFinite()));
    }
  }

  Pipeline pipeline_;
  ImuMount mount_{config().imu.mount};
  WheelInput wheels_{config()};
  SampleMerger merger_{config().filter.max_wait_s};
  const SampleMerger::Sink pass_ = [this](const Sample& sample) {
    std::visit([this](const auto& s) { pipeline_.push(s); }, sample);
  };
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Pipeline resting(planet(), config().navigation(), examine);
  static const Pipeline running = makeRunningPipeline();
  fuzz::MessageReader reader(data, size);
  Rover rover(reader.nextType(2) == 0 ? running : resting);
  while (const std::optional<int> type = reader.nextType(Rover::kTypes)) {
    rover.handle(*type, reader);
  }
  rover.finish();
  return 0;
}
