#pragma once
/// Longitudinal slip ratio of a wheel (the paper's equation of s, both branches).

#include <optional>

namespace slipnav {

/// s = 1 − v_x/(rω) when driving (v_x < rω), rω/v_x − 1 when braking, in [−1, 1]; the same mirrored in reverse.
/// @param v_x_mps velocity of the wheel center along the vehicle; @param r_omega_mps circumferential speed
/// @param min_speed_mps below this, for both speeds, the ratio is undefined
/// @return nothing where it is undefined or a speed is not finite
std::optional<double> slipRatio(double v_x_mps, double r_omega_mps, double min_speed_mps);

}  // namespace slipnav
