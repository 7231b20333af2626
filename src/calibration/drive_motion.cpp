#include "calibration/drive_motion.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/ekf/models/motion_average.h"

namespace slipnav {
namespace {

/// Slower than this, slip as a ratio is meaningless.
constexpr double kSlowest_mps = 0.05;

/// One IMU interval of the smoothed drive.
struct SmoothStep {
  InsStep step;
  Vector3 v_eb_b = Vector3::Zero();  ///< mean at base_link
  std::size_t epoch = 0;             ///< the smoothed epoch it was mechanized from
};

/// Mechanizes from every smoothed epoch to the next.
std::vector<SmoothStep> mechanize(const Planet& planet, const Vector3& lever_b,
                                  const std::vector<TimedInterval>& intervals, const SmoothedDrive& smoothed) {
  const Strapdown strapdown(planet);
  std::vector<SmoothStep> steps;
  for (std::size_t k = 0; k + 1 < smoothed.epochs.size(); ++k) {
    NavigationState state = smoothed.epochs[k].state.nav;
    const double yaw_scale = smoothed.epochs[k].state.yaw_scale;
    for (std::size_t i = smoothed.epochs[k].next_interval; i < smoothed.epochs[k + 1].next_interval; ++i) {
      const ImuInterval mean = withoutYawScale(intervals[i].mean, yaw_scale);
      const ImuInterval previous = i == 0 ? ImuInterval{} : withoutYawScale(intervals[i - 1].mean, yaw_scale);
      const NavigationState next = strapdown.propagate(state, previous, mean, intervals[i].end);
      const Vector3 omega_ie_b = next.q_b_to_n.conjugate() * planet.omega_ie_n(next.position.latitude_rad);
      SmoothStep step;
      step.step.start = intervals[i].start;
      step.step.state = next;
      step.step.omega_ib_b = mean.omega_ib_b - state.gyro_bias_b - omega_ie_b;  // over the planet, not inertial
      step.v_eb_b = 0.5 * (bodyVelocity(state, step.step.omega_ib_b, lever_b) +
                           bodyVelocity(next, step.step.omega_ib_b, lever_b));
      step.epoch = k;
      steps.push_back(step);
      state = next;
    }
  }
  return steps;
}

void describeAccuracy(const SmoothedEpoch& epoch, MotionSample& sample) {
  const Matrix3 C_b_to_n = epoch.state.nav.q_b_to_n.toRotationMatrix();
  sample.tilt_variance_b = (C_b_to_n.transpose() * epoch.P.block<3, 3>(kAttitude, kAttitude) * C_b_to_n).diagonal();
  sample.position_covariance_n = epoch.P.block<3, 3>(kPosition, kPosition);
  sample.forward_n = C_b_to_n.col(0);
  sample.cross_slope = C_b_to_n(2, 1);
}

}  // namespace

std::vector<MotionSample> driveMotion(const Planet& planet, const Config& config, const CalibrationDrive& drive,
                                      const std::vector<TimedInterval>& intervals, const SmoothedDrive& smoothed) {
  const std::vector<SmoothStep> steps = mechanize(planet, -config.imu.mount.position_b(), intervals, smoothed);
  std::vector<MotionSample> samples;
  double travel_m = 0.0;
  auto first = steps.begin();
  for (std::size_t k = 1; k < drive.wheels.size(); ++k) {
    const Nanoseconds start = drive.wheels[k - 1].stamp;
    const WheelMotion& wheels = drive.wheels[k];
    const double interval_s = toSeconds(wheels.stamp - start);
    MotionAverage average;
    average.restart(start);
    first = std::find_if(first, steps.end(), [start](const SmoothStep& s) { return s.step.state.stamp > start; });
    auto step = first;
    for (; step != steps.end() && step->step.start < wheels.stamp; ++step) {
      average.add(step->step, step->v_eb_b, start, wheels.stamp);
    }
    travel_m += wheels.largest_speed_mps * interval_s;
    const std::optional<BodyMotion> motion = average.mean();
    const bool covered = motion && motion->duration_s > 0.99 * interval_s;
    if (covered && wheels.largest_speed_mps > kSlowest_mps && interval_s <= config.filter.max_wheel_interval_s) {
      MotionSample sample;
      sample.end = wheels.stamp;
      sample.duration_s = interval_s;
      sample.travel_m = travel_m;
      sample.v_eb_b = motion->v_eb_b;
      sample.omega_eb_b = motion->omega_ib_b;
      sample.wheels = wheels;
      describeAccuracy(smoothed.epochs[std::prev(step)->epoch], sample);
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace slipnav
