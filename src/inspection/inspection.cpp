#include "inspection/inspection.h"

#include <algorithm>
#include <cmath>

#include "core/ordering/stamp_watch.h"
#include "evaluation/truth_gate.h"
#include "inspection/encoder_check.h"
#include "inspection/stream_check.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/navigation/input_check.h"

namespace slipnav {
namespace {

constexpr StreamNeeds kImuNeeds = {20.0, 1000.0, false};  // scatter: see ImuClock
constexpr StreamNeeds kWheelNeeds = {2.0, 1000.0, true};
constexpr StreamNeeds kPositionNeeds = {0.0, 1000.0, false};
/// No message takes this long.
constexpr double kApart_s = 0.5;
/// wheel.stamp_delay_s corrects up to this much.
constexpr double kCorrectable_s = 1.0;
/// Smaller shifts are not resolved.
constexpr double kLeastShift_s = 0.1;
/// For the first pose of a truth in the robot's own frame, and for those that follow (sine of half of the tilt).
constexpr double kZero_m = 1e-3;
constexpr double kLevel = 1e-4;
constexpr double kLeans = 2e-3;
/// Speeds that DirectionCheck considers.
constexpr double kRestSpeed_mps = 0.02;

/// Starts at exactly zero with attitude zero, and is tilted later: the frame is that of the robot at the start.
bool isInStartFrame(const PoseRecord& record) {
  const auto tilt = [](const RawPoseSample& sample) {  // sine of half of it
    return sample.q_to_parent ? sample.q_to_parent->vec().head<2>().norm() : 0.0;
  };
  const auto leans = [&tilt](const RawPoseSample& sample) { return tilt(sample) > kLeans; };
  const RawPoseSample& first = record.samples.front();
  const bool begins_at_zero = first.position_m.norm() < kZero_m && first.q_to_parent && tilt(first) < kLevel;
  return begins_at_zero && std::any_of(record.samples.begin(), record.samples.end(), leans);
}

bool hasUnusable(const Findings& findings) { return statusOf(findings) == 2; }

class Inspector {
 public:
  Inspector(const Recording& recording, const InspectionOptions& options) : recording_(recording), options_(options) {
    if (options.config) {
      names_ = options.config->topics;
    }
    if (!options.truth.empty()) {
      names_.truth_fix = names_.truth_odometry = names_.truth_pose = options.truth;
    }
  }

  Inspection run() {
    chooseRoles();
    checkPublishers();
    if (result_.roles.imu != nullptr) {
      checkImu();
    }
    checkPositions();
    mergeAlike(result_.findings);
    sortWorstFirst(result_.findings);
    return std::move(result_);
  }

 private:
  void say(Severity severity, const std::string& subject, const std::string& text, const std::string& remedy) {
    result_.findings.push_back({severity, subject, text, remedy});
  }

  std::vector<std::string> configuredWheelNames() const {
    std::vector<std::string> wheels;
    if (options_.config) {
      for (const WheelParams& wheel : options_.config->wheels) {
        wheels.push_back(wheel.name);
      }
    }
    return wheels;
  }

  void chooseRoles() {
    result_.roles = proposeRoles(recording_, names_, configuredWheelNames());
    if (options_.config) {
      checkTopicNames(recording_, result_.roles, names_, result_.findings);
    }
    const bool odometry_wanted = options_.config && options_.config->wheel.source == "wheel_odometry";
    if (odometry_wanted && result_.roles.wheel_odometry != nullptr) {
      result_.roles.joints = nullptr;
    }
    if (result_.roles.imu == nullptr) {
      say(Severity::kUnusable, "recording", "has no IMU (sensor_msgs/Imu)", "record one");
    }
    if (result_.roles.joints == nullptr && result_.roles.wheel_odometry == nullptr) {
      say(Severity::kUnusable, "recording",
          "has no wheels: neither joints that turn (sensor_msgs/JointState) nor their odometry (nav_msgs/Odometry)",
          "record one of them; without wheels only filter.updates: [] can be evaluated");
    }
    for (const std::string& damage : recording_.damage) {
      say(Severity::kDoubtful, "recording", damage, "record it again; the messages before are used");
    }
  }

  bool isUsed(const std::string& topic) const {
    const auto is = [&topic](const auto* record) { return record != nullptr && record->topic == topic; };
    return is(result_.roles.imu) || is(result_.roles.joints) || is(result_.roles.fix) ||
           (result_.roles.joints == nullptr && is(result_.roles.wheel_odometry));
  }

