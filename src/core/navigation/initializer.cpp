#include "slipnav/core/navigation/initializer.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"
#include "core/ins/leveling.h"
#include "core/navigation/navigator.h"
#include "core/navigation/start_covariance.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

// Wide enough that later measurements decide: the filter sees the same samples again and must not count them twice.
constexpr double kLevelStd_rad = 2.0 * kPi / 180.0;
constexpr double kHeadingStdFactor = 3.0;
// The drive continues until its fixes determine the heading this well, or is accepted as is after this many times its
// usual length.
constexpr double kHeadingGoal_rad = 2.0 * kPi / 180.0;
constexpr double kLongestDrive = 5.0;
// Distance by fixes over distance by wheels: a stuck rover, or fixes that wander, give no heading.
constexpr double kLeastScale = 0.5;
constexpr double kLargestScale = 2.0;
constexpr double kRestVelocityStd_mps = 0.05;
constexpr double kFixStdFactor = 3.0;
constexpr double kFixesSilent_s = 3.0;
// An attitude or position that counts as truth still ends up in a matrix that has to be inverted.
constexpr double kTruthAttitudeStd_rad = 1e-5;
constexpr double kTruthVelocityStd_mps = 1e-3;

Vector3 inBodyAxes(const std::vector<double>& values, double unit) {
  return unit * Vector3(values.at(0), values.at(1), values.at(2));
}

Geodetic startingPlace(const InitializationParams& params) {
  return {degToRad(params.latitude_deg), degToRad(params.longitude_deg), params.height_m};
}

ErrorCovariance priorCovariance(const ErrorVector& prior_variance) { return prior_variance.asDiagonal(); }

}  // namespace

void InitializationParams::visit(ParameterVisitor& v) {
  v.choice(
      "source", source, {"gnss", "given", "truth", "motion"},
      "gnss: rest, then a straight drive under gps/fix; given: the pose below; motion: the heading below, position "
      "zero; truth: the first truth pose (evaluation only)");
  v.number("heading_deg", heading_deg, {-360.0, 360.0}, "heading for given and motion, clockwise from north [°]");
  v.number("heading_std_deg", heading_std_deg, {0.0, 180.0}, "1σ of that heading [°]");
  v.number("latitude_deg", latitude_deg, {-89.99, 89.99}, "where the rover starts, for given and motion [°]");
  v.number("longitude_deg", longitude_deg, {-180.0, 180.0}, "likewise [°]");
  v.number("height_m", height_m, {-20000.0, 50000.0}, "likewise, above the ellipsoid [m]");
  v.number("position_std_m", position_std_m, {0.0, 1e6}, "1σ of a given start position on each axis [m]");
  v.number("min_rest_s", min_rest_s, {0.5, 3600.0}, "shortest standstill used for leveling [s]");
  v.number("max_rest_s", max_rest_s, {1.0, 3600.0}, "how much of a longer one is kept [s]");
  v.number("drive_distance_m", drive_distance_m, {1.0, 1000.0}, "length of the drive that gives the heading [m]");
  v.number("drive_heading_std_deg", drive_heading_std_deg, {1e-3, 45.0},
           "least 1σ of that heading: it is the course of the drive except for side slip and mounting, however good "
           "the fixes are [°]");
  v.number("leveling_window_s", leveling_window_s, {0.5, 600.0},
           "length of the window for leveling without a standstill [s]");
  v.number("moving_level_std_deg", moving_level_std_deg, {1e-3, 45.0},
           "1σ of roll and pitch after leveling on the move [°]");
  v.number("moving_speed_std_mps", moving_speed_std_mps, {1e-3, 10.0},
           "1σ of the velocity when starting on the move [m/s]");
  v.number("fix_stamp_offset_s", fix_stamp_offset_s, {-3600.0, 3600.0},
           "added to the stamps of gps/fix and gps/velocity, for a receiver with another time scale [s]");
  v.numbers("gyro_bias_deg_per_h", gyro_bias_deg_per_h, {-1e6, 1e6},
            "mean of the gyro bias at switch-on, body axes forward, right, down [°/h]");
  v.numbers("accel_bias_ug", accel_bias_ug, {-1e6, 1e6},
            "mean of the accelerometer bias at switch-on, body axes forward, right, down [µg]");
}

Initializer::Initializer(const Planet& planet, const InitializationParams& params, const ImuInputParams& imu,
                         const FilterSetup& setup)
    : planet_(planet),
      params_(params),
      imu_params_(imu),
      setup_(setup),
      prior_variance_(ErrorDynamics(planet, setup.imu, setup.vehicle).priorVariance()),
      recording_(setup.stationary, imuFloor(setup.imu), planet.gravity_n(startingPlace(params)).norm(),
                 params.min_rest_s, params.max_rest_s, inBodyAxes(params.accel_bias_ug, kMicroG),
                 inBodyAxes(params.gyro_bias_deg_per_h, degPerHourToRadps(1.0))),
      check_(planet.gravity_n(startingPlace(params)).norm(), setup.stationary.wheel_speed_mps) {}

