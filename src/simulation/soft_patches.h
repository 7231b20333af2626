#pragma once
/// Soft patches on firm ground, as a function of the distance.

#include "simulation/random.h"

namespace slipnav::sim {

/// Patches of random length at random distances, with soft edges.
class SoftPatches {
 public:
  /// @param length_m mean length of a patch
  /// @param spacing_m mean length of the ground between two; lengths are uniform between half the mean and 1.5 times it
  SoftPatches(double length_m, double spacing_m, std::uint64_t seed);

  /// 0 on firm ground, 1 in a patch; for a travel that does not decrease between calls.
  double at(double travel_m);

 private:
  double drawLength(double mean_m) { return mean_m * stream_.uniform(0.5, 1.5); }

  double length_m_;
  double spacing_m_;
  RandomStream stream_;
  double begin_m_;  ///< of the current or next patch
  double end_m_;
};

}  // namespace slipnav::sim
