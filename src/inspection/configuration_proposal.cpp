#include "inspection/configuration_proposal.h"

#include <algorithm>
#include <cmath>

#include "config/yaml_writer.h"
#include "core/base/text.h"

namespace slipnav {
namespace {

/// A radius from positions is used if it is known to this share.
constexpr double kSureRadius = 0.02;
/// A track from the gyros likewise.
constexpr double kSureTrack = 0.05;
/// Fixes better than this determine a heading after the usual starting drive of 10 m.
constexpr double kGoodFix_m = 0.5;
/// initialization.min_rest_s and some reserve.
constexpr double kLongStart_s = 6.0;
constexpr double kLeastFixes = 20.0;
constexpr double kLargestDelay_s = 1.0;

std::string bare(const std::string& topic) {
  return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
}

class Proposal {
 public:
  Proposal(const Inspection& inspection, const InspectionOptions& options) : found_(inspection), options_(options) {}

  std::string text(const std::string& source) {
    yaml_ = "# From " + source +
            ", by check. Anything not listed keeps its default: add what a data sheet and a ruler\n" +
            "# give (imu.noise, imu.input.sampling, imu.mount.x_m to z_m).\n";
    writeTopics();
    writeFrames();
    writeImu();
    writeWheels();
    writeWheelSource();
    writeStart();
    writeTruth();
    return yaml_;
  }

 private:
  void comment(const std::string& text) { yaml_ += "# " + text + "\n"; }

  template <class Record>
  void topic(const std::string& key, const Record* record, std::string& block) const {
    if (record != nullptr && bare(record->topic) != key) {
      block += "  " + key + ": " + yamlScalar(bare(record->topic)) + "  # by type and name\n";
    }
  }

  void writeTopics() {
    const Roles& roles = found_.roles;
    std::string block;
    topic("imu/data", roles.imu, block);
    topic("joint_states", roles.joints, block);
    topic("wheel_odometry", usesOdometry() ? roles.wheel_odometry : nullptr, block);
    topic("gps/fix", roles.fix, block);
    topic("truth/fix", roles.truth_fix, block);
    const bool has_pose = roles.truth_pose != nullptr && roles.truth_fix == nullptr;
    topic(has_pose && !roles.truth_pose->has_motion ? "truth/pose" : "truth/odometry",
          has_pose ? roles.truth_pose : nullptr, block);
    if (roles.truth_fix == nullptr && roles.truth_pose == nullptr && roles.fix != nullptr) {
      block += "  truth/fix: " + yamlScalar(bare(roles.fix->topic)) + "  # no better truth in the recording\n";
    }
    yaml_ += block.empty() ? "" : "\ntopics:\n" + block;
  }

  bool usesOdometry() const { return found_.roles.joints == nullptr; }

  void writeFrames() {
    const ImuRecord* imu = found_.roles.imu;
    if (imu != nullptr && !imu->frame.empty() && bare(imu->frame) != FrameNames{}.imu) {
      yaml_ += "\nframes:\n  imu: " + yamlScalar(bare(imu->frame)) + "  # header.frame_id of " + imu->topic + "\n";
    }
  }

  /// Both under one key.
  void writeImu() {
    const std::string mount = mountLine();
    const std::string noise = noiseLines();
    yaml_ += mount.empty() && noise.empty() ? "" : "imu:\n" + mount + noise;
  }

  /// What a data sheet may understate.
  std::string noiseLines() const {
    const LeastBias bias = leastBias(found_.rest);
    const ImuNoiseParams sheet = options_.noise();
    const LeastNoise noise = leastNoise(found_.rest, sheet);
    std::string lines;
    if (noise.accel_noise_mps_per_sqrt_h > 0.0) {
      lines += "    accel_noise_mps_per_sqrt_h: " + decimal(noise.accel_noise_mps_per_sqrt_h, 3) +
               "  # at rest, means over 0.1 to 0.4 s\n";
    }
    if (noise.gyro_noise_deg_per_sqrt_h > 0.0) {
      lines += "    gyro_noise_deg_per_sqrt_h: " + decimal(noise.gyro_noise_deg_per_sqrt_h, 2) + "  # likewise\n";
    }
    if (bias.force_mps2 / kMicroG > sheet.accel_bias_std_ug) {
      lines += "    accel_bias_std_ug: " + decimal(bias.force_mps2 / kMicroG, 0) +
               "  # at rest: " + decimal(found_.rest.force.norm(), 2) + " m/s²\n";
    }
    const double rate_deg_per_h = 3600.0 * radToDeg(bias.rate_radps);
    if (rate_deg_per_h > sheet.gyro_bias_std_deg_per_h) {
      lines += "    gyro_bias_std_deg_per_h: " + decimal(rate_deg_per_h, 0) + "  # at rest\n";
    }
    return lines.empty() ? "" : "  noise:\n" + lines;
  }

