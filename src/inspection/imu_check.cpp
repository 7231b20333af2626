#include "inspection/imu_check.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/navigation/input_check.h"

namespace slipnav {
namespace {

constexpr double kStandardGravity_mps2 = 9.80665;
/// Samples over which the mean rate is taken: no vibration lasts that long.
constexpr std::size_t kBlock = 20;
/// No rover turns faster than 290 °/s for the length of a block.
constexpr double kLargestRate_radps = 5.0;
/// Sensors and their scale factors are within this.
constexpr double kForceTolerance = 0.25;
/// Wheels and gyros differ by scrub and slip, not by this factor.
constexpr double kUnitFactor = 15.0;
/// Effective tracks of rovers [m].
constexpr double kLeastTrack_m = 0.03;
/// The same in wheel radii.
constexpr double kLeastTrackInRadii = 0.5;
/// Wheels in m/s and accelerometer agree within this, unless a radius is wrong.
constexpr double kLeastGain = 0.5;
constexpr double kLargestGain = 2.0;
constexpr double kReversed_rad = 0.75 * kPi;
constexpr double kAxisTolerance_rad = 0.35;
/// Where wheels slip much, their turns do not reveal an axis.
constexpr double kClearTurn = 0.5;
constexpr double kClearForce = 0.8;
constexpr double kTiltWorthSaying_rad = 0.1;
constexpr double kSigmas = 3.0;

Vector3 meanForce(const ImuRecord& record) {
  Vector3 sum = Vector3::Zero();
  double count = 0.0;
  for (const RawImuSample& sample : record.samples) {
    if (sample.specific_force.allFinite()) {
      sum += sample.specific_force;
      count += 1.0;
    }
  }
  return count > 0.0 ? Vector3(sum / count) : sum;
}

/// Over blocks of samples, the 95th percentile of their mean rates.
double fastTurning(const ImuRecord& record) {
  std::vector<double> rates;
  for (std::size_t begin = 0; begin + kBlock <= record.samples.size(); begin += kBlock) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = begin; i < begin + kBlock; ++i) {
      sum += record.samples[i].angular_rate;
    }
    if (sum.allFinite()) {
      rates.push_back(sum.norm() / static_cast<double>(kBlock));
    }
  }
  return rates.empty() ? 0.0 : percentile(std::move(rates), 95.0);
}

void checkTurn(const std::string& topic, const Mounting& mounting, const WheelTrack& wheels, Findings& findings) {
  if (!mounting.has_turn) {
    return;
  }
  const double least = wheels.in_meters ? kLeastTrack_m : kLeastTrackInRadii;
  const double smallest = wheels.turn_is_rate ? 1.0 / kUnitFactor : least;
  const bool too_fast = std::abs(mounting.turn_per_rate) < smallest;
  if (too_fast) {
    findings.push_back({Severity::kUnusable, topic, complaintOfRateUnit("more than 15 times as far as the wheels"),
                        "multiply by 0.01745 in the driver, or switch it to rad/s"});
  }
  if (mounting.turn_per_rate < 0.0) {
    findings.push_back(
        {Severity::kUnusable, topic,
         "gyros and wheels turn in opposite directions about the axis that the specific force says is up "
         "(correlation " +
             decimal(mounting.turn_correlation, 2) + ")",
         "the driver publishes gravity with the wrong sign (a level sensor at rest reads +9.8 m/s² upwards), the "
         "gyro's axes are not those of the accelerometer, or left and right wheels are swapped"});
    return;
  }
  const double off_rad = std::acos(std::clamp(mounting.turn_axis.dot(mounting.up), -1.0, 1.0));
  if (off_rad > kAxisTolerance_rad && mounting.turn_correlation > kClearTurn) {
    findings.push_back({Severity::kDoubtful, topic,
                        "the vehicle turns about an axis " + decimal(radToDeg(off_rad), 0) +
                            " deg away from the one that the specific force says is up",
                        "gyro and accelerometer do not have the same axes; rotate them in the driver"});
  }
}

void checkForward(const std::string& topic, const Mounting& mounting, const WheelTrack& wheels, Findings& findings) {
  if (!mounting.has_forward) {
    findings.push_back({Severity::kRemark, topic,
                        "starts and stops are too few or too gentle to tell which way the sensor points",
                        "drive straight ahead and brake a few times, or give imu.mount"});
    return;
  }
  const bool known = mounting.force_gain_std < 0.25 * mounting.force_gain && mounting.force_correlation > kClearForce;
  if (wheels.in_meters && known && (mounting.force_gain > kLargestGain || mounting.force_gain < kLeastGain)) {
    findings.push_back({Severity::kDoubtful, wheels.topic,
                        "the accelerometer sees " + decimal(mounting.force_gain, 2) + " ± " +
                            decimal(mounting.force_gain_std, 2) + " times the acceleration of the wheels",
                        "check the unit of the wheel speed and wheels[].radius_m"});
  }
  if (mounting.centripetal_ratio > 0.0 && kUnitFactor * mounting.centripetal_ratio < 1.0 &&
      kUnitFactor * kSigmas * mounting.centripetal_std < 1.0) {
    findings.push_back({Severity::kDoubtful, topic, complaintOfRateUnit("far more than the vehicle is pushed sideways"),
                        "multiply by 0.01745 in the driver, or switch it to rad/s"});
  }
}

