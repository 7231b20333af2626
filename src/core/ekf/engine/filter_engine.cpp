#include "slipnav/core/ekf/engine/filter_engine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav {
namespace {

/// Receivers give a fix at least every second; after a longer silence the next one cannot be predicted [s].
constexpr double kLongestFixInterval_s = 2.5;

/// An estimated slip beyond this many standard deviations is not an IMU error.
constexpr double kShownSigmas = 2.0;

/// Slip over fewer of its lengths is fast slip.
constexpr double kLongerThanFast = 10.0;

/// Significant fast slip is not pulled back to zero as if it were usual for the ground: where soft ground begins, the
/// wheels would pull the velocity along within a meter. It is driven by its own square until it has passed. That is for
/// wheels that outrun the vehicle: one that is faster than its wheels is slowed down by them within a second.
void holdShownSlip(double slip, double ground_variance, ErrorTransition& transition) {
  if (slip > 0.0 && square(slip) > ground_variance && ground_variance > 0.0) {
    transition.noise(kFastSlip) *= square(slip) / ground_variance;
  }
}

/// Slip that nobody expected is a property of this ground. If it returned to zero it would be forgotten within tens of
/// meters, and the wheels would pull the velocity along again. It varies by as much as usual ground does along the way.
/// @param usual fraction of the variance in `transition` that usual ground has
void holdSlowSlip(double usual, ErrorTransition& transition) {
  transition.decay(kSlowSlip - 9) = 1.0;
  transition.noise(kSlowSlip) *= usual;
}

}  // namespace

FilterEngine::FilterEngine(const Planet& planet, const FilterSetup& setup)
    : planet_(planet),
      setup_(setup),
      dynamics_(planet, setup.imu, setup.vehicle),
      detector_(setup.stationary, imuFloor(setup.imu)),
      update_(setup.filter),
      imu_gap_uncertainty_(setup.filter),
      wheel_monitor_(setup.wheel_monitor, setup.wheels),
      standstill_noise_(setup.zero),
      adaptation_(setup.filter.adaptation, setup.imu, setup.vehicle.slope_slip),
      use_wheel_(setup.filter.uses("wheel")),
      use_nonholonomic_(setup.filter.uses("nonholonomic")),
      use_zupt_(setup.filter.uses("zupt")),
      use_zaru_(setup.filter.uses("zaru")),
      wheels_(setup.filter.max_wheel_interval_s),
      fix_interval_(kLongestFixInterval_s),
      unexpected_slip_(kLongerThanFast * setup.vehicle.fast_slip_length_m) {}

void FilterEngine::reset() {
  initialized_ = false;
  steps_.clear();
  wheels_.clear();
  fixes_.clear();
  fixes_complete_until_ = 0;
}

void FilterEngine::retune(const FilterSetup& setup) {
  setup_ = setup;
  detector_.retune(setup.stationary);
  update_.retune(setup.filter);
  standstill_noise_.retune(setup.zero);
}

void FilterEngine::initialize(const InitialState& initial) {
  initialized_ = true;
  state_ = initial.nav;
  vehicle_ = initial.vehicle;
  P_ = initial.P;
  has_moved_ = false;
  has_rested_ = false;
  epoch_ = 0;
  estimate_ = Estimate{};
  detector_.reset();
  stuck_.reset();
  runaway_.reset();
  update_ = GatedUpdate(setup_.filter);
  standstill_noise_ = StandstillNoise(setup_.zero);
  wheel_monitor_.reset();
  imu_gap_uncertainty_.reset();
  adaptation_.reset();
  if (initial.standstill_variance > 0.0) {
    standstill_noise_.setVariance(initial.standstill_variance);
  }
  // A wheel interval that began before the initial state is not known in full and is not used.
  average_.restart(wheels_.start(initial.nav.stamp) ? initial.nav.stamp : 0);
  constraint_average_ = MeanMotion();
  slipping_speed_.reset();
  last_forward_mps_ = 0.0;
  last_rate_b_.reset();
  surface_speed_mps_ = 0.0;
  slipping_way_m_ = 0.0;
  contradiction_mps_ = 0.0;
  lasting_slip_.reset();
  unexpected_slip_.begin();
  slow_slip_lasts_ = false;
  way_since_wheels_m_ = slow_envelope_ = side_envelope_ = 0.0;
  steps_.clear();
  while (!fixes_.empty() && stampOf(fixes_.front()) <= initial.nav.stamp) {
    fixes_.pop_front();
  }
  fix_interval_.restart(initial.nav.stamp);
  used_fix_ = 0;
  if (history_) {
    history_->begin(P_);
  }
}

