#include "slipnav/measurement/wheel_decoder.h"

#include <algorithm>
#include <cmath>

namespace slipnav {

std::optional<WheelSample> WheelDecoder::decode(const JointArrays& joints) {
  problem_.clear();
  if (!locate(joints)) {
    return std::nullopt;
  }
  if (!joints.velocity_radps.empty()) {
    const std::optional<WheelSample> rates = pick(joints, joints.velocity_radps, "velocity");
    return rates ? possible(*rates, "turns too fast") : std::nullopt;
  }
  return fromPositions(joints);
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
      problem_ = "has no joint '" + wheel.name + "'";
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
  const std::optional<WheelSample> before = last_;
  last_ = angles;
  if (!before || angles->stamp <= before->stamp) {
    return std::nullopt;
  }
  WheelSample rates = *angles;
  for (std::size_t i = 0; i < rates.count; ++i) {
    rates.rate_radps[i] = (angles->rate_radps[i] - before->rate_radps[i]) / toSeconds(angles->stamp - before->stamp);
  }
  return possible(rates, "has jumped");
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
