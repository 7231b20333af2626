#include "slipnav/navigator/initializer.h"

#include <algorithm>
#include <cmath>

#include "slipnav/ins/levelling.h"
#include "slipnav/math/rotation.h"
#include "slipnav/math/square.h"
#include "slipnav/navigator/navigator.h"

namespace slipnav {
namespace {

// Wide enough that what follows decides: the filter sees the same samples again and must not count them twice.
constexpr double kLevelStd_rad = 2.0 * kPi / 180.0;
constexpr double kDriveHeadingStd_rad = 5.0 * kPi / 180.0;
constexpr double kRestVelocityStd_mps = 0.05;
constexpr double kFixStdFactor = 3.0;
constexpr double kFixesSilent_s = 3.0;
// An attitude or position that is called the truth still ends up in a matrix that has to be inverted.
constexpr double kTruthAttitudeStd_rad = 1e-5;
constexpr double kTruthVelocityStd_mps = 1e-3;

Vector3 inBodyAxes(const std::vector<double>& values, double unit) {
  return unit * Vector3(values.at(0), values.at(1), values.at(2));
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
  v.number("min_rest_s", min_rest_s, {0.5, 3600.0}, "shortest standstill that serves for levelling [s]");
  v.number("max_rest_s", max_rest_s, {1.0, 3600.0}, "what is remembered of a longer one [s]");
  v.number("drive_distance_m", drive_distance_m, {1.0, 1000.0}, "length of the drive that gives the heading [m]");
  v.number("levelling_window_s", levelling_window_s, {0.5, 600.0},
           "length of the window for levelling without a standstill [s]");
  v.number("moving_level_std_deg", moving_level_std_deg, {1e-3, 45.0}, "1σ of roll and pitch levelled on the move [°]");
  v.number("moving_speed_std_mps", moving_speed_std_mps, {1e-3, 10.0},
           "1σ of the velocity when starting on the move [m/s]");
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
      recording_(
          setup.stationary,
          planet.gravity_n({degToRad(params.latitude_deg), degToRad(params.longitude_deg), params.height_m}).norm(),
          params.min_rest_s, params.max_rest_s) {}

void Initializer::reset() {
  recording_.clear();
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
  if (params_.source != "gnss") {
    return recording_.imu().empty() ? "waiting for imu/data" : "levelling";
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
                                 params_.levelling_window_s);
  if (!begin || toSeconds(recording_.imu().back().stamp - *begin) < params_.levelling_window_s) {
    return std::nullopt;
  }
  const Nanoseconds end = *begin + fromSeconds(params_.levelling_window_s);
  const Nanoseconds slack = fromSeconds(setup_.stationary.hold_off_s + setup_.stationary.window_s + 0.5);
  const bool at_rest =
      recording_.rest().begin != 0 && recording_.rest().begin <= *begin + slack && recording_.rest().end + slack >= end;
  InitialState initial =
      levelled(*begin, at_rest ? std::min(end, recording_.rest().end) : end, at_rest, degToRad(params_.heading_deg));
  initial.nav.position = {degToRad(params_.latitude_deg), degToRad(params_.longitude_deg), params_.height_m};
  if (from_truth) {
    initial.nav.position = truth_->position;
  }
  initial.origin = initial.nav.position;
  initial.P(kAttitude + 2, kAttitude + 2) = square(degToRad(params_.heading_std_deg));
  initial.P.diagonal().segment<3>(kPosition).setConstant(square(params_.position_std_m));
  return initial;
}

std::optional<InitialState> Initializer::fromDrive() const {
  const bool rested = recording_.restIsLongEnough();
  if (recording_.imu().size() < 2 || recording_.fixes().empty() || (rested && !recording_.rest().over)) {
    return std::nullopt;
  }
  const std::optional<Nanoseconds> begin = recording_.windowBeginFrom(
      rested ? recording_.rest().begin : recording_.fixes().front().stamp, params_.levelling_window_s);
  const std::optional<PositionFix> start = begin ? startFix(*begin) : std::nullopt;
  const std::optional<PositionFix> end = start ? endFix(*start) : std::nullopt;
  const std::optional<Nanoseconds> until = end ? recording_.firstImuStampFrom(end->stamp) : std::nullopt;
  if (!until || recording_.wheels().empty()) {
    return std::nullopt;
  }
  const bool wheels_known = recording_.wheels().back().stamp >= *until;
  if (!wheels_known && toSeconds(recording_.imu().back().stamp - *until) < setup_.filter.max_wait_s) {
    return std::nullopt;
  }
  const Nanoseconds level_end = rested ? recording_.rest().end : *begin + fromSeconds(params_.levelling_window_s);
  InitialState initial = levelled(*begin, level_end, rested, headingOfDrive(*start, *end, rested));
  initial.nav.position = start->position;
  const Vector3 antenna_n = initial.nav.q_b_to_n * setup_.lever_imu_to_antenna_b;
  ErrorVector lever = ErrorVector::Zero();
  lever.segment<3>(kPosition) = antenna_n;
  subtractError(planet_, lever, initial.nav);
  initial.origin = initial.nav.position;
  initial.P(kAttitude + 2, kAttitude + 2) = square(kDriveHeadingStd_rad);
  initial.P.diagonal().segment<3>(kPosition) = square(kFixStdFactor) * start->variance_ned_m2;
  InitialState result = runFilter(initial, *until);
  result.origin = initial.origin;
  return result;
}

std::optional<PositionFix> Initializer::startFix(Nanoseconds begin) const {
  if (!recording_.restIsLongEnough()) {
    return recording_.fixes().front();
  }
  PositionFix mean;
  double n = 0.0;
  double latitude = 0.0;
  double longitude = 0.0;
  for (const PositionFix& fix : recording_.fixes()) {
    if (fix.stamp < begin || fix.stamp > recording_.rest().end) {
      continue;
    }
    if (n == 0.0) {
      mean = fix;
      mean.position.height_m = 0.0;
    }
    const Geodetic& reference = recording_.fixes().front().position;  // offsets keep the digits
    latitude += fix.position.latitude_rad - reference.latitude_rad;
    longitude += wrapToPi(fix.position.longitude_rad - reference.longitude_rad);
    mean.position.height_m += fix.position.height_m;
    n += 1.0;
  }
  if (n == 0.0) {
    return std::nullopt;
  }
  mean.position = {recording_.fixes().front().position.latitude_rad + latitude / n,
                   wrapToPi(recording_.fixes().front().position.longitude_rad + longitude / n),
                   mean.position.height_m / n};
  mean.stamp = begin;
  return mean;
}

std::optional<PositionFix> Initializer::endFix(const PositionFix& start) const {
  for (const PositionFix& fix : recording_.fixes()) {
    if (fix.stamp > start.stamp &&
        positionDifference(planet_, fix.position, start.position).head<2>().norm() >= params_.drive_distance_m) {
      return fix;
    }
  }
  return std::nullopt;
}

double Initializer::headingOfDrive(const PositionFix& start, const PositionFix& end, bool at_rest) const {
  const double bias_z = at_rest ? recording_.mean(recording_.rest().begin, recording_.rest().end).omega_ib_b.z()
                                : degPerHourToRadps(params_.gyro_bias_deg_per_h.at(2));
  double heading = 0.0;
  Vector2 track = Vector2::Zero();
  for (std::size_t i = 1; i < recording_.imu().size() && recording_.imu()[i].stamp <= end.stamp; ++i) {
    if (recording_.imu()[i].stamp <= start.stamp) {
      continue;
    }
    const double dt_s = toSeconds(recording_.imu()[i].stamp - recording_.imu()[i - 1].stamp);
    heading += dt_s * (recording_.imu()[i].omega_ib_b.z() - bias_z);
    track += dt_s * recording_.speedAt(recording_.imu()[i].stamp) * Vector2(std::cos(heading), std::sin(heading));
  }
  const Vector3 driven = positionDifference(planet_, end.position, start.position);
  return wrapToPi(std::atan2(driven.y(), driven.x()) - std::atan2(track.y(), track.x()));
}

InitialState Initializer::levelled(Nanoseconds begin, Nanoseconds end, bool at_rest, double heading_rad) const {
  InitialState initial;
  initial.nav.stamp = begin;
  initial.nav.accel_bias_b = inBodyAxes(params_.accel_bias_ug, kMicroG);
  initial.nav.gyro_bias_b = inBodyAxes(params_.gyro_bias_deg_per_h, degPerHourToRadps(1.0));
  initial.P = priorCovariance(prior_variance_);
  Vector2 roll_pitch;
  if (at_rest) {
    roll_pitch = levelAtRest(recording_.mean(begin, end).f_ib_b - initial.nav.accel_bias_b);
    initial.P.diagonal().segment<3>(kAttitude).setConstant(square(kLevelStd_rad));
    initial.P.diagonal().segment<3>(kVelocity).setConstant(square(kRestVelocityStd_mps));
  } else {
    std::vector<ImuSample> window;
    std::copy_if(recording_.imu().begin(), recording_.imu().end(), std::back_inserter(window),
                 [begin, end](const ImuSample& s) { return s.stamp >= begin && s.stamp <= end; });
    for (ImuSample& sample : window) {
      sample.f_ib_b -= initial.nav.accel_bias_b;
      sample.omega_ib_b -= initial.nav.gyro_bias_b;
    }
    roll_pitch = levelAtRest(reactionToGravityOnTheMove(window, recording_.speedAt(begin), recording_.speedAt(end)));
    initial.P.diagonal().segment<3>(kAttitude).setConstant(square(degToRad(params_.moving_level_std_deg)));
    initial.P.diagonal().segment<3>(kVelocity).setConstant(square(params_.moving_speed_std_mps));
  }
  initial.nav.q_b_to_n = q_b_to_n_fromEuler(roll_pitch.x(), roll_pitch.y(), heading_rad);
  if (!at_rest) {
    initial.nav.v_eb_n = initial.nav.q_b_to_n * Vector3(recording_.speedAt(begin), 0.0, 0.0);
  }
  return initial;
}

InitialState Initializer::runFilter(const InitialState& start, Nanoseconds until) const {
  Navigator navigator(planet_, imu_params_, setup_);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  for (const PositionFix& fix : recording_.fixes()) {
    if (fix.stamp <= until) {
      navigator.push(fix);
    }
  }
  for (const VelocityFix& fix : recording_.velocityFixes()) {
    if (fix.stamp <= until) {
      navigator.push(fix);
    }
  }
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
  navigator.initialise(start);
  navigator.completeUpTo(until, ignore);
  InitialState result = navigator.filter().snapshot();
  result.origin = start.origin;
  return result;
}

}  // namespace slipnav
