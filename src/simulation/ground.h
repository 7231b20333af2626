#pragma once
/// The available kinds of ground.

#include <initializer_list>
#include <string>

#include "simulation/params.h"
#include "simulation/slip_model.h"
#include "simulation/terrain.h"

namespace slipnav::sim {

/// Speed to which the grounds' vibration refers [m/s].
inline constexpr double kVibrationSpeed_mps = 0.8;

/// One kind of ground: shape, slip, and how it shakes the rover at kVibrationSpeed_mps.
struct GroundParams {
  ReliefParams relief;
  SlipParams slip;
  double vibration_mps2 = 0.0;   ///< 1σ of specific force that passes the IMU's block mean
  double vibration_radps = 0.0;  ///< 1σ of angular rate that passes the IMU's block mean
};

/// "paved", "unpaved", "gravel", "rough", and "rocking": strong roll and pitch without slip, to check mechanizations.
inline constexpr std::initializer_list<const char*> kTerrainNames = {"paved", "unpaved", "gravel", "rough", "rocking"};

/// Throws std::invalid_argument that names an unknown terrain.
GroundParams groundByName(const std::string& name);

/// The same ground with the given changes.
GroundParams changed(GroundParams ground, const GroundChangeParams& change);

}  // namespace slipnav::sim