void Initializer::push(const ImuSample& sample) {
  check_.push(sample);
  if (check_.complaint().empty()) {
    recording_.push(sample);
  } else {
    recording_.clear();
  }
}

void Initializer::push(const WheelMotion& wheels) {
  check_.push(wheels);
  if (check_.complaint().empty()) {
    recording_.push(wheels);
  } else {
    recording_.clear();
  }
}

void Initializer::reset() {
  recording_.clear();
  check_.reset();
  judged_fix_ = 0;
  clock_complaint_.clear();
  truth_.reset();
}

void Initializer::retune(const FilterSetup& setup) {
  setup_ = setup;
  recording_.retune(setup.stationary);
}

void Initializer::setTruth(const NavigationState& truth, bool has_attitude) {
  truth_ = truth;
  truth_has_attitude_ = has_attitude;
}

std::optional<InitialState> Initializer::result() const {
  if (!check_.complaint().empty()) {
    return std::nullopt;
  }
  if (params_.source == "gnss") {
    return fromDrive();
  }
  return params_.source == "truth" && truth_has_attitude_ ? fromTruth() : fromWindow();
}

bool Initializer::missesFixes() const {
  return params_.source == "gnss" && !recording_.fixes().empty() && !recording_.imu().empty() &&
         toSeconds(recording_.imu().back().stamp - recording_.fixes().back().stamp) > kFixesSilent_s;
}

std::string Initializer::progress() const {
  if (!complaint().empty()) {
    return complaint();
  }
  if (params_.source != "gnss") {
    return recording_.imu().empty() ? "waiting for imu/data" : "leveling";
  }
  if (!recording_.restIsLongEnough()) {
    return "waiting for a standstill of " + std::to_string(static_cast<int>(std::ceil(params_.min_rest_s))) + " s";
  }
  if (recording_.fixes().empty()) {
    return "waiting for gps/fix";
  }
  if (missesFixes()) {
    return "gps/fix silent";
  }
  return recording_.rest().over ? "straight drive under gps/fix" : "at rest: ready for the straight drive";
}

std::optional<InitialState> Initializer::fromTruth() const {
  if (!truth_) {
    return std::nullopt;
  }
  InitialState initial;
  initial.nav = *truth_;
  initial.origin = truth_->position;
  initial.P = priorCovariance(prior_variance_);
  initial.P.diagonal().segment<3>(kAttitude).setConstant(square(kTruthAttitudeStd_rad));
  initial.P.diagonal().segment<3>(kVelocity).setConstant(square(kTruthVelocityStd_mps));
  initial.P.diagonal().segment<3>(kPosition).setConstant(square(params_.position_std_m));
  return initial;
}

std::optional<InitialState> Initializer::fromWindow() const {
  const bool from_truth = params_.source == "truth";
  if (recording_.imu().size() < 2 || (from_truth && !truth_)) {
    return std::nullopt;
  }
  const std::optional<Nanoseconds> begin =
      recording_.windowBeginFrom(from_truth                    ? truth_->stamp
                                 : recording_.wheels().empty() ? recording_.imu().front().stamp
                                                               : recording_.wheels().front().stamp,
                                 params_.leveling_window_s);
  if (!begin || toSeconds(recording_.imu().back().stamp - *begin) < params_.leveling_window_s) {
    return std::nullopt;
  }
  const Nanoseconds end = *begin + fromSeconds(params_.leveling_window_s);
  const Nanoseconds slack = fromSeconds(setup_.stationary.hold_off_s + setup_.stationary.window_s + 0.5);
  const bool at_rest =
      recording_.rest().begin != 0 && recording_.rest().begin <= *begin + slack && recording_.rest().end + slack >= end;
  InitialState initial =
      leveled(*begin, at_rest ? std::min(end, recording_.rest().end) : end, at_rest, degToRad(params_.heading_deg));
  initial.nav.position = {degToRad(params_.latitude_deg), degToRad(params_.longitude_deg), params_.height_m};
  if (from_truth) {
    initial.nav.position = truth_->position;
  }
  initial.origin = initial.nav.position;
  initial.P(kAttitude + 2, kAttitude + 2) = square(degToRad(params_.heading_std_deg));
  initial.P.diagonal().segment<3>(kPosition).setConstant(square(params_.position_std_m));
  return initial;
}