void compareWithConfiguration(const std::string& topic, const Mounting& mounting, const WheelTrack& wheels,
                              const Matrix3& configured, Findings& findings) {
  const double tilt_rad = std::acos(std::clamp((configured * mounting.up).z(), -1.0, 1.0));
  const double turn_rad =
      mounting.has_forward ? std::atan2((configured * mounting.forward).y(), (configured * mounting.forward).x()) : 0.0;
  const bool upright = tilt_rad < 0.25 * kPi;
  const bool straight = std::abs(turn_rad) < 0.25 * kPi + kSigmas * mounting.forward_std_rad;
  if (upright && std::abs(turn_rad) > kReversed_rad) {
    findings.push_back({Severity::kUnusable, topic, complaintOfDirection(hasSign(wheels)),
                        "publish the speed with its sign, negative when the vehicle reverses; or correct wheels[].sign "
                        "or imu.mount.yaw_deg"});
  } else if (!upright || !straight) {
    const MountParams found = toMountParams(mounting.nearest);
    findings.push_back({Severity::kUnusable, topic,
                        "imu.mount does not match the sensor: its up axis is off by " + decimal(radToDeg(tilt_rad), 0) +
                            " deg, forward by " + decimal(radToDeg(std::abs(turn_rad)), 0) + " deg",
                        mounting.is_sure ? "imu: {mount: {roll_deg: " + decimal(found.roll_deg, 0) +
                                               ", pitch_deg: " + decimal(found.pitch_deg, 0) +
                                               ", yaw_deg: " + decimal(found.yaw_deg, 0) + "}}, by this drive"
                                         : "give the angles of the sensor in the vehicle"});
  }
}

}  // namespace

void checkImuMeasurements(const ImuRecord& record, Findings& findings) {
  const std::size_t messages = record.samples.size();
  const auto sayAbsent = [&](std::size_t absent, const std::string& what) {
    if (absent > 0) {
      findings.push_back({absent == messages ? Severity::kUnusable : Severity::kDoubtful, record.topic,
                          std::to_string(absent) + " of " + counted(messages, "message") + " say that there is no " +
                              what + ": covariance[0] is -1",
                          "choose a topic of the driver that has it"});
    }
  };
  sayAbsent(record.without_force, "linear acceleration");
  sayAbsent(record.without_rate, "angular velocity");
  const auto broken = static_cast<std::size_t>(
      std::count_if(record.samples.begin(), record.samples.end(), [](const RawImuSample& sample) {
        return !sample.specific_force.allFinite() || !sample.angular_rate.allFinite();
      }));
  if (broken > 0) {
    findings.push_back({Severity::kDoubtful, record.topic,
                        counted(broken, "sample") + " with numbers that are not finite",
                        "they are rejected; check the driver"});
  }
}

ImuUnits checkImuUnits(const ImuRecord& record, Findings& findings) {
  ImuUnits units;
  const double length = meanForce(record).norm();
  const std::string complaint =
      record.without_force == record.samples.size() ? "" : complaintOfForce(length, kStandardGravity_mps2);
  if (!complaint.empty()) {
    const bool in_g = std::abs(length - 1.0) < kForceTolerance;
    units.force = in_g ? kStandardGravity_mps2 : 1.0;
    units.has_gravity = in_g;
    findings.push_back({Severity::kUnusable, record.topic, complaint,
                        in_g ? "multiply by 9.80665 in the driver, or switch it to m/s²"
                             : "sensor_msgs/Imu has the specific force including gravity, in m/s²: look for a raw or "
                               "unfiltered topic of the driver"});
  }
  const double fast_radps = fastTurning(record);
  if (fast_radps > kLargestRate_radps) {
    units.rate = degToRad(1.0);
    findings.push_back({Severity::kUnusable, record.topic,
                        complaintOfRateUnit("at " + decimal(fast_radps, 1) + " rad/s, faster than a rover can"),
                        "multiply by 0.01745 in the driver, or switch it to rad/s"});
  }
  return units;
}

ImuRecord inProperUnits(ImuRecord record, const ImuUnits& units) {
  for (RawImuSample& sample : record.samples) {
    sample.specific_force *= units.force;
    sample.angular_rate *= units.rate;
  }
  return record;
}

void checkMounting(const std::string& topic, const Mounting& mounting, const WheelTrack& wheels,
                   const std::optional<Matrix3>& configured, Findings& findings) {
  checkTurn(topic, mounting, wheels, findings);
  checkForward(topic, mounting, wheels, findings);
  if (mounting.has_forward) {
    const MountParams found = toMountParams(mounting.nearest);
    findings.push_back({mounting.is_sure ? Severity::kRemark : Severity::kDoubtful, topic,
                        "the sensor is mounted " + axesText(mounting.nearest) + " (roll " + decimal(found.roll_deg, 0) +
                            ", pitch " + decimal(found.pitch_deg, 0) + ", yaw " + decimal(found.yaw_deg, 0) +
                            " deg); " + decimal(radToDeg(mounting.left_over_rad), 1) +
                            " deg remain, heading known to ±" + decimal(radToDeg(mounting.forward_std_rad), 1) +
                            " deg (1σ)",
                        mounting.left_over_rad > kTiltWorthSaying_rad
                            ? "measure the rest of the angles, or let ./run calibrate do it from a drive with truth"
                            : "nothing, if imu.mount says the same"});
  }
  if (configured) {
    compareWithConfiguration(topic, mounting, wheels, *configured, findings);
  }
}

}  // namespace slipnav