  void checkPublishers() {
    for (const TopicRecord& topic : recording_.topics) {
      if (topic.publishers > 1 && isUsed(topic.topic)) {
        say(Severity::kDoubtful, topic.topic, "comes from " + counted(topic.publishers, "publisher"),
            "one of them is enough: rosnode info, or rosbag play of an old recording beside the driver");
      }
    }
    for (const ImuRecord& other : recording_.imus) {
      if (result_.roles.imu != nullptr && other.topic == result_.roles.imu->topic &&
          other.frame != result_.roles.imu->frame) {
        say(Severity::kDoubtful, other.topic,
            "comes from two sensors: frame_id '" + result_.roles.imu->frame + "' is used, '" + other.frame +
                "' is ignored (" + counted(other.samples.size(), "message") + ")",
            "give each driver its own topic, or set frames.imu");
      }
    }
  }

  void checkImu() {
    const ImuRecord& record = *result_.roles.imu;
    imu_statistics_ = statisticsOf(timesOf(record));
    checkStream(record.topic, imu_statistics_, kImuNeeds, result_.findings);
    checkImuMeasurements(record, result_.findings);
    const ImuUnits units = checkImuUnits(record, result_.findings);
    const ImuTrack imu(inProperUnits(record, units), recording_.begin);
    imu_begin_s_ = imu.begin();
    imu_end_s_ = imu.end();
    checkScatter(record.topic, imu.stampFaults());
    makeTrack();
    result_.rest = pictureOf(imu, restsOf(result_.track));
    checkRests(record.topic, result_.rest, options_.noise(), result_.findings);
    if (result_.track.rows.empty()) {
      return;
    }
    checkClocks(imu);
    const double ahead_s = result_.clock.known && result_.stamps_are_set ? result_.clock.wheels_ahead_s : 0.0;
    drive_ = deadReckoning(imu, result_.track, result_.rest.force.normalized(), result_.rest.rate, ahead_s);
    const bool has_force = units.has_gravity && record.without_force < record.samples.size();
    if (has_force) {
      checkMotion(imu, record.topic);
    }
  }

  void checkScatter(const std::string& topic, const StampFaults& faults) {
    if (faults.scatter_s > 0.0) {
      say(Severity::kDoubtful, topic,
          "stamps scatter by " + decimal(1e3 * faults.scatter_s, 1) + " ms about a steady interval of " +
              decimal(1e3 * faults.usual_interval_s, 1) + " ms, as from a busy host",
          "they are corrected; a driver that uses the sensor's own time is better");
    }
    if (faults.lost > 0) {
      say(Severity::kDoubtful, topic, counted(faults.lost, "sample") + " lost",
          "check the load of the computer and the queue of the driver");
    }
  }

  void makeTrack() {
    if (result_.roles.joints != nullptr) {
      makeTrackOfJoints(*result_.roles.joints);
    } else if (result_.roles.wheel_odometry != nullptr) {
      const PoseRecord& odometry = *result_.roles.wheel_odometry;
      result_.track = trackOf(odometry, recording_.begin);
      checkWheelStream(odometry.topic, timesOf(odometry));
    }
    if (!result_.track.topic.empty() && !hasMoved()) {
      say(Severity::kDoubtful, result_.track.topic, "the wheels never turn", "record a drive");
    }
  }

  bool hasMoved() const {
    return std::any_of(result_.track.rows.begin(), result_.track.rows.end(),
                       [](const WheelRow& row) { return row.largest > 0.0; });
  }

  void checkWheelStream(const std::string& topic, const std::vector<MessageTime>& times) {
    wheel_statistics_ = statisticsOf(times);
    result_.stamps_are_set = wheel_statistics_.zero == 0;
    checkStream(topic, wheel_statistics_, kWheelNeeds, result_.findings);
  }

  void makeTrackOfJoints(const JointRecord& record) {
    checkWheelStream(record.topic, timesOf(record));
    if (options_.config) {
      result_.wheels = wheelsByConfiguration(record, options_.config->wheels);
      checkWheelNames(record);
    }
    const bool configured = !result_.wheels.empty();
    if (!configured) {
      result_.wheels = wheelsByName(record);
      for (WheelJoint& wheel : result_.wheels) {
        wheel.radius_m = options_.wheel_radius_m;
      }
    }
    const JointRates rates = ratesOf(record, result_.wheels, recording_.begin);
    std::vector<WheelJoint> by_data = result_.wheels;
    chooseSigns(rates, by_data);
    if (configured) {
      checkSigns(record.topic, by_data);
    } else {
      result_.wheels = by_data;
    }
    checkEncoders(record, result_.wheels, rates, result_.findings);
    result_.track = trackOf(rates, result_.wheels);
    result_.track.topic = record.topic;
  }

