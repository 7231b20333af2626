/// The part of FilterEngine triggered by a wheel sample: standstill, forward speed, heading rate, constraints.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {
namespace {

/// Beyond this it is not slip: the wheels stand, or the state is wrong.
constexpr double kLargestSlipJump = 2.0;
constexpr double kIntervalTolerance_s = 1e-3;
constexpr double kLongestSlip_m = 3.0;
/// A rover that digs itself in moves a little, and not at random from one sample to the next.
constexpr double kDiggingStd_mps = 0.05;
constexpr double kDiggingTime_s = 1.0;
/// Of the fastest wheel: a vehicle whose middle is slower turns on the spot.
constexpr double kOnTheSpot = 0.5;

Innovation1 innovationOf(const Measurement& m, int persistent_slip, const ErrorCovariance& P) {
  return {m.residual(0), (m.H * covarianceWithPrediction(m.H, P))(0, 0) + m.variance(0),
          explainedBy(persistent_slip, m.H, P)};
}

}  // namespace

bool FilterEngine::applyWheels(const InsStep& step, const Vector3& v_mean_b) {
  estimate_.has_wheels = false;
  if (toSeconds(step.state.stamp - estimate_.wheels.stamp) > setup_.filter.max_wheel_interval_s) {
    estimate_.stationary = false;
    estimate_.stuck = false;
    stuck_.reset();  // wheels that no longer turn do not spin
  }
  bool corrected = false;
  while (wheels_.hasUpTo(step.state.stamp)) {
    const WheelMotion wheels = wheels_.take();
    const double interval_s = toSeconds(wheels.stamp - average_.start());
    addMotion(step, v_mean_b, wheels.stamp);
    const std::optional<BodyMotion> motion = average_.mean();
    detector_.addWheels(wheels.stamp, wheels.largest_speed_mps,
                        std::sqrt(adaptation_.factors().wheel) * setup_.wheel.speed_std_mps);
    const bool whole = average_.start() != 0 && interval_s <= setup_.filter.max_wheel_interval_s && motion;
    if (!whole) {
      constraint_average_.restart(wheels.stamp);
    } else if (!wheels_.hasUpTo(step.state.stamp)) {
      // Of several in one step, as in an IMU gap, the last one counts: the reference of the others would not
      // follow from one correction to the next.
      corrected = applyWheelSample(wheels, *motion) || corrected;
    }
    average_.restart(wheels.stamp);
    noteWheels(wheels, interval_s);
  }
  addMotion(step, corrected ? referenceVelocity(step) : v_mean_b, step.state.stamp);
  return corrected;
}

void FilterEngine::noteWheels(const WheelMotion& wheels, double interval_s) {
  way_since_wheels_m_ = surface_speed_mps_ * std::clamp(interval_s, 0.0, 1.0);
  surface_speed_mps_ = std::min(wheels.largest_speed_mps, setup_.wheel_monitor.max_speed_mps);
}

void FilterEngine::addMotion(const InsStep& step, const Vector3& v_mean_b, Nanoseconds until) {
  if (average_.start() != 0) {
    const VelocityJacobian H_v = bodyVelocityJacobian(state_, setup_.lever_imu_to_reference_b);
    constraint_average_.add(step, v_mean_b, H_v, average_.start(), until);
    average_.add(step, v_mean_b, H_v, average_.start(), until);
  }
}

bool FilterEngine::constraintsAreDue() const {
  const std::optional<BodyMotion> mean = constraint_average_.mean();
  return mean && (std::abs(mean->v_eb_b.x()) * mean->duration_s >= setup_.nonholonomic.length_m ||
                  mean->duration_s >= setup_.nonholonomic.max_interval_s - kIntervalTolerance_s);
}

