#include "slipnav/core/ekf/engine/filter_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav {
namespace {

/// Receivers give a fix at least every second; after a longer silence the next one cannot be predicted [s].
constexpr double kLongestFixInterval_s = 2.5;
constexpr std::size_t kMaxFixes = 4096;  // not yet applied

/// An estimated slip beyond this many standard deviations is not an IMU error.
constexpr double kShownSigmas = 2.0;

double shownSlip(double slip, double variance) { return square(slip) > square(kShownSigmas) * variance ? slip : 0.0; }

/// Significant fast slip is not pulled back to zero as if it were usual for the ground: where soft ground begins, the
/// wheels would pull the velocity along within a meter. It is driven by its own square until it has passed.
void holdShownSlip(double slip, double ground_variance, ErrorTransition& transition) {
  if (square(slip) > ground_variance && ground_variance > 0.0) {
    transition.noise(kFastSlip) *= square(slip) / ground_variance;
  }
}

bool earlier(const AntennaFix& a, const AntennaFix& b) {
  return std::pair(stampOf(a), a.index()) < std::pair(stampOf(b), b.index());
}

}  // namespace

FilterEngine::FilterEngine(const Planet& planet, const FilterSetup& setup)
    : planet_(planet),
      setup_(setup),
      dynamics_(planet, setup.imu, setup.vehicle),
      detector_(setup.stationary, imuFloor(setup.imu)),
      update_(setup.filter),
      unseen_motion_(setup.filter),
      wheel_monitor_(setup.wheel_monitor, setup.wheels),
      tremor_(setup.zero),
      adaptation_(setup.filter.adaptation, setup.imu, setup.vehicle.slope_slip),
      use_wheel_(setup.filter.uses("wheel")),
      use_nonholonomic_(setup.filter.uses("nonholonomic")),
      use_zupt_(setup.filter.uses("zupt")),
      use_zaru_(setup.filter.uses("zaru")),
      wheels_(setup.filter.max_wheel_interval_s),
      fix_cadence_(kLongestFixInterval_s) {}

void FilterEngine::reset() {
  initialised_ = false;
  steps_.clear();
  wheels_.clear();
  fixes_.clear();
  fixes_complete_until_ = 0;
}

void FilterEngine::retune(const FilterSetup& setup) {
  setup_ = setup;
  detector_.retune(setup.stationary);
  update_.retune(setup.filter);
  tremor_.retune(setup.zero);
}

void FilterEngine::initialise(const InitialState& initial) {
  initialised_ = true;
  state_ = initial.nav;
  vehicle_ = initial.vehicle;
  P_ = initial.P;
  next_sequence_ = 0;
  epoch_ = 0;
  estimate_ = Estimate{};
  detector_.reset();
  stuck_.reset();
  runaway_.reset();
  update_ = GatedUpdate(setup_.filter);
  tremor_ = Tremor(setup_.zero);
  wheel_monitor_.reset();
  unseen_motion_.reset();
  adaptation_.reset();
  if (initial.tremor_variance > 0.0) {
    tremor_.setVariance(initial.tremor_variance);
  }
  // A wheel interval that began before the initial state is not known in full and is not used.
  average_.restart(wheels_.start(initial.nav.stamp) ? initial.nav.stamp : 0);
  constraint_average_.restart(0);
  slipping_speed_.reset();
  last_forward_mps_ = 0.0;
  surface_speed_mps_ = 0.0;
  slipping_way_m_ = 0.0;
  lasting_slip_.reset();
  way_since_wheels_m_ = slow_envelope_ = side_envelope_ = 0.0;
  steps_.clear();
  while (!fixes_.empty() && stampOf(fixes_.front()) <= initial.nav.stamp) {
    fixes_.pop_front();
  }
  fix_cadence_.restart(initial.nav.stamp);
  used_fix_ = 0;
  if (history_) {
    history_->begin(P_);
  }
}

void FilterEngine::push(const InsStep& step) {
  const std::uint64_t expected = next_sequence_ + steps_.size();
  if (initialised_ && step.epoch == epoch_ && step.sequence == expected) {
    steps_.push_back(step);
  }
}