  std::string mountLine() {
    const Mounting& mounting = found_.mounting;
    yaml_ += "\n";
    if (!mounting.is_sure) {
      comment("imu.mount: not determined by this drive");
      return "";
    }
    if (mounting.has_turn && mounting.turn_per_rate < 0.0) {
      comment("imu.mount: gyros and wheels contradict each other");
      return "";
    }
    const std::string measured = decimal(radToDeg(mounting.left_over_rad), 1) + " deg remaining, heading ± " +
                                 decimal(radToDeg(mounting.forward_std_rad), 1) + " deg (1 sigma)";
    const bool by_tf = options_.tf && isNear(toRotation(*options_.tf));
    comment(by_tf
                ? "pose by /tf_static or /tf; the drive agrees: " + axesText(mounting.nearest) + ", " + measured
                : "quarter turn by gravity, turns and accelerations: " + axesText(mounting.nearest) + ", " + measured);
    const MountParams mount = by_tf ? *options_.tf : toMountParams(mounting.nearest);
    std::string line = "  mount: {";
    if (by_tf) {
      line += "x_m: " + decimal(mount.x_m, 4) + ", y_m: " + decimal(mount.y_m, 4) + ", z_m: " + decimal(mount.z_m, 4) +
              ", ";
    }
    return line + "roll_deg: " + decimal(mount.roll_deg, by_tf ? 3 : 0) +
           ", pitch_deg: " + decimal(mount.pitch_deg, by_tf ? 3 : 0) +
           ", yaw_deg: " + decimal(mount.yaw_deg, by_tf ? 3 : 0) + "}\n";
  }

  bool isNear(const Matrix3& other) const {
    return (other * found_.mounting.nearest.transpose()).trace() > 1.0 + 2.0 * std::cos(0.25 * kPi);
  }

  /// Radius in m and its source; 0 if it is not known.
  double radius(std::string& reason) const {
    if (options_.wheel_radius_m > 0.0) {
      reason = "radius as given";
      return options_.wheel_radius_m;
    }
    if (found_.track.in_meters) {
      reason = "radii as configured";
      return found_.wheels.front().radius_m;
    }
    if (found_.scale.known && found_.scale.std < kSureRadius * found_.scale.value) {
      reason = "radius by positions over " + decimal(found_.scale.distance_m, 0) + " m, ± " +
               decimal(1e3 * found_.scale.std, 2) + " mm (1 sigma), slip of this drive included";
      return found_.scale.value;
    }
    return 0.0;
  }

  /// Between left and right wheels [m]; 0 if it is not known, and the heading rate of the wheels is not used then.
  double track(double radius_m) {
    const Mounting& mounting = found_.mounting;
    if (!mounting.has_turn || mounting.turn_per_rate <= 0.0) {
      comment("the drive does not determine the track: with y_m 0 wheel turns are not used; measure it");
      return 0.0;
    }
    const double track_m = (found_.track.in_meters ? 1.0 : radius_m) * mounting.turn_per_rate;
    const double share = mounting.turn_per_rate_std / mounting.turn_per_rate;
    comment("track of " + decimal(track_m, 3) + " m by the gyros, ± " + decimal(100.0 * share, 1) +
            " % (1 sigma), scrub included" + (share > kSureTrack ? ": measure it" : ""));
    return track_m;
  }

