#pragma once
/// The paper's error forecast: the filter's covariance propagated ahead with the filter's last matrices (Kilic et al.
/// 2021, section IV-D).
///
/// With Φ, Q and H at the time of the forecast, P₀ = P, and an odometry update every fifth IMU step:
///   P̌ = Φ P̂ Φᵀ + Q,   K = P̌ Hᵀ (H P̌ Hᵀ + R^GP(t))⁻¹,   P̂ = (I − K H) P̌.

#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"

namespace slipnav {

/// IMU steps from one odometry update to the next: 50 Hz and 10 Hz on the paper's rover.
inline constexpr int kImuStepsPerUpdate = 5;

/// What is held fixed.
struct FrozenFilter {
  ErrorTransition transition;  ///< Φ and Q of one IMU step
  Measurement::Jacobian H;     ///< rows: forward speed, heading rate, lateral, vertical (Groves 16.3)
};

/// The filter at an estimate in whose step a wheel interval ended.
/// @param imu_step_s duration of the steps ahead
FrozenFilter freeze(const ErrorDynamics& dynamics, const FilterSetup& setup, const Estimate& estimate,
                    double imu_step_s);

/// R^GP = diag(σ_χ² I₃, 1): the fourth row, that of the vertical speed, has variance 1.
/// @param wheel_speed_variance σ_χ²
Measurement::Vector paperVariance(double wheel_speed_variance);

/// Root of the sum of the north and east variances after each update [m].
/// @param P at the time of the forecast; @param variances diagonal of R^GP at each update
std::vector<double> horizontalStdAhead(const FrozenFilter& frozen, ErrorCovariance P,
                                       const std::vector<Measurement::Vector>& variances);

}  // namespace slipnav
