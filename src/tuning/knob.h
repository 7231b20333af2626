#pragma once
/// The handful of parameters that a drive without truth can say something about.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "config/config.h"

namespace slipnav {

/// One or several parameters that are moved together, about their configured values.
struct Knob {
  std::string name;               ///< in a few words
  std::vector<std::string> keys;  ///< dotted keys; a factor applies to all of them
  bool is_factor = true;          ///< moves by the natural logarithm of a factor; else by an amount, in the key's unit
  double prior_std = 1.0;         ///< 1σ of the expected change, about 0, in the same terms
  double lower = 0.0;             ///< likewise
  double upper = 0.0;
};

/// All knobs with their bounds about `config`. What the filter never assumes to be less than configured, the data
/// sheet of the IMU, fast slip, sway and heave, moves upwards only. A parameter configured as zero has no knob: zero is
/// intended.
/// @param only keys; if there are any, only the knobs that have one of them. Throws std::invalid_argument for a key
///     that no knob has.
std::vector<Knob> tuningKnobs(const Config& config, const std::vector<std::string>& only = {});

/// The configuration with the knobs moved by `position`, one entry each.
Config withKnobs(const Config& config, const std::vector<Knob>& knobs, const Eigen::VectorXd& position);

/// A configured value moved by a knob: times exp(position), or plus position.
double moved(const Knob& knob, double configured, double position);

}  // namespace slipnav
