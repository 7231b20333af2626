#pragma once
/// How the ground yields under the wheels.

#include <vector>

#include "simulation/correlated_process.h"
#include "simulation/random.h"
#include "simulation/soft_patches.h"
#include "simulation/truth_state.h"

namespace slipnav::sim {

/// Slip of one kind of ground. Ratios are fractions of the wheel surface speed.
struct SlipParams {
  double mean = 0.0;           ///< persistent part on the level
  double mean_spread = 0.0;    ///< 1σ between drives, relative to `mean`
  double climb = 0.0;          ///< per sine of the slope along the track: positive uphill, negative downhill
  double sinkage = 0.0;        ///< per squared sine of the slope along the track: both ways
  double fast = 0.0;           ///< 1σ of the part with a correlation of about a second
  double slow = 0.0;           ///< 1σ of the part with a correlation of about fifteen seconds
  double wheel_scatter = 0.0;  ///< 1σ of each wheel's own speed
  double impulses_per_m = 0.0;
  double impulse_min = 0.0;  ///< peak of an impulse
  double impulse_max = 0.0;
  double side_slip_deg = 0.0;        ///< 1σ of the correlated slip angle
  double side_slip_per_slope = 0.0;  ///< slip angle [rad] per sine of the cross slope
  double sway_m = 0.0;               ///< 1σ of the sideways offset while wheels climb over and between stones
  double heave_m = 0.0;              ///< 1σ of the body's height over the smooth relief, likewise
  double turning_point_m = 0.0;      ///< ahead of base_link: the point that does not move sideways in a turn; mean
  double turning_point_std_m = 0.0;  ///< 1σ along the path
  double track_factor = 1.0;         ///< effective over geometric track when the rover turns (scrub)
  double track_factor_spread = 0.0;  ///< 1σ along the path
  double offset = 0.0;               ///< additional persistent part, the same in every drive
  double patch = 0.0;                ///< additional slip in soft patches
  double patch_length_m = 3.0;       ///< mean
  double patch_spacing_m = 10.0;     ///< mean distance between two patches
};

/// Where the rover is, as far as slip is concerned.
struct Footing {
  double travel_m = 0.0;   ///< of the wheels' surface, never decreasing
  double sin_climb = 0.0;  ///< sine of the slope in the direction of motion, positive uphill
  double sin_cross = 0.0;  ///< sine of the slope across, positive when the right side is low
  double looseness = 0.0;  ///< factor on all slip
};

/// Effect of the ground on the commanded motion.
struct Slippage {
  double left = 0.0;  ///< fraction of the left wheels' surface speed by which that side falls behind
  double right = 0.0;
  double lateral = 0.0;          ///< sideways over forward speed, positive to the right
  double turning_point_m = 0.0;  ///< ahead of base_link: the point that does not move sideways in a turn
  double heave_m = 0.0;          ///< of the body over the smooth relief
  double heave_slope = 0.0;      ///< its derivative with respect to the travel
  double track_factor = 1.0;
  PerWheel spin_up = {};  ///< excess of each wheel's speed over its command, relative
};

/// Random functions of the travel, drawn as it grows.
class SlipModel {
 public:
  SlipModel(const SlipParams& params, std::uint64_t seed);

  /// For a travel that does not decrease between calls.
  Slippage at(const Footing& footing);

 private:
  /// One short loss of grip. Shares: how much of the peak each side of the body feels, how much each wheel spins up.
  struct Impulse {
    double start_m;
    double length_m;
    double peak;
    double left_share;
    double right_share;
    PerWheel spin_share;
  };
  Impulse drawImpulse();
  void addImpulses(double travel_m, Slippage& slippage);

  SlipParams params_;
  double mean_;
  CorrelatedProcess fast_left_, fast_right_, fast_both_, slow_both_, lateral_, track_, sway_, heave_, turning_point_;
  std::vector<CorrelatedProcess> wheel_;
  SoftPatches patches_;
  RandomStream impulse_stream_;
  double next_impulse_m_;
  std::vector<Impulse> active_;
};

}  // namespace slipnav::sim
