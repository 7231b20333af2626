#pragma once
/// Simulated starts: rest and a straight drive under satellite positions, through the initialization alone.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace slipnav::test {

/// A start as the operator is told to do it, on firm ground, with noise that filter and simulator agree on.
Config startConfig(int seed);

struct Start {
  std::optional<InitialState> initial;
  NavigationState truth;          ///< at the stamp of the initial state
  std::string progress;           ///< at the end
  std::vector<std::string> said;  ///< each progress text once, in order
};

/// What a test changes about the samples on their way.
struct Interference {
  double ignore_before_s = 0.0;
  double no_fixes_from_s = std::numeric_limits<double>::infinity();
  double no_fixes_until_s = std::numeric_limits<double>::infinity();
  double velocity_std_mps = 0.0;  ///< of satellite velocities at the rate of the fixes; 0: none
};

Start initialize(const Config& config, const Interference& interference = {});

/// Error of the initial state, and of one of its errors the ratio to its standard deviation.
ErrorVector errorOf(const Start& start);
double sigmas(const Start& start, int index);

}  // namespace slipnav::test
