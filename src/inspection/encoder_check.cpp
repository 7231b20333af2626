#include "inspection/encoder_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/square.h"
#include "core/base/statistics.h"

namespace slipnav {
namespace {

constexpr double kTurn_rad = 2.0 * kPi;
/// Angles in single precision.
constexpr double kSlack_rad = 1e-3;
constexpr double kMultiple = 0.02;  // of the step
constexpr double kLeastShare = 0.98;
/// Velocity and differenced position agree within it; rpm, °/s and turns do not.
constexpr double kRatioTolerance = 0.1;
constexpr double kLeastTurned_rad = 3.0;
constexpr std::size_t kLeastBatches = 2;

/// The step that (nearly) all values are multiples of, 0 for none.
double stepOf(std::vector<double> magnitudes) {
  magnitudes.erase(std::remove_if(magnitudes.begin(), magnitudes.end(), [](double m) { return m < 1e-9; }),
                   magnitudes.end());
  if (magnitudes.size() < 20) {
    return 0.0;
  }
  const double step = percentile(magnitudes, 1.0);
  if (percentile(magnitudes, 99.0) > 1e4 * step) {
    return 0.0;
  }
  const auto multiples = std::count_if(magnitudes.begin(), magnitudes.end(), [step](double m) {
    return std::abs(m / step - std::round(m / step)) < kMultiple * std::max(1.0, m / step);
  });
  const bool varied = percentile(magnitudes, 90.0) > 1.5 * step && percentile(magnitudes, 50.0) < 20.0 * step;
  return varied && static_cast<double>(multiples) > kLeastShare * static_cast<double>(magnitudes.size()) ? step : 0.0;
}

double shorterWay(double difference_rad, bool wraps) {
  return wraps ? std::remainder(difference_rad, kTurn_rad) : difference_rad;
}

class Collector {
 public:
  Collector(const JointRecord& record, std::size_t joint) : record_(record), joint_(joint) {}

  EncoderPicture picture() {
    noteValues();
    noteChanges();
    return picture_;
  }

 private:
  bool hasPosition(const RawJointSample& sample) const { return joint_ < sample.position_rad.size(); }
  bool hasVelocity(const RawJointSample& sample) const { return joint_ < sample.velocity_radps.size(); }

  void noteValues() {
    picture_.least_position_rad = std::numeric_limits<double>::infinity();
    picture_.greatest_position_rad = -std::numeric_limits<double>::infinity();
    std::vector<double> velocities;
    for (const RawJointSample& sample : record_.samples) {
      if (hasPosition(sample)) {
        picture_.has_position = true;
        picture_.least_position_rad = std::min(picture_.least_position_rad, sample.position_rad[joint_]);
        picture_.greatest_position_rad = std::max(picture_.greatest_position_rad, sample.position_rad[joint_]);
      }
      if (hasVelocity(sample)) {
        picture_.has_velocity = true;
        noteVelocity(sample.velocity_radps[joint_], velocities);
      }
    }
    picture_.velocity_step_radps = stepOf(std::move(velocities));
  }

  void noteVelocity(double velocity, std::vector<double>& velocities) {
    if (!std::isfinite(velocity)) {
      ++picture_.velocity_not_finite;
      return;
    }
    picture_.velocity_always_zero = picture_.velocity_always_zero && velocity == 0.0;
    picture_.least_velocity_radps = std::min(picture_.least_velocity_radps, velocity);
    velocities.push_back(std::abs(velocity));
  }

  void noteChanges() {
    const double least = picture_.least_position_rad;
    const double greatest = picture_.greatest_position_rad;
    const bool within =
        picture_.has_position && greatest - least <= kTurn_rad + kSlack_rad && greatest - least > 0.9 * kTurn_rad;
    std::vector<double> changes;
    double product = 0.0;
    double energy = 0.0;
    const RawJointSample* before = nullptr;
    for (const RawJointSample& sample : record_.samples) {
      if (before != nullptr && hasPosition(sample) && hasPosition(*before)) {
        const double change = shorterWay(sample.position_rad[joint_] - before->position_rad[joint_], within);
        changes.push_back(std::abs(change));
        picture_.turned_rad += std::isfinite(change) ? std::abs(change) : 0.0;
        const double dt_s = toSeconds(sample.time.stamp - before->time.stamp);
        if (hasVelocity(sample) && std::isfinite(sample.velocity_radps[joint_]) && dt_s > 0.0 && dt_s < 1.0) {
          product += sample.velocity_radps[joint_] * change / dt_s;
          energy += square(change / dt_s);
        }
      }
      before = &sample;
    }
    picture_.wraps = within && picture_.turned_rad > 2.0 * kTurn_rad;
    picture_.resolution_rad = stepOf(std::move(changes));
    picture_.velocity_ratio = energy > 0.0 && picture_.turned_rad > kLeastTurned_rad ? product / energy : 0.0;
  }

