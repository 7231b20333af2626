#pragma once
/// Which knobs the drives say something about that also holds where it was not looked for.

#include <array>
#include <vector>

#include "tuning/gain.h"

namespace slipnav {

/// A gain in log likelihood and how far it may be luck.
struct Gain {
  double value = 0.0;
  double std = 0.0;  ///< 1σ, from how it scatters over the stretches

  /// More stretches, independent of those before.
  void add(const std::vector<double>& stretches);
  bool isBeyond(double sigmas) const { return value > sigmas * std; }
};

/// Knobs that are to be fitted, and about where.
struct Selection {
  std::vector<std::size_t> free;
  Eigen::VectorXd position;
};

/// Adds one knob after the other, the one that gains most first: each is moved up and down, the direction that one half
/// prefers is judged on the other half, and it is taken when that gain is beyond 2.5σ. Ends when none is.
Selection selectKnobs(GainMeter& meter, const std::array<DriveParts, 2>& halves);

/// How many runs of each drive that takes, when so many knobs are taken.
std::size_t runsOfSelection(std::size_t knobs, std::size_t taken);

}  // namespace slipnav