  void checkWheelNames(const JointRecord& record) {
    std::string joints;
    for (const std::string& name : record.names) {
      joints += (joints.empty() ? "" : ", ") + name;
    }
    for (const WheelParams& wheel : options_.config->wheels) {
      if (!wheel.name.empty() && !record.names.empty() &&
          std::find(record.names.begin(), record.names.end(), wheel.name) == record.names.end()) {
        say(Severity::kUnusable, record.topic, "has no joint '" + wheel.name + "'; it has " + joints,
            "wheels: give the names of the recording");
      }
    }
  }

  void checkSigns(const std::string& topic, const std::vector<WheelJoint>& by_data) {
    std::string wrong;
    for (std::size_t i = 0; i < by_data.size(); ++i) {
      if (by_data[i].sign * by_data.front().sign != result_.wheels[i].sign * result_.wheels.front().sign) {
        wrong += (wrong.empty() ? "" : ", ") + by_data[i].name;
      }
    }
    if (!wrong.empty()) {
      say(Severity::kUnusable, topic,
          "turn opposite to '" + by_data.front().name + "' according to their configured signs: " + wrong,
          "wheels[].sign: -1 where an encoder counts backwards when the vehicle drives forward");
    }
  }

  void checkClocks(const ImuTrack& imu) {
    compareReceipt(result_.track.topic, wheel_statistics_);
    const Vector3 up = result_.rest.force.norm() > 0.0 ? Vector3(result_.rest.force.normalized()) : Vector3::UnitZ();
    result_.clock = correlateClocks(imu, result_.track, up);
    const double ahead_s = result_.clock.wheels_ahead_s;
    const double configured_s = options_.config ? options_.config->wheel.stamp_delay_s : 0.0;
    if (!result_.stamps_are_set || !result_.clock.isBeyond(configured_s)) {
      return;
    }
    const double limit_s = std::max(kLeastShift_s, result_.track.interval_s);
    const double off_s = std::abs(ahead_s - configured_s);
    say(off_s > kApart_s  ? Severity::kUnusable
        : off_s > limit_s ? Severity::kDoubtful
                          : Severity::kRemark,
        result_.track.topic,
        "its stamps are " + decimal(std::abs(ahead_s), 2) + " ± " + decimal(result_.clock.std_s, 2) + " s " +
            (ahead_s > 0.0 ? "ahead of" : "behind") + " those of " + result_.roles.imu->topic +
            ", by the motion that both observe (" + (result_.clock.by_turns ? "heading rates" : "accelerations") +
            ", correlation " + decimal(result_.clock.correlation, 2) + ")",
        std::abs(ahead_s) <= kCorrectable_s ? "wheel: {stamp_delay_s: " + decimal(ahead_s, 3) + "}"
                                            : "let one computer stamp both, or synchronize the clocks (chrony)");
  }

  void compareReceipt(const std::string& topic, const StreamStatistics& statistics) {
    const double apart_s = imu_statistics_.delay_s - statistics.delay_s;
    const bool known = imu_statistics_.zero == 0 && statistics.zero == 0 && statistics.messages > 0;
    if (known && std::abs(apart_s) > kApart_s) {
      say(Severity::kUnusable, topic, "by message arrival, " + clocksApart(result_.roles.imu->topic, topic, apart_s),
          "synchronize the clocks (chrony); for a receiver in GPS time see initialization.fix_stamp_offset_s");
    }
  }

  void checkMotion(const ImuTrack& imu, const std::string& topic) {
    const double ahead_s = result_.clock.known ? result_.clock.wheels_ahead_s : 0.0;
    const MotionTable table = motionTable(imu, result_.track, result_.rest, ahead_s);
    result_.mounting = estimateMounting(table, result_.rest);
    std::optional<Matrix3> configured;
    if (options_.config || options_.tf) {
      const MountParams mount = options_.config ? options_.config->imu.mount : *options_.tf;
      configured = toRotation(mount);
    }
    checkMounting(topic, result_.mounting, result_.track, configured, result_.findings);
    checkDirection(result_.track, result_.mounting, result_.findings);
    if (!hasUnusable(result_.findings) && result_.track.in_meters && (configured || result_.mounting.is_sure)) {
      checkAsEstimator(imu, configured.value_or(result_.mounting.nearest), ahead_s);
    }
  }