std::optional<Initializer::DriveEnd> Initializer::newestKnownFix() const {
  const std::vector<PositionFix>& fixes = recording_.fixes();
  for (auto fix = fixes.rbegin(); fix != fixes.rend() && fix->stamp > judged_fix_; ++fix) {
    const std::optional<Nanoseconds> until = recording_.firstImuStampFrom(fix->stamp);
    if (until && (recording_.wheels().back().stamp >= *until ||
                  toSeconds(recording_.imu().back().stamp - *until) >= setup_.filter.max_wait_s)) {
      return DriveEnd{fix->stamp, *until};
    }
  }
  return std::nullopt;
}

std::optional<InitialState> Initializer::fromDrive() const {
  const bool rested = recording_.restIsLongEnough();
  if (recording_.imu().size() < 2 || recording_.fixes().empty() || recording_.wheels().empty() ||
      (rested && !recording_.rest().over)) {
    return std::nullopt;
  }
  if (!clock_complaint_.empty() && recording_.rest().begin <= judged_fix_) {
    return std::nullopt;  // on a straight line the lag would soon be absorbed by the start position
  }
  const std::optional<Nanoseconds> begin = recording_.windowBeginFrom(
      rested ? recording_.rest().begin : recording_.fixes().front().stamp, params_.leveling_window_s);
  const std::optional<DriveEnd> end = newestKnownFix();
  const bool levels =
      begin && (rested || toSeconds(recording_.imu().back().stamp - *begin) >= params_.leveling_window_s);
  if (!levels || !end) {
    return std::nullopt;
  }
  judged_fix_ = end->fix;
  const std::optional<DriveFit> fit = fitOfDrive(*begin, end->fix, rested);
  if (!fit) {
    return std::nullopt;
  }
  const InitialState initial = beginOfDrive(*begin, *fit, rested);
  InitialState result = runFilter(initial, end->imu);
  result.origin = initial.origin;
  return result;
}

/// Nothing as long as the drive does not determine the heading.
std::optional<DriveFit> Initializer::fitOfDrive(Nanoseconds begin, Nanoseconds end, bool at_rest) const {
  const double bias_z = at_rest ? recording_.mean(recording_.rest().begin, recording_.rest().end).omega_ib_b.z()
                                : degPerHourToRadps(params_.gyro_bias_deg_per_h.at(2));
  const Nanoseconds level_end = at_rest ? recording_.rest().end : begin + fromSeconds(params_.leveling_window_s);
  const Quaternion q_b_to_level = leveled(begin, level_end, at_rest, 0.0).nav.q_b_to_n;
  const DriveTrack track(recording_, begin, bias_z, q_b_to_level * setup_.lever_imu_to_antenna_b);
  if (track.reach() < params_.drive_distance_m) {
    return std::nullopt;
  }
  const std::vector<PositionFix>& fixes = recording_.fixes();
  const Geodetic& reference = fixes.front().position;
  if (const std::optional<double> lag_s = lagOfFixes(planet_, fixes, track, reference, begin, end)) {
    clock_complaint_ = describeLag(*lag_s);
    return std::nullopt;
  }
  clock_complaint_.clear();
  const std::optional<DriveFit> fit = fitDrive(planet_, fixes, track, reference, begin, end);
  const bool tells =
      fit && fit->distance_m >= params_.drive_distance_m && fit->scale > kLeastScale && fit->scale < kLargestScale &&
      (fit->heading_std_rad < kHeadingGoal_rad || fit->distance_m >= kLongestDrive * params_.drive_distance_m);
  return tells ? fit : std::nullopt;
}

InitialState Initializer::beginOfDrive(Nanoseconds begin, const DriveFit& fit, bool at_rest) const {
  const Nanoseconds level_end = at_rest ? recording_.rest().end : begin + fromSeconds(params_.leveling_window_s);
  InitialState initial = leveled(begin, level_end, at_rest, fit.heading_rad);
  const std::vector<PositionFix>& fixes = recording_.fixes();
  initial.nav.position = fixes.front().position;
  ErrorVector from_start = ErrorVector::Zero();
  from_start.segment<2>(kPosition) = -fit.start_ne_m;
  subtractError(planet_, from_start, initial.nav);
  const Vector3 antenna_n = initial.nav.q_b_to_n * setup_.lever_imu_to_antenna_b;
  initial.nav.position.height_m = meanHeight(fixes, begin, level_end) + antenna_n.z();
  initial.origin = initial.nav.position;
  const auto best = std::min_element(fixes.begin(), fixes.end(), [](const PositionFix& a, const PositionFix& b) {
    return a.variance_ned_m2.sum() < b.variance_ned_m2.sum();
  });
  initial.P.diagonal().segment<3>(kPosition) = square(kFixStdFactor) * best->variance_ned_m2;
  initial.P(kAttitude + 2, kAttitude + 2) =
      square(std::max(degToRad(params_.drive_heading_std_deg), kHeadingStdFactor * fit.heading_std_rad));
  return initial;
}