bool FilterEngine::applyWheelSample(const WheelMotion& wheels, const BodyMotion& motion) {
  estimate_.has_wheels = true;
  estimate_.wheels = wheels;
  estimate_.motion = motion;
  if (wheels.count > 1 && wheels.count == wheel_monitor_.count()) {
    wheel_monitor_.add(wheels.stamp, wheels.circumferential_mps, motion.omega_ib_b.z());
  }
  if (hasRunAway(wheels, motion)) {
    recover(wheels);
    return true;
  }
  const bool at_rest = detector_.judge(planet_.gravity_n(state_.position).norm(), !stuck_.isSuspected());
  const bool stuck = !at_rest && use_zupt_ && spinsOnTheSpot(wheels, motion);
  if (at_rest) {
    stuck_.reset();
  }
  const bool corrected = at_rest ? stand(wheels, motion)
                         : stuck ? standOnSpinningWheels(wheels, motion)
                                 : drive(wheels, motion);
  estimate_.stuck = stuck;
  estimate_.noise_factors = adaptation_.factors();
  const double slow_slip_variance = dynamics_.ground().slow_slip_variance;
  if (slow_slip_variance > 0.0) {  // including the slope and the slip seen on this ground
    estimate_.noise_factors.slow_slip = adaptation_.ground().slow_slip_variance / slow_slip_variance;
  }
  return corrected;
}

/// On the spot, where left and right wheels turn opposite ways, there is no direction to move against.
bool FilterEngine::hasRunAway(const WheelMotion& wheels, const BodyMotion& motion) {
  if (!use_wheel_ || !wheel_monitor_.isUsable()) {
    return false;
  }
  const double wheels_mps = std::min(wheels.largest_speed_mps, setup_.wheel_monitor.max_speed_mps);
  const double ahead_mps = std::copysign(motion.v_eb_b.x(), motion.v_eb_b.x() * wheels.motion.forward_mps);
  const bool turns_on_the_spot = std::abs(wheels.motion.forward_mps) < kOnTheSpot * wheels_mps;
  return runaway_.addWheels(wheels.stamp, wheels_mps, state_.v_eb_n.norm(),
                            turns_on_the_spot ? -std::abs(ahead_mps) : -ahead_mps, motion.duration_s);
}

/// Whether it stands while its wheels turn. Needs an earlier drive for comparison.
bool FilterEngine::spinsOnTheSpot(const WheelMotion& wheels, const BodyMotion& motion) {
  SpinEvidence evidence;
  evidence.stamp = wheels.stamp;
  evidence.level_of_rest = detector_.hasLevelOfRest(planet_.gravity_n(state_.position).norm());
  evidence.calmer_than_driving = detector_.isCalmerThanDriving(stuck_.isSuspected());
  evidence.forward_mps = motion.v_eb_b.x();
  const VelocityJacobian H_v = average_.jacobian();
  evidence.forward_std_mps = std::sqrt(std::max(0.0, (H_v.row(0) * P_ * H_v.row(0).transpose())(0, 0)));
  evidence.wheels_mps = wheels.largest_speed_mps;
  return stuck_.judge(evidence);
}

/// Spinning wheels say nothing about speed, heading or ground.
bool FilterEngine::standOnSpinningWheels(const WheelMotion& wheels, const BodyMotion& motion) {
  estimate_.stationary = false;
  estimate_.wheel_speed_used = false;
  MeasurementSet set;
  set.add(kZeroVelocity, zeroVelocityMeasurement(square(kDiggingStd_mps) * kDiggingTime_s / motion.duration_s, state_));
  const bool corrected = update(set);
  constraint_average_.restart(wheels.stamp);
  adaptation_.constraintsUsed();
  return corrected;
}

