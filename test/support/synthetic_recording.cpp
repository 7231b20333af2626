#include "synthetic_recording.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "slipnav/core/earth/local_frame.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kBegin = 1'000'000 * kSecond;
constexpr Nanoseconds kOnTheWay = kSecond / 100;
constexpr double kCycle_s = 15.0;
constexpr double kRest_s = 5.0;
constexpr double kRamp_s = 1.0;
constexpr double kSpeed_mps = 0.5;
constexpr double kGravity_mps2 = 9.806;

MessageTime timeAt(double t_s) {
  const Nanoseconds stamp = kBegin + fromSeconds(t_s);
  return {stamp, stamp + kOnTheWay};
}

double speedAt(double t_s) {
  const double phase_s = std::fmod(t_s, kCycle_s) - kRest_s;
  const double left_s = kCycle_s - kRest_s - phase_s;
  return kSpeed_mps * std::clamp(std::min(phase_s, left_s) / kRamp_s, 0.0, 1.0);
}

double headingRateAt(double t_s) { return 0.4 * std::sin(0.37 * t_s + 0.002 * t_s * t_s) * speedAt(t_s) / kSpeed_mps; }

double accelerationAt(double t_s) { return (speedAt(t_s + 0.01) - speedAt(t_s - 0.01)) / 0.02; }

void addImu(const SyntheticDrive& drive, Recording& recording) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto noise = [&](double std) -> Vector3 {
    return std * Vector3(normal(generator), normal(generator), normal(generator));
  };
  ImuRecord imu;
  imu.topic = "/imu/data";
  imu.frame = "imu_link";
  for (double t_s = 0.02; t_s < drive.duration_s; t_s += 0.02) {
    const double middle_s = t_s - 0.01;
    const Vector3 force(accelerationAt(middle_s), speedAt(middle_s) * headingRateAt(middle_s), kGravity_mps2);
    const Vector3 rate(0.0, 0.0, headingRateAt(middle_s));
    imu.samples.push_back({timeAt(t_s), drive.C_sensor_to_flu.transpose() * force + noise(0.02),
                           drive.C_sensor_to_flu.transpose() * rate + noise(0.002)});
  }
  recording.imus.push_back(imu);
  recording.topics.push_back({imu.topic, "sensor_msgs/Imu", imu.samples.size(), 1});
}

void addJoints(const SyntheticDrive& drive, Recording& recording) {
  JointRecord joints;
  joints.topic = "/joint_states";
  joints.names = {"front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"};
  double left_rad = 0.0;
  double right_rad = 0.0;
  for (double t_s = 0.1; t_s < drive.duration_s; t_s += 0.1) {
    const double half = 0.5 * drive.track_m * headingRateAt(t_s - 0.05);
    const double left = (speedAt(t_s - 0.05) - half) / drive.radius_m;
    const double right = (speedAt(t_s - 0.05) + half) / drive.radius_m;
    left_rad += 0.1 * left;
    right_rad += 0.1 * right;
    joints.samples.push_back({timeAt(t_s), {left_rad, right_rad, left_rad, right_rad}, {left, right, left, right}});
  }
  recording.joints.push_back(joints);
  recording.topics.push_back({joints.topic, "sensor_msgs/JointState", joints.samples.size(), 1});
}

void addTruth(const SyntheticDrive& drive, Recording& recording) {
  FixRecord truth;
  truth.topic = "/truth/fix";
  truth.frame = "gps";
  const LocalFrame frame(Planet::byName("earth"), {degToRad(39.65), degToRad(-79.9), 300.0});
  double heading_rad = 0.0;
  Vector3 position_m = Vector3::Zero();
  for (int i = 1; 0.01 * i < drive.duration_s; ++i) {
    const double t_s = 0.01 * i;
    heading_rad += 0.01 * headingRateAt(t_s);
    position_m += 0.01 * speedAt(t_s) * Vector3(std::cos(heading_rad), std::sin(heading_rad), 0.0);
    if (i % 20 == 0) {
      const Geodetic place = frame.toGeodetic(position_m);
      RawFixSample sample;
      sample.time = timeAt(t_s);
      sample.has_fix = sample.is_usable = sample.has_covariance = true;
      sample.fix = {sample.time.stamp, radToDeg(place.latitude_rad), radToDeg(place.longitude_rad), place.height_m,
                    1e-4 * Matrix3::Identity()};
      truth.samples.push_back(sample);
    }
  }
  recording.fixes.push_back(truth);
  recording.topics.push_back({truth.topic, "sensor_msgs/NavSatFix", truth.samples.size(), 1});
}

}  // namespace

Recording syntheticRecording(const SyntheticDrive& drive) {
  Recording recording;
  recording.begin = kBegin;
  recording.end = kBegin + fromSeconds(drive.duration_s);
  addImu(drive, recording);
  addJoints(drive, recording);
  addTruth(drive, recording);
  return recording;
}

}  // namespace slipnav::test
