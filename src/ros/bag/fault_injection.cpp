#include "ros/bag/fault_injection.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace slipnav {
namespace {

using sensor_msgs::Imu;
using sensor_msgs::JointState;
using sensor_msgs::NavSatFix;

constexpr double kForever_s = 1e6;

std_msgs::Header& headerOf(RecordedMessage& message) {
  return std::visit([](auto& content) -> std_msgs::Header& { return content.header; }, message.content);
}

bool isWithin(const RecordedMessage& message, const ros::Time& begin, double duration_s) {
  return message.time >= begin && (message.time - begin).toSec() < duration_s;
}

/// Edits all messages of one type in a period, truth excluded.
template <class Message, class Edit>
Fault editing(const std::string& name, double duration_s, Edit edit) {
  return {name, [duration_s, edit](Recording& recording, const FaultTimes& times) {
            for (RecordedMessage& recorded : recording) {
              Message* message = std::get_if<Message>(&recorded.content);
              if (message != nullptr && isWithin(recorded, times.drive, duration_s)) {
                edit(*message);
              }
            }
          }};
}

template <class Message>
void dropMessages(const std::string& topic, const ros::Time& begin, double duration_s, Recording& recording) {
  const auto is_lost = [&](const RecordedMessage& recorded) {
    return std::holds_alternative<Message>(recorded.content) && (topic.empty() || recorded.topic == topic) &&
           isWithin(recorded, begin, duration_s);
  };
  recording.erase(std::remove_if(recording.begin(), recording.end(), is_lost), recording.end());
}

template <class Message>
Fault dropping(const std::string& name, double duration_s) {
  return {name, [duration_s](Recording& recording, const FaultTimes& times) {
            dropMessages<Message>("", times.drive, duration_s, recording);
          }};
}

/// Keeps the first value of the period.
template <class Message, class Value>
Fault freezing(const std::string& name, double duration_s, Value value) {
  return {name, [duration_s, value](Recording& recording, const FaultTimes& times) {
            double frozen = std::numeric_limits<double>::quiet_NaN();
            for (RecordedMessage& recorded : recording) {
              Message* message = std::get_if<Message>(&recorded.content);
              if (message != nullptr && isWithin(recorded, times.drive, duration_s)) {
                double& present = value(*message);
                present = frozen = std::isnan(frozen) ? present : frozen;
              }
            }
          }};
}

bool isSensor(const RecordedMessage& recorded) {
  return std::holds_alternative<Imu>(recorded.content) || std::holds_alternative<JointState>(recorded.content);
}

/// The stamp of one IMU or wheel message.
void shiftOneStamp(double shift_s, const ros::Time& begin, Recording& recording) {
  const auto hit = std::find_if(recording.begin(), recording.end(), [&begin](const RecordedMessage& recorded) {
    return isSensor(recorded) && recorded.time >= begin;
  });
  if (hit != recording.end()) {
    headerOf(*hit).stamp += ros::Duration(shift_s);
  }
}

/// All stamps from some time on, the truth's as well.
void shiftAllStamps(double shift_s, const ros::Time& begin, Recording& recording) {
  for (RecordedMessage& recorded : recording) {
    if (recorded.time >= begin) {
      headerOf(recorded).stamp += ros::Duration(shift_s);
    }
  }
}

std::vector<Fault> imuFaults(const Config& config) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double full_scale_radps = degToRad(config.imu.input.max_rate_deg_per_s);
  return {editing<Imu>("IMU NaN, 0.5 s", 0.5, [nan](Imu& imu) { imu.angular_velocity.y = nan; }),
          dropping<Imu>("IMU gap, 0.1 s", 0.1),
          dropping<Imu>("IMU gap, 1 s", 1.0),
          dropping<Imu>("IMU gap, 5 s", 5.0),
          editing<Imu>("IMU saturated, 0.5 s", 0.5,
                       [full_scale_radps](Imu& imu) { imu.angular_velocity.x = full_scale_radps; }),
          freezing<Imu>("gyro axis stuck, 5 s", 5.0, [](Imu& imu) -> double& { return imu.angular_velocity.z; }),
          freezing<Imu>("accelerometer axis stuck, 5 s", 5.0,
                        [](Imu& imu) -> double& { return imu.linear_acceleration.x; })};
}

