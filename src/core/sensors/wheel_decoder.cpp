#include "core/sensors/wheel_decoder.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

/// Several drivers may publish to one topic; a wheel missing from this many messages does not exist.
constexpr int kMostOtherJoints = 10;
/// Wheels that have turned this far while all velocities were zero: the velocities are not filled in.
constexpr double kTurnedWithoutVelocity_rad = 0.2;
/// Some drivers compute angles in single precision.
constexpr double kAngleSlack_rad = 1e-3;

/// In quotes, separated by commas.
std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "'" : ", '") + name + "'";
  }
  return list.empty() ? "none" : list;
}

}  // namespace

std::optional<WheelSample> WheelDecoder::decode(const JointArrays& joints) {
  problem_.clear();
  remark_.clear();
  if (isOfOtherJoints(joints) || !locate(joints)) {
    return std::nullopt;
  }
  if (joints.stamp <= seen_.newest - kRestartBackstep) {
    seen_ = Seen();
  }
  seen_.newest = std::max(seen_.newest, joints.stamp);
  const bool has_positions = !joints.position_rad.empty();
  const bool has_velocities = !joints.velocity_radps.empty();
  const std::optional<WheelSample> by_position =
      has_positions || !has_velocities ? fromPositions(joints) : std::nullopt;
  if (!has_velocities || seen_.filled_in) {
    return by_position;
  }
  if (has_positions && !areFinite(joints)) {
    remark_ = seen_.not_finite ? "" : "has velocities that are not finite numbers: positions are used instead";
    seen_.not_finite = true;
    return by_position;
  }
  problem_.clear();  // it is the velocities that count
  const std::optional<WheelSample> rates = pick(joints, joints.velocity_radps, "velocity");
  if (!rates) {
    return std::nullopt;
  }
  return areFilledIn(*rates, by_position) ? by_position : possible(*rates, "turns too fast");
}

/// Wheels that are not among the joints of this message, but have been or may be among those of another.
bool WheelDecoder::isOfOtherJoints(const JointArrays& joints) {
  const auto isNamed = [&joints](const WheelParams& wheel) {
    return wheel.name.empty() || std::find(joints.names.begin(), joints.names.end(), wheel.name) != joints.names.end();
  };
  if (joints.names.empty() || std::any_of(wheels_.begin(), wheels_.end(), isNamed)) {
    return false;
  }
  return !indices_.empty() || ++other_joints_ < kMostOtherJoints;
}

/// Whether all wheels have a velocity that is a number. Arrays of a wrong length are judged elsewhere.
bool WheelDecoder::areFinite(const JointArrays& joints) const {
  return std::all_of(indices_.begin(), indices_.end(), [&joints](std::size_t i) {
    return i >= joints.velocity_radps.size() || std::isfinite(joints.velocity_radps[i]);
  });
}

/// Whether the velocities are always zero while the positions move.
bool WheelDecoder::areFilledIn(const WheelSample& rates, const std::optional<WheelSample>& by_position) {
  const auto isZero = [](double rate) { return rate == 0.0; };
  seen_.velocity = seen_.velocity || !std::all_of(rates.rate_radps.begin(), rates.rate_radps.end(), isZero);
  if (seen_.velocity || !by_position) {
    return false;
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    seen_.turned_rad += std::abs(by_position->rate_radps[i]) * seen_.interval_s / static_cast<double>(wheels_.size());
  }
  seen_.filled_in = seen_.turned_rad > kTurnedWithoutVelocity_rad;
  if (seen_.filled_in) {
    remark_ = "has velocities that are always 0 while the positions move: positions are used instead";
  }
  return seen_.filled_in;
}

bool WheelDecoder::locate(const JointArrays& joints) {
  if (!indices_.empty() && joints.names == names_) {
    return true;
  }
  std::vector<std::size_t> indices;
  for (const WheelParams& wheel : wheels_) {
    const auto found = std::find(joints.names.begin(), joints.names.end(), wheel.name);
    if (joints.names.empty() || wheel.name.empty()) {
      indices.push_back(indices.size());
    } else if (found != joints.names.end()) {
      indices.push_back(static_cast<std::size_t>(found - joints.names.begin()));
    } else {
      problem_ = "has no joint '" + wheel.name + "', but " + listOf(joints.names);
      return false;
    }
  }
  names_ = joints.names;
  indices_ = std::move(indices);
  return true;
}