  const JointRecord& record_;
  std::size_t joint_;
  EncoderPicture picture_;
};

std::string label(const WheelJoint& wheel) {
  return wheel.name.empty() ? "joint " + std::to_string(wheel.index) : wheel.name;
}

void checkVelocity(const std::string& subject, const EncoderPicture& picture, Findings& findings) {
  const bool moves = picture.turned_rad > kLeastTurned_rad;
  if (picture.has_velocity && picture.velocity_not_finite > 0) {
    findings.push_back({Severity::kDoubtful, subject,
                        std::to_string(picture.velocity_not_finite) + " velocities are not finite numbers",
                        picture.has_position ? "positions are used instead; check the driver" : "check the driver"});
  } else if (picture.has_velocity && picture.velocity_always_zero && moves) {
    findings.push_back({Severity::kDoubtful, subject, "velocities are always 0 while positions move",
                        "positions are used instead; a driver without velocities leaves the array empty"});
  } else if (picture.velocity_ratio != 0.0 && std::abs(picture.velocity_ratio - 1.0) > kRatioTolerance) {
    findings.push_back({picture.velocity_ratio < 0.0 ? Severity::kUnusable : Severity::kDoubtful, subject,
                        "velocity is " + decimal(picture.velocity_ratio, 3) + " times the change of position",
                        "sensor_msgs/JointState has rad and rad/s (9.55: rpm; 57.3: °/s; 0.16: turns/s; negative: one "
                        "of them counts backwards)"});
  }
}

void describe(const JointRecord& record, const std::vector<WheelJoint>& wheels, const EncoderPicture& first,
              Findings& findings) {
  std::string list;
  for (const WheelJoint& wheel : wheels) {
    const char* side = wheel.side == Side::kLeft ? "left" : wheel.side == Side::kRight ? "right" : "side unknown";
    list += (list.empty() ? "" : ", ") + label(wheel) + " (" + side + (wheel.sign < 0.0 ? ", counts backwards)" : ")");
  }
  std::string resolution;
  if (first.resolution_rad > 0.0) {
    resolution = "; positions in steps of " + decimal(1e3 * first.resolution_rad, 2) + " mrad";
  } else if (first.velocity_step_radps > 0.0) {
    resolution = "; velocities in steps of " + decimal(first.velocity_step_radps, 4) + " rad/s";
  }
  findings.push_back({Severity::kRemark, record.topic, "wheels: " + list + resolution,
                      "nothing, if wheels[] has these names and signs"});
  if (first.wraps) {
    findings.push_back({Severity::kRemark, record.topic, "angles wrap after one turn",
                        "nothing, they are unwrapped; the wheels must not make half a turn between two messages"});
  }
}

}  // namespace

EncoderPicture pictureOf(const JointRecord& record, std::size_t joint) { return Collector(record, joint).picture(); }

void checkEncoders(const JointRecord& record, const std::vector<WheelJoint>& wheels, const JointRates& rates,
                   Findings& findings) {
  if (wheels.empty()) {
    return;
  }
  describe(record, wheels, pictureOf(record, wheels.front().index), findings);
  for (const WheelJoint& wheel : wheels) {
    checkVelocity(record.topic + " " + label(wheel), pictureOf(record, wheel.index), findings);
  }
  for (const std::string& problem : rates.problems) {
    findings.push_back({Severity::kDoubtful, record.topic, problem, "check the driver; such messages are rejected"});
  }
}

void checkDirection(const WheelTrack& wheels, const Mounting& mounting, Findings& findings) {
  const std::size_t against = mounting.batches_certainly_backward;
  const std::size_t along = mounting.batches_certainly_forward;
  if (hasSign(wheels) || against < kLeastBatches || along < kLeastBatches) {
    return;
  }
  findings.push_back({Severity::kUnusable, wheels.topic,
                      "wheels and IMU disagree on the direction in " + counted(against, "piece") +
                          " of the drive and agree in " + std::to_string(along) + ", and the wheel speed has no sign",
                      "publish the speed with its sign: negative when the vehicle reverses"});
}

}  // namespace slipnav
