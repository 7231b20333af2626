#include "simulation/body_motion.h"

#include "slipnav/core/base/types.h"

namespace slipnav::sim {
namespace {

/// Below this, in meters and radians per second, a body at rest stops swinging.
constexpr double kHoldRate = 2e-4;

}  // namespace

BodyMotion::BodyMotion(const BodyParams& params, std::uint64_t seed)
    : sigma_(params.heave_m, params.sway_m, degToRad(params.pitch_deg), degToRad(params.roll_deg)),
      rocks_(params.rocks()),
      spring_radps_(2.0 * kPi * params.frequency_hz),
      damping_ratio_(params.damping_ratio),
      stones_{{seed, "body heave", params.stone_m},
              {seed, "body sway", params.stone_m},
              {seed, "body pitch", params.stone_m},
              {seed, "body roll", params.stone_m}} {}

BodyVector BodyMotion::stones(double travel_m) {
  BodyVector place;
  for (Eigen::Index i = 0; i < kBodyAxes; ++i) {
    place[i] = sigma_[i] * stones_[static_cast<std::size_t>(i)].at(travel_m);
  }
  return place;
}

BodyVector BodyMotion::stoneSlopes(double travel_m) {
  BodyVector slope;
  for (Eigen::Index i = 0; i < kBodyAxes; ++i) {
    slope[i] = sigma_[i] * stones_[static_cast<std::size_t>(i)].slopeAt(travel_m);
  }
  return slope;
}

BodyVector BodyMotion::acceleration(const BodyVector& offset, const BodyVector& offset_rate) const {
  return spring_radps_ * (spring_radps_ * offset + 2.0 * damping_ratio_ * offset_rate);
}

bool BodyMotion::holds(const BodyVector& offset, const BodyVector& rate) const {
  return (spring_radps_ * offset).cwiseAbs().maxCoeff() + rate.cwiseAbs().maxCoeff() < kHoldRate;
}

}  // namespace slipnav::sim