bool FilterEngine::stand(const WheelMotion& wheels, const BodyMotion& motion) {
  MeasurementSet set;
  const ComponentStatus before = update_.status(kZeroVelocity);
  if (use_zupt_) {
    tell(kZeroVelocity, wheels.stamp, zeroVelocityMeasurement(standstill_noise_.variance(), state_));
    standstill_noise_.learn(state_.v_eb_n, P_.diagonal().segment<3>(kVelocity).mean());
    const Measurement zero = zeroVelocityMeasurement(standstill_noise_.variance(), state_);
    set.add(kZeroVelocity, zero);
  }
  if (use_zaru_) {
    const Measurement rate = zeroAngularRateMeasurement(setup_.zero, adaptation_.gyroDensity(), motion, state_,
                                                        planet_.omega_ie_n(state_.position.latitude_rad));
    tell(kZeroRate, wheels.stamp, rate);
    set.add(kZeroRate, rate);
  }
  const bool corrected = update(set);
  const bool stands = update_.status(kZeroVelocity).accepted > before.accepted;
  if (update_.status(kZeroVelocity).measured() > before.measured()) {
    imu_gap_uncertainty_.standstill(stands, P_);
  }
  constraint_average_.restart(wheels.stamp);
  adaptation_.constraintsUsed();
  estimate_.wheel_speed_used = false;
  estimate_.stationary = !use_zupt_ || stands;
  has_rested_ = has_rested_ || stands;
  if (stands) {
    allowForUnexpectedSlip();
  }
  return corrected;
}

bool FilterEngine::drive(const WheelMotion& wheels, const BodyMotion& motion) {
  MeasurementSet set;
  conditionOnGround();
  if (std::exchange(has_rested_, false)) {
    unexpected_slip_.begin();
    allowForBiasShift();
  }
  allowForUnexpectedSlip();
  estimate_.stationary = false;
  estimate_.wheel_speed_used = false;
  if (use_wheel_) {
    addForwardSpeed(wheels, motion, set);
    const PlanarMotion wheel_motion = soundMotion(wheels);
    if (wheel_motion.has_yaw_rate) {
      const Measurement rate = yawRateMeasurement(setup_.wheel, wheel_motion.yaw_rate_radps,
                                                  wheels.largest_speed_mps * motion.duration_s, motion);
      tell(kYawRate, wheels.stamp, rate);
      set.add(kYawRate, rate);
    }
  }
  const bool constrained = use_nonholonomic_ && constraintsAreDue();
  if (constrained) {
    addConstraints(wheels.stamp, set);
  }
  const ComponentStatus before = update_.status(kForwardSpeed);
  const bool corrected = update(set);
  if (update_.status(kForwardSpeed).rejected > before.rejected) {
    estimate_.wheel_speed_used = false;
    imu_gap_uncertainty_.doubt(wheels.stamp, P_);
  }
  if (constrained) {
    constraint_average_.restart(wheels.stamp);
    adaptation_.constraintsUsed();
  }
  return corrected;
}

/// A wheel that loses grip slips by whatever the innovation says: the variance of the fast slip grows by just that (the
/// scale mixture whose most probable variance is the square of the innovation), which keeps it out of the other states.
void FilterEngine::addForwardSpeed(const WheelMotion& wheels, const BodyMotion& motion, MeasurementSet& set) {
  if (!wheel_monitor_.isUsable()) {
    return;
  }
  const double speed_mps = soundMotion(wheels).forward_mps;
  slipping_speed_.add(wheels.stamp, speed_mps);
  const WheelInterval interval{speed_mps, slipping_speed_.value(), motion.duration_s,
                               (motion.v_eb_b.x() - last_forward_mps_) / motion.duration_s};
  last_forward_mps_ = motion.v_eb_b.x();
  const double slip_variance = P_.block<3, 3>(kWheelScale, kWheelScale).sum();
  const Measurement m = forwardSpeedMeasurement(setup_.wheel, interval, motion, average_.jacobian(), vehicle_,
                                                slip_variance, adaptation_.factors());
  tell(kForwardSpeed, wheels.stamp, m);
  const Innovation1 innovation = innovationOf(m, kSlowSlip, P_);
  if (wheels.largest_speed_mps > 0.0) {  // wheels at rest are exact, and say nothing about turning ones
    adaptation_.learnForward(setup_.wheel, interval, innovation);
  }
  const double squared = square(innovation.residual);
  estimate_.wheel_speed_used = squared <= update_.gate(1) * innovation.variance;
  if (estimate_.wheel_speed_used) {
    slipping_way_m_ = 0.0;
  } else if (isSlip(m.residual(0))) {
    loosen(m, wheels.stamp, squared / std::max(square(interval.slipping_speed_mps), 1e-12));
  }
  contradiction_mps_ = estimate_.wheel_speed_used ? 0.0 : m.residual(0);
  openSlowSlip();
  set.add(kForwardSpeed, m);
}

