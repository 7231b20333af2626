#include "calibration/calibration.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "calibration/mount_calibration.h"
#include "calibration/start_guess.h"
#include "calibration/wheel_calibration.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// The second pass is linearized about the result of the first, and knows the actual noise of the truth.
constexpr int kPasses = 2;
constexpr double kLeastDistance_m = 3.0;
/// Truth that contradicts the IMU more often than this is worse than it claims.
constexpr double kRefusedShare = 0.02;
/// Beyond this it is another drive, another clock or another robot.
constexpr double kMostRefusedShare = 0.5;
/// Nobody measures a wheel worse than this; beyond, a unit or an assignment is wrong.
constexpr double kLargestRadiusRatio = 1.25;

std::string withUnit(double value, const char* unit) {
  std::ostringstream text;
  text.precision(3);
  text << value << ' ' << unit;
  return text.str();
}

/// Mechanization starts where truth does.
void dropBefore(Nanoseconds start, std::vector<TimedInterval>& intervals) {
  intervals.erase(intervals.begin(), std::find_if(intervals.begin(), intervals.end(),
                                                  [start](const TimedInterval& i) { return i.start >= start; }));
}

/// The smoothed state at the start, with the assumed biases: these are known equally well before every
/// pass.
AidedState startOfNextPass(const Planet& planet, const SmoothedDrive& smoothed, const AidedState& before) {
  AidedState start = before;
  const NavigationState& first = smoothed.epochs.front().state.nav;
  start.nav.q_b_to_n = first.q_b_to_n;
  start.nav.v_eb_n = first.v_eb_n;
  start.nav.position = first.position;
  ErrorVector moved = ErrorVector::Zero();
  moved.segment<3>(kPosition) = first.v_eb_n * toSeconds(first.stamp - start.nav.stamp);
  subtractError(planet, moved, start.nav);
  return start;
}

SmoothedDrive smooth(const Planet& planet, const Config& config, const CalibrationDrive& drive,
                     const std::vector<TimedInterval>& intervals, AidedState start, CalibrationResult& result) {
  const AidedSmoother smoother(planet, config);
  double variance_factor = 1.0;
  SmoothedDrive smoothed;
  for (int pass = 0; pass < kPasses; ++pass) {
    smoothed = smoother.smooth(drive, intervals, start, variance_factor);
    if (smoothed.epochs.size() < 2 || smoothed.fixes == 0) {
      throw std::invalid_argument("truth positions do not fit the IMU");
    }
    start = startOfNextPass(planet, smoothed, start);
    variance_factor *= std::max(1.0, smoothed.fix_nis);
  }
  const std::size_t all_fixes = smoothed.fixes + smoothed.refused_fixes;
  if (static_cast<double>(smoothed.refused_fixes) > kMostRefusedShare * static_cast<double>(all_fixes)) {
    throw std::invalid_argument(std::to_string(smoothed.refused_fixes) + " of " + std::to_string(all_fixes) +
                                " truth positions contradict IMU and wheels: is it the truth of this drive, in its own "
                                "clock, and imu.mount right? See what ./run check says");
  }
  result.fixes = smoothed.fixes;
  result.fix_noise_factor = std::sqrt(variance_factor);
  if (static_cast<double>(smoothed.refused_fixes) > kRefusedShare * static_cast<double>(smoothed.fixes)) {
    result.warnings.push_back(std::to_string(smoothed.refused_fixes) +
                              " truth positions contradict the IMU and were rejected");
  }
  return smoothed;
}

void describeDrive(const std::vector<MotionSample>& samples, CalibrationResult& result) {
  double moving_s = 0.0;
  double heading_variance_s = 0.0;
  for (const MotionSample& sample : samples) {
    moving_s += sample.duration_s;
    result.distance_m += std::abs(sample.v_eb_b.x()) * sample.duration_s;
    result.turned_rad += std::abs(sample.omega_eb_b.z()) * sample.duration_s;
    heading_variance_s += sample.tilt_variance_b.z() * sample.duration_s;
  }
  if (result.distance_m < kLeastDistance_m) {
    throw std::invalid_argument("the rover drives " + withUnit(result.distance_m, "m") +
                                " while truth, IMU and wheels are all available; calibration needs " +
                                withUnit(kLeastDistance_m, "m") + " at least");
  }
  result.heading_std_rad = std::sqrt(heading_variance_s / moving_s);
}

/// A result that no robot has is not one.
void requireSense(const std::optional<Calibrated>& ratio, bool of_wheels) {
  if (!ratio) {
    return;
  }
  const bool possible = std::isfinite(ratio->value) && std::isfinite(ratio->std) && ratio->std >= 0.0 &&
                        ratio->value < kLargestRadiusRatio && ratio->value > 1.0 / kLargestRadiusRatio;
  if (!possible) {
    throw std::invalid_argument("the ground is " + withUnit(ratio->value, "times as far as the ") +
                                (of_wheels ? "wheels say: check the unit of joint_states (rad/s), the gear, "
                                             "wheels[].radius_m, sign and names"
                                           : "odometry says: check its unit (m/s)"));
  }
}

}  // namespace

CalibrationResult calibrate(const Config& config, CalibrationDrive drive) {
  const Planet planet = Planet::byName(config.planet);
  sortByStamp(drive);
  std::vector<TimedInterval> intervals = imuIntervals(drive.imu, config.imu.input);
  AidedState start;
  start.nav = guessStart(planet, config, drive, intervals);
  dropBefore(start.nav.stamp, intervals);

  CalibrationResult result;
  const SmoothedDrive smoothed = smooth(planet, config, drive, intervals, start, result);
  const std::vector<MotionSample> samples = driveMotion(planet, config, drive, intervals, smoothed);
  describeDrive(samples, result);
  calibrateWheels(config, samples, result);
  requireSense(result.left_radius_ratio, result.has_wheel_rates);
  requireSense(result.right_radius_ratio, result.has_wheel_rates);
  calibrateMount(config, samples, result);
  return result;
}

std::vector<WheelParams> calibratedWheels(const Config& config, const CalibrationResult& result) {
  std::vector<WheelParams> wheels = config.wheels;
  for (WheelParams& wheel : wheels) {
    const std::optional<Calibrated>& ratio = wheel.y_m < 0.0 ? result.right_radius_ratio : result.left_radius_ratio;
    wheel.radius_m *= ratio ? ratio->value : 1.0;
  }
  return wheels;
}

MountParams calibratedMount(const Config& config, const CalibrationResult& result) {
  const MountParams& old = config.imu.mount;
  const Quaternion q_sensor_to_flu =
      q_b_to_n_fromEuler(degToRad(old.roll_deg), degToRad(old.pitch_deg), degToRad(old.yaw_deg));
  // the same rotation seen in forward-left-up: y and z point the other way, and so do rotations about them
  const Quaternion q_turn = q_b_to_n_fromEuler(0.0, result.mount_pitch_rad ? -result.mount_pitch_rad->value : 0.0,
                                               result.mount_yaw_rad ? -result.mount_yaw_rad->value : 0.0);
  const Vector3 angles_rad = eulerFrom_q_b_to_n(q_turn * q_sensor_to_flu);
  MountParams mount = old;
  mount.roll_deg = radToDeg(angles_rad.x());
  mount.pitch_deg = radToDeg(angles_rad.y());
  mount.yaw_deg = radToDeg(angles_rad.z());
  return mount;
}

}  // namespace slipnav
