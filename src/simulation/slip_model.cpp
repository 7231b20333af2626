#include "simulation/slip_model.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/base/types.h"

namespace slipnav::sim {
namespace {

constexpr double kFastCorrelation_m = 1.0;   // 1.25 s at 0.8 m/s
constexpr double kSlowCorrelation_m = 12.0;  // 15 s at 0.8 m/s
constexpr double kWheelCorrelation_m = 0.5;
constexpr double kLateralCorrelation_m = 6.0;
constexpr double kTrackCorrelation_m = 4.0;
constexpr double kStoneCorrelation_m = 0.3;  // of sway and heave
/// Fraction of the fast slip's variance that both sides share.
constexpr double kSharedFast = 0.7;

constexpr double kSideImpulses = 0.35;       // fraction of the impulses that affect one side,
constexpr double kWheelImpulses = 0.3;       // and one wheel; the rest take all four
constexpr double kImpulseMinLength_m = 0.3;  // 0.4 s at 0.8 m/s
constexpr double kImpulseMaxLength_m = 1.6;  // 2 s at 0.8 m/s
constexpr double kOtherSideShare = 0.6;      // a side that loses grip drags the whole rigid body
constexpr double kWheelBodyShare = 0.3;      // one wheel of four loses grip: its side loses some speed, ...
constexpr double kWheelSpinShare = 0.4;      // ... and the unloaded wheel runs ahead of its command

/// No more than this fraction of the speed is lost, approached smoothly.
constexpr double kMaxLoss = 0.9;

double limited(double loss) {
  const double r2 = (loss / kMaxLoss) * (loss / kMaxLoss);
  return loss / std::sqrt(std::sqrt(1.0 + r2 * r2));
}

std::vector<CorrelatedProcess> wheelProcesses(std::uint64_t seed) {
  return {{seed, "wheel front left", kWheelCorrelation_m},
          {seed, "wheel front right", kWheelCorrelation_m},
          {seed, "wheel back left", kWheelCorrelation_m},
          {seed, "wheel back right", kWheelCorrelation_m}};
}

}  // namespace

SlipModel::SlipModel(const SlipParams& params, std::uint64_t seed)
    : params_(params),
      mean_(params.mean * (1.0 + params.mean_spread * RandomStream(seed, "slip mean").normal()) + params.offset),
      fast_left_(seed, "slip fast left", kFastCorrelation_m),
      fast_right_(seed, "slip fast right", kFastCorrelation_m),
      fast_both_(seed, "slip fast both", kFastCorrelation_m),
      slow_both_(seed, "slip slow both", kSlowCorrelation_m),
      lateral_(seed, "side slip", kLateralCorrelation_m),
      track_(seed, "track factor", kTrackCorrelation_m),
      sway_(seed, "sway", kStoneCorrelation_m),
      heave_(seed, "heave", kStoneCorrelation_m),
      turning_point_(seed, "turn centre", kTrackCorrelation_m),
      wheel_(wheelProcesses(seed)),
      patches_(params.patch_length_m, params.patch_spacing_m, seed),
      impulse_stream_(seed, "slip impulses"),
      next_impulse_m_(0.0) {
  next_impulse_m_ -= std::log(1.0 - impulse_stream_.uniform()) / std::max(params_.impulses_per_m, 1e-12);
}

SlipModel::Impulse SlipModel::drawImpulse() {
  Impulse impulse{next_impulse_m_,
                  impulse_stream_.uniform(kImpulseMinLength_m, kImpulseMaxLength_m),
                  impulse_stream_.uniform(params_.impulse_min, params_.impulse_max),
                  1.0,
                  1.0,
                  {}};
  const double kind = impulse_stream_.uniform();
  const auto wheel = static_cast<std::size_t>(static_cast<double>(kWheelCount) * impulse_stream_.uniform());
  const bool left = wheel % 2 == 0;
  if (kind < kSideImpulses) {
    (left ? impulse.right_share : impulse.left_share) = kOtherSideShare;
  } else if (kind < kSideImpulses + kWheelImpulses) {
    impulse.left_share = left ? kWheelBodyShare : kWheelBodyShare * kOtherSideShare;
    impulse.right_share = left ? kWheelBodyShare * kOtherSideShare : kWheelBodyShare;
    impulse.spin_share[wheel] = kWheelSpinShare;
  }
  next_impulse_m_ -= std::log(1.0 - impulse_stream_.uniform()) / params_.impulses_per_m;
  return impulse;
}

void SlipModel::addImpulses(double travel_m, Slippage& slippage) {
  while (next_impulse_m_ <= travel_m) {
    active_.push_back(drawImpulse());
  }
  const auto over = [&](const Impulse& impulse) { return travel_m >= impulse.start_m + impulse.length_m; };
  active_.erase(std::remove_if(active_.begin(), active_.end(), over), active_.end());
  for (const Impulse& impulse : active_) {
    const double sine = std::sin(kPi * (travel_m - impulse.start_m) / impulse.length_m);
    const double height = impulse.peak * sine * sine;
    slippage.left += height * impulse.left_share;
    slippage.right += height * impulse.right_share;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      slippage.spin_up[i] += height * impulse.spin_share[i];
    }
  }
}

Slippage SlipModel::at(const Footing& footing) {
  const double travel_m = footing.travel_m;
  Slippage slippage;
  addImpulses(travel_m, slippage);
  const double both = mean_ + footing.sin_climb * (params_.climb + params_.sinkage * footing.sin_climb) +
                      params_.slow * slow_both_.at(travel_m) +
                      params_.fast * std::sqrt(kSharedFast) * fast_both_.at(travel_m) +
                      (params_.patch > 0.0 ? params_.patch * patches_.at(travel_m) : 0.0);
  const double side = params_.fast * std::sqrt(1.0 - kSharedFast);
  slippage.left = footing.looseness * limited(slippage.left + both + side * fast_left_.at(travel_m));
  slippage.right = footing.looseness * limited(slippage.right + both + side * fast_right_.at(travel_m));
  slippage.lateral = footing.looseness * std::tan(degToRad(params_.side_slip_deg) * lateral_.at(travel_m) +
                                                  params_.side_slip_per_slope * footing.sin_cross) +
                     footing.looseness * params_.sway_m * sway_.slopeAt(travel_m);
  slippage.turning_point_m =
      params_.turning_point_m + footing.looseness * params_.turning_point_std_m * turning_point_.at(travel_m);
  slippage.heave_m = params_.heave_m * heave_.at(travel_m);
  slippage.heave_slope = params_.heave_m * heave_.slopeAt(travel_m);
  slippage.track_factor = params_.track_factor + params_.track_factor_spread * track_.at(travel_m);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    slippage.spin_up[i] = footing.looseness * (slippage.spin_up[i] + params_.wheel_scatter * wheel_[i].at(travel_m));
  }
  return slippage;
}

}  // namespace slipnav::sim