void FilterEngine::push(const InsStep& step) {
  const Nanoseconds end = steps_.empty() ? state_.stamp : steps_.back().state.stamp;
  if (initialized_ && step.epoch == epoch_ && step.start == end) {
    steps_.push_back(step);
  }
}

bool FilterEngine::push(const WheelMotion& wheels) {
  if (!std::isfinite(wheels.motion.forward_mps) || !std::isfinite(wheels.motion.yaw_rate_radps)) {
    return false;
  }
  if (initialized_ && !has_moved_ && wheels.stamp == state_.stamp) {
    average_.restart(state_.stamp);  // starts the first interval
    return true;
  }
  return wheels_.push(wheels, state_.stamp);
}

Correction FilterEngine::place(const PoseOverride& pose) {
  const Geodetic& position = pose.position;
  const bool possible = std::isfinite(position.longitude_rad) && std::isfinite(position.height_m) &&
                        std::abs(position.latitude_rad) < 0.5 * kPi && pose.position_std_m > 0.0 &&
                        std::isfinite(pose.heading_rad.value_or(0.0)) &&
                        (!pose.heading_rad || pose.heading_std_rad > 0.0);
  if (!possible) {
    throw std::invalid_argument("the position is not on this planet, or a standard deviation is not above 0");
  }
  if (!initialized_ || !has_moved_) {
    throw std::invalid_argument("there is no estimate yet");
  }
  state_.position = position;
  for (int axis = 0; axis < 3; ++axis) {
    forget(kPosition + axis, square(pose.position_std_m));
  }
  if (pose.heading_rad) {
    turnTo(*pose.heading_rad, pose.heading_std_rad);
  }
  return *reissue();
}

std::optional<Correction> FilterEngine::reissue() {
  if (!initialized_ || !has_moved_) {
    return std::nullopt;
  }
  steps_.clear();
  return Correction{++epoch_, state_};
}

InitialState FilterEngine::snapshot() const {
  InitialState snapshot;
  snapshot.nav = state_;
  snapshot.vehicle = vehicle_;
  snapshot.P = P_;
  snapshot.standstill_variance = standstill_noise_.variance();
  return snapshot;
}

/// Rotates the whole state about the vertical; the velocity rotates too, and is as uncertain as its new direction.
void FilterEngine::turnTo(double heading_rad, double heading_std_rad) {
  const Quaternion turn(Eigen::AngleAxisd(heading_rad - eulerFrom_q_b_to_n(state_.q_b_to_n).z(), Vector3::UnitZ()));
  state_.q_b_to_n = (turn * state_.q_b_to_n).normalized();
  state_.v_eb_n = turn * state_.v_eb_n;
  forget(kAttitude + 2, square(heading_std_rad));
  P_.diagonal().segment<2>(kVelocity).array() += square(heading_std_rad) * state_.v_eb_n.head<2>().squaredNorm();
}

bool FilterEngine::isCertain(Nanoseconds end, Nanoseconds trusted) const {
  const double passed_s = toSeconds(trusted - end);
  if (fixesKnownUntil() < end && passed_s < setup_.gnss.max_wait_s) {
    return false;
  }
  if (setup_.filter.updates.empty() || wheels_.knownUntil() >= end) {
    return true;
  }
  return passed_s >= setup_.filter.max_wait_s;
}

std::optional<Correction> FilterEngine::advance(const EstimateSink& sink, std::optional<Nanoseconds> trusted) {
  while (!steps_.empty() && isCertain(steps_.front().state.stamp, trusted.value_or(steps_.back().state.stamp))) {
    const InsStep step = steps_.front();
    steps_.pop_front();
    const Vector3 v_mean_b = propagate(step);
    const bool by_wheels = applyWheels(step, v_mean_b);
    const bool by_fixes = applyFixes(step);
    estimate_.first = !has_moved_;
    estimate_.nav = state_;
    estimate_.vehicle = vehicle_;
    estimate_.f_ib_b = step.f_ib_b;
    estimate_.omega_ib_b = step.omega_ib_b;
    has_moved_ = true;
    if (history_) {
      history_->endStep(state_, vehicle_, step.omega_ib_b, P_);
    }
    sink(estimate_, P_);
    if (by_wheels || by_fixes) {
      steps_.clear();
      return Correction{++epoch_, state_};
    }
  }
  return std::nullopt;
}

double FilterEngine::shown(int state, double slip) const {
  return square(slip) > square(kShownSigmas) * P_(state, state) ? slip : 0.0;
}

