#pragma once
/// The start written by the paper's software: `init_params.yaml`.
///
/// Its keys, each with x, y and z, at the top or inside other blocks: `init_llh`, latitude, longitude [rad] and height
/// [m]; `init_att`, roll, pitch and yaw [rad] of forward-right-down in north-east-down; `init_bias_a` [m/s²] and
/// `init_bias_g` [rad/s], or `mean_bias_a` and `mean_bias_g`, in axes forward-right-down.

#include <string>
#include <vector>

#include "config/override.h"

namespace slipnav {

/// The `initialization` settings equivalent to the file: place, heading and biases. Roll and pitch are left to
/// leveling, which measures the rover's current attitude. Throws std::invalid_argument with one line that names file
/// and key.
std::vector<Override> legacyStart(const std::string& file);

}  // namespace slipnav