std::optional<WheelSample> WheelDecoder::pick(const JointArrays& joints, const std::vector<double>& values,
                                              const char* what) {
  const std::size_t wanted = joints.names.empty() ? wheels_.size() : joints.names.size();
  const bool complete = joints.names.empty() ? values.size() >= wanted : values.size() == wanted;
  if (!complete || values.size() <= *std::max_element(indices_.begin(), indices_.end())) {
    problem_ = "has " + std::to_string(values.size()) + " values of " + what + " for " +
               std::to_string(std::max(wanted, wheels_.size())) + " joints";
    return std::nullopt;
  }
  WheelSample sample;
  sample.stamp = joints.stamp;
  sample.count = wheels_.size();
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    sample.rate_radps[i] = wheels_[i].sign * values[indices_[i]];
    if (!std::isfinite(sample.rate_radps[i])) {
      const std::string joint =
          joints.names.empty() ? "wheel " + std::to_string(i) : "joint '" + joints.names[indices_[i]] + "'";
      problem_ = std::string("has a ") + what + " of " + joint + " that is not a finite number";
      return std::nullopt;
    }
  }
  return sample;
}

std::optional<WheelSample> WheelDecoder::fromPositions(const JointArrays& joints) {
  const std::optional<WheelSample> angles = pick(joints, joints.position_rad, "position");
  if (!angles) {
    return std::nullopt;
  }
  const std::optional<WheelSample> before = seen_.angles;
  seen_.angles = angles;
  noteRange(*angles);
  if (!before || angles->stamp <= before->stamp) {
    return std::nullopt;
  }
  seen_.interval_s = toSeconds(angles->stamp - before->stamp);
  WheelSample rates = *angles;
  for (std::size_t i = 0; i < rates.count; ++i) {
    rates.rate_radps[i] = turned(before->rate_radps[i], angles->rate_radps[i]) / seen_.interval_s;
  }
  return possible(rates, "has jumped");
}

void WheelDecoder::noteRange(const WheelSample& angles) {
  for (std::size_t i = 0; i < angles.count; ++i) {
    const double angle_rad = wheels_[i].sign * angles.rate_radps[i];  // as the message has it
    seen_.beyond_minus_pi = seen_.beyond_minus_pi || angle_rad < -kPi - kAngleSlack_rad;
    seen_.beyond_zero = seen_.beyond_zero || angle_rad < -kAngleSlack_rad;
    seen_.beyond_pi = seen_.beyond_pi || angle_rad > kPi + kAngleSlack_rad;
    seen_.beyond_two_pi = seen_.beyond_two_pi || angle_rad > 2.0 * kPi + kAngleSlack_rad;
  }
}

/// From one position to the next [rad], the shorter way where positions wrap.
double WheelDecoder::turned(double from_rad, double to_rad) const {
  const double difference_rad = to_rad - from_rad;
  const bool within_one_turn =
      (!seen_.beyond_minus_pi && !seen_.beyond_pi) || (!seen_.beyond_zero && !seen_.beyond_two_pi);
  return within_one_turn ? std::remainder(difference_rad, 2.0 * kPi) : difference_rad;
}

std::optional<WheelSample> WheelDecoder::possible(const WheelSample& rates, const char* what) {
  for (std::size_t i = 0; i < rates.count; ++i) {
    if (wheels_[i].radius_m * std::abs(rates.rate_radps[i]) > max_speed_mps_) {
      problem_ = "says that " + (wheels_[i].name.empty() ? "wheel " + std::to_string(i) : "'" + wheels_[i].name + "'") +
                 " " + what;
      return std::nullopt;
    }
  }
  return rates;
}

}  // namespace slipnav