bool FilterEngine::push(const WheelMotion& wheels) {
  if (!std::isfinite(wheels.motion.forward_mps) || !std::isfinite(wheels.motion.yaw_rate_radps)) {
    return false;
  }
  if (initialised_ && next_sequence_ == 0 && wheels.stamp == state_.stamp) {
    average_.restart(state_.stamp);  // starts the first interval
    return true;
  }
  return wheels_.push(wheels, state_.stamp);
}

Correction FilterEngine::place(const Placement& placement) {
  const Geodetic& position = placement.position;
  const bool possible = std::isfinite(position.longitude_rad) && std::isfinite(position.height_m) &&
                        std::abs(position.latitude_rad) < 0.5 * kPi && placement.position_std_m > 0.0 &&
                        std::isfinite(placement.heading_rad.value_or(0.0)) &&
                        (!placement.heading_rad || placement.heading_std_rad > 0.0);
  if (!possible) {
    throw std::invalid_argument("the position is not on this planet, or a standard deviation is not above 0");
  }
  if (!initialised_ || next_sequence_ == 0) {
    throw std::invalid_argument("there is no estimate yet");
  }
  state_.position = position;
  for (int axis = 0; axis < 3; ++axis) {
    forget(kPosition + axis, square(placement.position_std_m));
  }
  if (placement.heading_rad) {
    turnTo(*placement.heading_rad, placement.heading_std_rad);
  }
  return *reissue();
}

std::optional<Correction> FilterEngine::reissue() {
  if (!initialised_ || next_sequence_ == 0) {
    return std::nullopt;
  }
  steps_.clear();
  return Correction{next_sequence_ - 1, ++epoch_, state_};
}