InitialState Initializer::leveled(Nanoseconds begin, Nanoseconds end, bool at_rest, double heading_rad) const {
  InitialState initial;
  initial.nav.stamp = begin;
  initial.nav.accel_bias_b = inBodyAxes(params_.accel_bias_ug, kMicroG);
  initial.nav.gyro_bias_b = inBodyAxes(params_.gyro_bias_deg_per_h, degPerHourToRadps(1.0));
  initial.P = priorCovariance(prior_variance_);
  if (at_rest) {
    levelAtRestInto(recording_.mean(begin, end), heading_rad, initial);
  } else {
    levelOnTheMoveInto(begin, end, heading_rad, initial);
  }
  return initial;
}

void Initializer::levelAtRestInto(const ImuSample& mean, double heading_rad, InitialState& initial) const {
  const auto attitude = [&mean, heading_rad](const Vector3& accel_bias_b) {
    const Vector2 roll_pitch = levelAtRest(mean.f_ib_b - accel_bias_b);
    return q_b_to_n_fromEuler(roll_pitch.x(), roll_pitch.y(), heading_rad);
  };
  initial.nav.q_b_to_n = attitude(initial.nav.accel_bias_b);
  initial.P.diagonal().segment<3>(kAttitude).setConstant(square(kLevelStd_rad));
  initial.P.diagonal().segment<3>(kVelocity).setConstant(square(kRestVelocityStd_mps));
  tieLevelToAccelBias(planet_, attitude, initial);
  believeSurprisingBias(mean.omega_ib_b, initial);
}

void Initializer::levelOnTheMoveInto(Nanoseconds begin, Nanoseconds end, double heading_rad,
                                     InitialState& initial) const {
  std::vector<ImuSample> window;
  std::copy_if(recording_.imu().begin(), recording_.imu().end(), std::back_inserter(window),
               [begin, end](const ImuSample& s) { return s.stamp >= begin && s.stamp <= end; });
  for (ImuSample& sample : window) {
    sample.omega_ib_b -= initial.nav.gyro_bias_b;
  }
  const double speed_mps = recording_.speedAt(begin);
  const Vector3 reaction = reactionToGravityOnTheMove(window, speed_mps, recording_.speedAt(end));
  const auto attitude = [&reaction, heading_rad](const Vector3& accel_bias_b) {
    const Vector2 roll_pitch = levelAtRest(reaction - accel_bias_b);
    return q_b_to_n_fromEuler(roll_pitch.x(), roll_pitch.y(), heading_rad);
  };
  initial.nav.q_b_to_n = attitude(initial.nav.accel_bias_b);
  initial.nav.v_eb_n = initial.nav.q_b_to_n * Vector3(speed_mps, 0.0, 0.0);
  initial.P.diagonal().segment<3>(kAttitude).setConstant(square(degToRad(params_.moving_level_std_deg)));
  initial.P.diagonal().segment<3>(kVelocity).setConstant(square(params_.moving_speed_std_mps));
  tieLevelToAccelBias(planet_, attitude, initial);
}

InitialState Initializer::runFilter(const InitialState& start, Nanoseconds until) const {
  FilterSetup setup = setup_;
  setup.gnss = FixParams();  // all fixes are already there
  Navigator navigator(planet_, imu_params_, setup);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  auto velocity = recording_.velocityFixes().begin();
  const auto pushVelocitiesUntil = [&](Nanoseconds stamp) {
    for (; velocity != recording_.velocityFixes().end() && velocity->stamp <= stamp; ++velocity) {
      navigator.push(*velocity);
    }
  };
  for (const PositionFix& fix : recording_.fixes()) {
    if (fix.stamp <= until) {
      pushVelocitiesUntil(fix.stamp);
      navigator.push(fix);
    }
  }
  pushVelocitiesUntil(until);
  for (const WheelMotion& wheels : recording_.wheels()) {
    if (wheels.stamp <= until) {
      navigator.push(wheels, ignore);
    }
  }
  for (const ImuSample& sample : recording_.imu()) {
    if (sample.stamp <= until) {
      navigator.push(sample, ignore);
    }
  }
  navigator.initialize(start);
  navigator.completeUpTo(until, ignore);
  InitialState result = navigator.filter().snapshot();
  result.origin = start.origin;
  return result;
}

}  // namespace slipnav
