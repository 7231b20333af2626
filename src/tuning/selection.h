#pragma once
/// Knobs that the drives say something about, confirmed on data not used for the choice.

#include <array>
#include <vector>

#include "tuning/gain.h"

namespace slipnav {

/// A gain in log likelihood and how far it may be luck.
struct Gain {
  double value = 0.0;
  double std = 0.0;  ///< 1σ, from how it scatters over the stretches

  /// More stretches, independent of earlier ones.
  void add(const std::vector<double>& stretches);
  bool isBeyond(double sigmas) const { return value > sigmas * std; }
};

/// Knobs to be fitted, and approximately where.
struct Selection {
  std::vector<std::size_t> free;
  Eigen::VectorXd position;
};

/// Adds one knob after the other, largest gain first: each is moved up and down, the direction that one half
/// prefers is judged on the other half, and it is selected if that gain is beyond 2.5σ. Ends when none is.
Selection selectKnobs(GainMeter& meter, const std::array<DriveParts, 2>& halves);

/// Number of runs of each drive that takes, if this many knobs are selected.
std::size_t runsOfSelection(std::size_t knobs, std::size_t taken);

}  // namespace slipnav
