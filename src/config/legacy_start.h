#pragma once
/// The start that the paper's own software writes: `init_params.yaml`.
///
/// Its keys, each with x, y and z, at the top or inside other blocks: `init_llh`, latitude, longitude [rad] and height
/// [m]; `init_att`, roll, pitch and yaw [rad] of forward-right-down in north-east-down; `init_bias_a` [m/s²] and
/// `init_bias_g` [rad/s], or `mean_bias_a` and `mean_bias_g`, in axes forward-right-down.

#include <string>
#include <vector>

#include "config/override.h"

namespace slipnav {

/// The settings of `initialization` that the file amounts to: its place, heading and biases. Roll and pitch are left to
/// the levelling, which sees the rover as it stands now. Throws std::invalid_argument of one line that names file and
/// key.
std::vector<Override> legacyStart(const std::string& file);

}  // namespace slipnav