std::vector<Fault> wheelFaults() {
  const auto double_speed = [](JointState& joints) { joints.velocity.at(1) *= 2.0; };
  const auto swap_sides = [](JointState& joints) {
    std::swap(joints.velocity.at(0), joints.velocity.at(1));
    std::swap(joints.velocity.at(2), joints.velocity.at(3));
  };
  const auto positions_alone = [](JointState& joints) {
    constexpr double kWrap_rad = 64.0 * kPi;
    joints.velocity.clear();
    for (double& position : joints.position) {
      position -= kWrap_rad * std::floor(position / kWrap_rad);
    }
  };
  return {dropping<JointState>("wheel gap, 5 s", 5.0),
          freezing<JointState>("encoder stuck, 20 s", 20.0,
                               [](JointState& joints) -> double& { return joints.velocity.at(0); }),
          editing<JointState>("encoder dead, 20 s", 20.0, [](JointState& joints) { joints.velocity.at(0) = 0.0; }),
          editing<JointState>("freewheeling wheel, 20 s", 20.0, double_speed),
          editing<JointState>("encoder wrap", kForever_s, positions_alone),
          editing<JointState>("left and right joints swapped", kForever_s, swap_sides)};
}

void duplicate(Recording& recording, const FaultTimes& times) {
  Recording doubled;
  for (const RecordedMessage& recorded : recording) {
    doubled.push_back(recorded);
    if (isWithin(recorded, times.drive, 5.0)) {
      doubled.push_back(recorded);
    }
  }
  recording = std::move(doubled);
}

/// Wheel messages late by up to half a second, overtaking each other; now and then two IMU messages swap places.
void reorder(Recording& recording, const FaultTimes& times) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (RecordedMessage& recorded : recording) {
    if (!isWithin(recorded, times.drive, 20.0)) {
      continue;
    }
    if (std::holds_alternative<JointState>(recorded.content)) {
      recorded.time += ros::Duration(0.5 * uniform(engine));
    } else if (std::holds_alternative<Imu>(recorded.content) && uniform(engine) < 0.02) {
      recorded.time += ros::Duration(0.03);
    }
  }
  std::stable_sort(recording.begin(), recording.end(),
                   [](const RecordedMessage& a, const RecordedMessage& b) { return a.time < b.time; });
}

Fault shifting(const std::string& name, double shift_s, bool single) {
  return {name, [shift_s, single](Recording& recording, const FaultTimes& times) {
            (single ? shiftOneStamp : shiftAllStamps)(shift_s, times.drive, recording);
          }};
}

std::vector<Fault> timeFaults() {
  std::vector<Fault> faults = {{"messages duplicated, 5 s", duplicate},
                               {"messages reordered, 20 s", reorder},
                               shifting("one stamp 1000 s ahead", 1000.0, true),
                               shifting("one stamp 1000 s back", -1000.0, true),
                               {"stamps not set",
                                [](Recording& recording, const FaultTimes& times) {
                                  for (RecordedMessage& recorded : recording) {
                                    if (isSensor(recorded) && isWithin(recorded, times.drive, 0.05)) {
                                      headerOf(recorded).stamp = ros::Time();
                                    }
                                  }
                                }},
                               shifting("clock jumps 3 s ahead", 3.0, false),
                               shifting("clock jumps 30 s back", -30.0, false)};
  return faults;
}

Fault gpsOutage(const std::string& topic) {
  Fault fault{"GPS outage at initialization, 10 s", [topic](Recording& recording, const FaultTimes& times) {
                dropMessages<NavSatFix>(topic, times.initialization, 10.0, recording);
              }};
  fault.at_initialization = true;
  return fault;
}

void append(std::vector<Fault> more, std::vector<Fault>& faults) {
  std::move(more.begin(), more.end(), std::back_inserter(faults));
}

template <class Message>
bool take(const rosbag::MessageInstance& instance, Recording& recording) {
  const auto message = instance.instantiate<Message>();
  if (message) {
    recording.push_back({instance.getTime(), instance.getTopic(), *message});
  }
  return message != nullptr;
}

}  // namespace

Recording readRecording(const std::string& path) {
  Recording recording;
  const rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    take<Imu>(instance, recording) || take<JointState>(instance, recording) || take<NavSatFix>(instance, recording) ||
        take<nav_msgs::Odometry>(instance, recording);
  }
  return recording;
}

void writeRecording(const std::string& path, const Recording& recording) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  for (const RecordedMessage& recorded : recording) {
    std::visit([&](const auto& content) { bag.write(recorded.topic, recorded.time, content); }, recorded.content);
  }
}

std::vector<Fault> allFaults(const Config& config) {
  std::vector<Fault> faults;
  append(imuFaults(config), faults);
  append(wheelFaults(), faults);
  append(timeFaults(), faults);
  faults.push_back(gpsOutage("/" + config.topics.gps_fix));
  return faults;
}

}  // namespace slipnav