Vector3 FilterEngine::propagate(const InsStep& step) {
  const NavigationState before = state_;
  const Vector3 v_start_b = referenceVelocity(step);
  const double duration_s = std::min(toSeconds(step.state.stamp - step.start), kLongestGap_s);
  const Vector3 rate_b = step.omega_ib_b + state_.gyro_bias_b;
  const bool follows = last_rate_b_ && step.gap_s <= 0.0;  // as in the mechanization
  const Vector3 rate_change_b = follows ? Vector3(rate_b - *last_rate_b_) : Vector3(Vector3::Zero());
  last_rate_b_ = rate_b;
  transition_ = dynamics_.transition(state_, step.state, step.f_ib_b, step.omega_ib_b, rate_change_b, duration_s);
  if (estimate_.stationary) {
    transition_.motion_from_offset.setZero();  // these rates are noise
  }
  const double slow_slip = shown(kSlowSlip, vehicle_.slow_slip);
  adaptation_.addNoise(dynamics_, step, step.state, slow_slip, surface_speed_mps_ * duration_s, transition_);
  slow_slip_lasts_ = slow_slip_lasts_ && slow_slip != 0.0;
  if (slow_slip_lasts_) {
    holdSlowSlip(dynamics_.ground().slow_slip_variance / adaptation_.ground().slow_slip_variance, transition_);
  }
  // A slower rover does not hold its slip: its IMU would drift meanwhile.
  if (state_.v_eb_n.norm() * setup_.filter.max_rejection_s > setup_.vehicle.fast_slip_length_m) {
    holdShownSlip(shown(kFastSlip, vehicle_.fast_slip), adaptation_.ground().fast_slip_variance, transition_);
  }
  ErrorDynamics::propagate(transition_, P_);
  unexpected_slip_.propagate(transition_, surface_speed_mps_ * duration_s);
  if (history_) {
    history_->propagate(transition_);
  }
  average_.propagate(transition_);
  constraint_average_.propagate(transition_);
  ErrorDynamics::decay(transition_, vehicle_);
  const Vector3 f_ib_b = step.f_ib_b + state_.accel_bias_b;
  detector_.addImu(step.state.stamp, f_ib_b, rate_b);
  runaway_.addImu(f_ib_b, duration_s);
  state_ = step.state;
  if (step.gap_s > 0.0) {
    endGap(step, before);
  }
  const Vector3 v_end_b = referenceVelocity(step);
  return step.gap_s > 0.0 ? v_end_b : 0.5 * (v_start_b + v_end_b);  // the path through a gap is unknown
}

void FilterEngine::endGap(const InsStep& step, const NavigationState& before) {
  imu_gap_uncertainty_.begin(state_, std::min(step.gap_s, kLongestGap_s), runaway_.fastest_mps(), P_);
  if (step.gap_s > setup_.filter.max_wheel_interval_s && step.gap_s <= kLongestGap_s &&
      !wheels_.hasUpTo(step.start + fromSeconds(step.gap_s))) {
    ImuGapUncertainty::allowForStandstill(before, state_, P_);
  }
  forgetSlipImpulse();
  average_ = constraint_average_ = MeanMotion();
}

Vector3 FilterEngine::referenceVelocity(const InsStep& step) const {
  const Vector3 omega_ie_b = state_.q_b_to_n.conjugate() * planet_.omega_ie_n(state_.position.latitude_rad);
  return bodyVelocity(state_, step.omega_ib_b - omega_ie_b, setup_.lever_imu_to_reference_b);
}

/// After a gap the slip impulse estimate is void: if it were kept, the wheels could say nothing about the speed,
/// and the tilt, now unknown, would turn into speed before it is observed.
void FilterEngine::forgetSlipImpulse() {
  forget(kFastSlip, dynamics_.priorVariance()(kFastSlip));
  vehicle_.fast_slip = 0.0;
}

void FilterEngine::forget(int index, double variance) {
  forgetError(index, variance, P_);
  unexpected_slip_.forget(index);
  if (history_) {
    history_->forget(index);
  }
}

bool FilterEngine::update(MeasurementSet set) {
  const std::optional<Measurement> passed = update_.select(set, state_.stamp, P_);
  return passed && use(*passed);
}

/// @param is_evidence false for what nobody has measured
bool FilterEngine::use(const Measurement& measurement, bool is_evidence) {
  if (history_) {
    history_->advance(P_);
  }
  const std::optional<UpdateGain> used = updateCovariance(measurement, P_);
  if (used) {
    unexpected_slip_.update(measurement, *used, is_evidence);
    take(-used->K * measurement.residual);
  }
  return used.has_value();
}

void FilterEngine::take(const ErrorVector& error) {
  const ErrorReset reset = correct(planet_, error, state_);
  applyReset(reset, P_);
  subtractError(error, vehicle_);
  average_.correct(error, reset);
  constraint_average_.correct(error, reset);
  if (history_) {
    history_->correct(error, reset, P_);
  }
}

}  // namespace slipnav