/// A reading error, such as a late count, contradicts once, and then in the opposite direction if at all; slip lasts.
/// Its end, where it has been seen, counts at once. If each reading error passed for slip, the wheels could say nothing
/// about the speed for the distance over which slip is forgotten.
bool FilterEngine::isSlip(double contradiction_mps) const {
  return contradiction_mps * contradiction_mps_ > 0.0 || shown(kFastSlip, vehicle_.fast_slip) != 0.0;
}

/// Before anything is learned from the measurement, or inflated for it.
void FilterEngine::tell(Component component, Nanoseconds stamp, const Measurement& measurement) const {
  if (!on_innovation_) {
    return;
  }
  if (const std::optional<InnovationSize> size = innovationSize(measurement, P_)) {
    on_innovation_({stamp, component, *size});
  }
}

/// @param jump square of the slip that would explain the innovation
void FilterEngine::loosen(const Measurement& forward, Nanoseconds stamp, double jump) {
  slipping_way_m_ += way_since_wheels_m_;
  if (slipping_way_m_ > kLongestSlip_m) {  // no slip lasts this long: the speed itself is doubted
    const Vector3 ahead_n = state_.q_b_to_n * Vector3::UnitX();
    P_.block<3, 3>(kVelocity, kVelocity) += square(forward.residual(0)) * ahead_n * ahead_n.transpose();
    slipping_way_m_ = 0.0;
  }
  if (jump <= square(kLargestSlipJump)) {
    P_(kFastSlip, kFastSlip) += jump;
  }
  imu_gap_uncertainty_.doubt(stamp, P_);
}

void FilterEngine::addConstraints(Nanoseconds stamp, MeasurementSet& set) {
  const BodyMotion motion = *constraint_average_.mean();
  const VelocityJacobian H_v = constraintJacobian(setup_.nonholonomic, constraint_average_.jacobian());
  const NoiseFactors factors = adaptation_.factors();
  const double information =
      constraintInformation(setup_.nonholonomic, std::abs(motion.v_eb_b.x()) * motion.duration_s);
  Measurement lateral = lateralMeasurement(setup_.nonholonomic, motion, H_v, vehicle_, factors.lateral);
  lateral.variance /= information;
  tell(kLateral, stamp, lateral);
  adaptation_.learnLateral(lateral.variance(0), innovationOf(lateral, kSideSlip, P_),
                           state_.q_b_to_n * Vector3::UnitY());
  set.add(kLateral, lateral);
  Measurement vertical = verticalMeasurement(setup_.nonholonomic, motion, H_v, vehicle_, factors.vertical);
  vertical.variance /= information;
  tell(kVertical, stamp, vertical);
  adaptation_.learnVertical(vertical.variance(0), innovationOf(vertical, kMountPitch, P_));
  set.add(kVertical, vertical);
}

/// The wheel motion without wheels that contradict the others.
PlanarMotion FilterEngine::soundMotion(const WheelMotion& wheels) const {
  PlanarMotion motion = wheels.motion;
  if (wheel_monitor_.faultyCount() > 0) {
    motion.forward_mps = wheel_monitor_.soundSpeed();
    motion.has_yaw_rate = false;
  }
  return motion;
}

}  // namespace slipnav