InitialState FilterEngine::snapshot() const {
  InitialState snapshot;
  snapshot.nav = state_;
  snapshot.vehicle = vehicle_;
  snapshot.P = P_;
  snapshot.tremor_variance = tremor_.variance();
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

bool FilterEngine::push(const AntennaFix& fix) {
  const bool finite = std::visit([](const auto& f) { return isFinite(f); }, fix);
  if (!finite || (initialised_ && stampOf(fix) <= state_.stamp)) {
    return false;
  }
  if (fixes_.size() >= kMaxFixes) {
    fixes_.pop_front();
  }
  fixes_.insertSorted(fix, earlier);
  return true;
}

Nanoseconds FilterEngine::fixesKnownUntil() const {
  if (!setup_.gnss.always()) {
    return std::numeric_limits<Nanoseconds>::max();
  }
  Nanoseconds known = fix_cadence_.newest();
  for (std::size_t i = 0; i < fixes_.size() && !fix_cadence_.isHole(known, stampOf(fixes_[i])); ++i) {
    known = stampOf(fixes_[i]);
  }
  return std::max({known, fix_cadence_.quietUntil() - 1, fixes_complete_until_});
}

bool FilterEngine::isCertain(const InsStep& step) const {
  const double passed_s = toSeconds(steps_.back().state.stamp - step.state.stamp);
  if (fixesKnownUntil() < step.state.stamp && passed_s < setup_.gnss.max_wait_s) {
    return false;
  }
  if (setup_.filter.updates.empty() || wheels_.knownUntil() >= step.state.stamp) {
    return true;
  }
  return passed_s >= setup_.filter.max_wait_s;
}

std::optional<Correction> FilterEngine::advance(const EstimateSink& sink) {
  while (!steps_.empty() && isCertain(steps_.front())) {
    const InsStep step = steps_.front();
    steps_.pop_front();
    const Vector3 v_mean_b = propagate(step);
    const bool by_wheels = applyWheels(step, v_mean_b);
    const bool by_fixes = applyFixes(step);
    estimate_.sequence = step.sequence;
    estimate_.nav = state_;
    estimate_.vehicle = vehicle_;
    estimate_.f_ib_b = step.f_ib_b;
    estimate_.omega_ib_b = step.omega_ib_b;
    ++next_sequence_;
    if (history_) {
      history_->endStep(state_, vehicle_, step.omega_ib_b, P_);
    }
    sink(estimate_, P_);
    if (by_wheels || by_fixes) {
      steps_.clear();
      return Correction{step.sequence, ++epoch_, state_};
    }
  }
  return std::nullopt;
}

Vector3 FilterEngine::propagate(const InsStep& step) {
  const NavigationState before = state_;
  const Vector3 v_start_b = referenceVelocity(step);
  const double duration_s = std::min(toSeconds(step.state.stamp - step.start), kLongestGap_s);
  transition_ = dynamics_.transition(state_, step.state, step.f_ib_b, step.omega_ib_b, duration_s);
  adaptation_.addNoise(dynamics_, step, step.state, shownSlip(vehicle_.slow_slip, P_(kSlowSlip, kSlowSlip)),
                       surface_speed_mps_ * duration_s, transition_);
  // A slower rover does not hold its slip: its IMU would drift meanwhile.
  if (state_.v_eb_n.norm() * setup_.filter.max_rejection_s > setup_.vehicle.fast_slip_length_m) {
    holdShownSlip(shownSlip(vehicle_.fast_slip, P_(kFastSlip, kFastSlip)), adaptation_.ground().fast_slip_variance,
                  transition_);
  }
  ErrorDynamics::propagate(transition_, P_);
  if (history_) {
    history_->propagate(transition_);
  }
  average_.propagate(transition_);
  constraint_average_.propagate(transition_);
  ErrorDynamics::decay(transition_, vehicle_);
  const Vector3 f_ib_b = step.f_ib_b + state_.accel_bias_b;
  detector_.addImu(step.state.stamp, f_ib_b, step.omega_ib_b + state_.gyro_bias_b);
  runaway_.addImu(f_ib_b, duration_s);
  state_ = step.state;
  if (step.gap_s > 0.0) {
    endGap(step, before);
  }
  const Vector3 v_end_b = referenceVelocity(step);
  return step.gap_s > 0.0 ? v_end_b : 0.5 * (v_start_b + v_end_b);  // the path through a gap is unknown
}

void FilterEngine::endGap(const InsStep& step, const NavigationState& before) {
  unseen_motion_.begin(state_, std::min(step.gap_s, kLongestGap_s), runaway_.fastest_mps(), P_);
  if (step.gap_s > setup_.filter.max_wheel_interval_s && step.gap_s <= kLongestGap_s &&
      !wheels_.hasUpTo(step.start + fromSeconds(step.gap_s))) {
    UnseenMotion::allowForStandstill(before, state_, P_);
  }
  forgetSlipImpulse();
  average_.restart(0);
  constraint_average_.restart(0);
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
  if (history_) {
    history_->forget(index);
  }
}

bool FilterEngine::applyFixes(const InsStep& step) {
  const Vector3& lever_b = setup_.lever_imu_to_antenna_b;
  bool corrected = false;
  while (!fixes_.empty() && stampOf(fixes_.front()) <= state_.stamp) {
    MeasurementSet set;
    if (const auto* position = std::get_if<PositionFix>(&fixes_.front())) {
      addFix(*position, set);
    } else {
      set.add(kFixVelocity, velocityMeasurement(planet_, std::get<VelocityFix>(fixes_.front()), state_, step.f_ib_b,
                                                step.omega_ib_b, lever_b));
    }
    const Nanoseconds stamp = stampOf(fixes_.front());
    if (update(set)) {
      corrected = true;
      used_fix_ = stamp;
    }
    if (stamp > fix_cadence_.newest()) {
      fix_cadence_.add(stamp);
    }
    fixes_.pop_front();
  }
  return corrected;
}

/// Gated by the receiver's covariance, and weighted by what it adds to earlier fixes.
void FilterEngine::addFix(const PositionFix& fix, MeasurementSet& set) const {
  const double factor = setup_.gnss.always() && used_fix_ != 0
                            ? repeatedFixFactor(toSeconds(fix.stamp - used_fix_), setup_.gnss.correlation_s)
                            : 1.0;
  set.add(kFixPosition, positionMeasurement(planet_, fix, state_, setup_.lever_imu_to_antenna_b), factor);
}

bool FilterEngine::update(MeasurementSet set) {
  const std::optional<Measurement> passed = update_.select(set, state_.stamp, P_);
  return passed && use(*passed);
}

bool FilterEngine::use(const Measurement& measurement) {
  if (history_) {
    history_->advance(P_);
  }
  const std::optional<ErrorVector> error = kalmanUpdate(measurement, P_);
  if (error) {
    take(*error);
  }
  return error.has_value();
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