  /// Complaints that the estimator itself would make.
  void checkAsEstimator(const ImuTrack& imu, const Matrix3& C_sensor_to_flu, double ahead_s) {
    const Matrix3 C_sensor_to_b = Vector3(1.0, -1.0, -1.0).asDiagonal() * C_sensor_to_flu;
    InputCheck check(result_.rest.force.norm(), kRestSpeed_mps);
    std::string said;
    std::size_t next = 0;
    for (const WheelRow& row : result_.track.rows) {
      const double stamp_s = row.time_s + 0.5 * row.interval_s - ahead_s;
      for (; next < imu.size() && imu.times()[next] <= stamp_s; ++next) {
        check.push(
            ImuSample{fromSeconds(imu.times()[next]), C_sensor_to_b * imu.force(next), C_sensor_to_b * imu.rate(next)});
        said = said.empty() ? check.complaint() : said;
      }
      WheelMotion motion = toWheelMotion(SpeedSample{fromSeconds(stamp_s), row.speed});
      motion.largest_speed_mps = row.largest;
      check.push(motion);
    }
    if (!said.empty()) {
      say(Severity::kUnusable, result_.roles.imu->topic, said, "the estimator rejects such data");
    }
  }

  /// As configured.
  Nanoseconds fixOffset() const {
    return options_.config ? fromSeconds(options_.config->initialization.fix_stamp_offset_s) : 0;
  }
  Nanoseconds truthOffset() const { return options_.config ? fromSeconds(options_.config->truth.stamp_offset_s) : 0; }

  void checkPositions() {
    const Roles& roles = result_.roles;
    if (roles.fix != nullptr) {
      result_.fixes = positionsOf(*roles.fix, recording_.begin - fixOffset());
      checkPositionStream(roles.fix->topic, timesOf(*roles.fix));
      checkFixes(*roles.fix, result_.fixes, result_.findings);
      checkClockByTrack(roles.fix->topic, withoutJumps(result_.fixes), drive_, result_.findings);
      checkJumps(roles.fix->topic, result_.fixes, result_.findings);
    }
    if (roles.truth_fix != nullptr && roles.truth_fix != roles.fix) {
      result_.truth = positionsOf(*roles.truth_fix, recording_.begin - truthOffset());
      checkFixes(*roles.truth_fix, result_.truth, result_.findings);
      checkTruth(roles.truth_fix->topic, timesOf(*roles.truth_fix));
    } else if (roles.truth_pose != nullptr) {
      result_.truth = positionsOf(*roles.truth_pose, recording_.begin - truthOffset());
      result_.truth_in_start_frame = isInStartFrame(*roles.truth_pose);
      checkTruth(roles.truth_pose->topic, timesOf(*roles.truth_pose));
    }
    const bool has_truth = !result_.truth.empty();
    const std::string& topic = has_truth && roles.truth_fix != nullptr    ? roles.truth_fix->topic
                               : has_truth && roles.truth_pose != nullptr ? roles.truth_pose->topic
                               : roles.fix != nullptr                     ? roles.fix->topic
                                                                          : recording_name_;
    result_.scale = wheelScale(has_truth ? result_.truth : result_.fixes, result_.track);
    checkWheelScale(topic, result_.scale, result_.track, result_.findings);
  }

  void checkPositionStream(const std::string& topic, const std::vector<MessageTime>& times) {
    const StreamStatistics statistics = statisticsOf(times);
    checkStream(topic, statistics, kPositionNeeds, result_.findings);
    if (result_.roles.imu != nullptr) {
      compareReceipt(topic, statistics);
    }
  }

  void checkTruth(const std::string& topic, const std::vector<MessageTime>& times) {
    checkPositionStream(topic, times);
    checkJumps(topic, result_.truth, result_.findings);
    checkClockByTrack(topic, withoutJumps(result_.truth), drive_, result_.findings);
    checkTimeInCommon(topic, result_.truth, imu_begin_s_, imu_end_s_, result_.findings);
  }

  const Recording& recording_;
  const InspectionOptions& options_;
  TopicNames names_;
  Inspection result_;
  StreamStatistics imu_statistics_;
  StreamStatistics wheel_statistics_;
  PlanarTrack drive_;  ///< by wheels and gyros
  double imu_begin_s_ = 0.0;
  double imu_end_s_ = 0.0;
  std::string recording_name_ = "recording";
};

}  // namespace

Inspection inspect(const Recording& recording, const InspectionOptions& options) {
  return Inspector(recording, options).run();
}

}  // namespace slipnav