  void writeWheels() {
    if (usesOdometry() || found_.wheels.empty()) {
      return;
    }
    std::string radius_reason;
    const double radius_m = radius(radius_reason);
    const bool sides = std::all_of(found_.wheels.begin(), found_.wheels.end(),
                                   [](const WheelJoint& wheel) { return wheel.side != Side::kUnknown; });
    yaml_ += "\n";
    if (radius_m <= 0.0) {
      comment("wheels: their names and signs are known, but not their radius: check --wheel-radius M");
      return;
    }
    comment(radius_reason + "; names and sides by their names, signs by how they turn");
    const double track_m = sides ? track(radius_m) : 0.0;
    yaml_ += "wheels:\n";
    for (const WheelJoint& wheel : found_.wheels) {
      const double y_m = (wheel.side == Side::kLeft ? 0.5 : -0.5) * track_m;
      yaml_ += "  - {name: " + yamlScalar(wheel.name) + ", radius_m: " + decimal(radius_m, 4) +
               ", x_m: 0.0, y_m: " + decimal(y_m, 3) + ", sign: " + decimal(wheel.sign, 1) + "}\n";
    }
  }

  void writeWheelSource() {
    const ClockOffset& clock = found_.clock;
    const bool delayed =
        found_.stamps_are_set && clock.isBeyond(0.0) && std::abs(clock.wheels_ahead_s) <= kLargestDelay_s;
    if (!usesOdometry() && !delayed) {
      return;
    }
    yaml_ += "\nwheel:\n";
    if (usesOdometry()) {
      yaml_ += "  source: wheel_odometry  # no joints that turn\n";
    }
    if (delayed) {
      yaml_ += "  stamp_delay_s: " + decimal(clock.wheels_ahead_s, 3) + "  # ± " + decimal(clock.std_s, 3) +
               " (1 sigma), by correlation with the IMU, " + decimal(clock.correlation, 2) + "\n";
    }
  }

  /// Stands at first, with fixes good enough to find a heading.
  bool startsUnderSatellites() const {
    std::size_t good = 0;
    const double start_end_s = found_.rest.rests.empty() ? 0.0 : found_.rest.rests.front().end_s;
    for (const TruthSample& fix : found_.fixes.samples()) {
      const bool precise = std::sqrt(std::max(fix.covariance_enu_m2(0, 0), 0.0)) < kGoodFix_m;
      good += precise && toSeconds(fix.stamp) < start_end_s ? 1 : 0;
    }
    const bool rests = !found_.rest.rests.empty() &&
                       found_.rest.rests.front().end_s - found_.rest.rests.front().begin_s > kLongStart_s;
    return rests && static_cast<double>(good) > kLeastFixes;
  }

  void writeStart() {
    yaml_ += "\ninitialization:\n";
    if (startsUnderSatellites()) {
      yaml_ += "  source: gnss  # stands first, with fixes better than 0.5 m\n";
      return;
    }
    yaml_ += "  source: motion  # no rest under good fixes; heading_deg is clockwise from north, 90 is east\n";
    yaml_ += "  heading_deg: 90\n";
    if (found_.roles.fix != nullptr) {
      const auto& samples = found_.roles.fix->samples;
      const auto first =
          std::find_if(samples.begin(), samples.end(), [](const RawFixSample& s) { return s.is_usable; });
      if (first != samples.end()) {
        yaml_ += "  latitude_deg: " + formatNumber(first->fix.latitude_deg) + "  # first fix\n";
        yaml_ += "  longitude_deg: " + formatNumber(first->fix.longitude_deg) + "\n";
        yaml_ += "  height_m: " + decimal(first->fix.height_m, 1) + "\n";
      }
    }
  }

  void writeTruth() {
    const bool pose = found_.roles.truth_pose != nullptr && found_.roles.truth_fix == nullptr;
    if (pose && found_.truth_in_start_frame) {
      yaml_ += "\ntruth:\n  align: start_pose  # begins at zero, in the robot's own frame\n";
    } else if (!pose && !startsUnderSatellites()) {
      yaml_ += "\ntruth:\n  align: heading  # the start does not know the heading\n";
    }
  }

  const Inspection& found_;
  const InspectionOptions& options_;
  std::string yaml_;
};

}  // namespace

std::string proposedYaml(const Inspection& inspection, const InspectionOptions& options, const std::string& source) {
  return Proposal(inspection, options).text(source);
}

}  // namespace slipnav
