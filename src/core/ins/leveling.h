#pragma once
/// Roll and pitch from the direction of the specific force (Groves 5.6.2), at rest or on the move.

#include <vector>

#include "slipnav/core/base/sensors.h"

namespace slipnav {

/// Roll and pitch of a body at rest from its mean specific force f_ib^b.
/// @return roll, pitch [rad]
Vector2 levelAtRest(const Vector3& f);

/// Direction of gravity's reaction at the start of a drive, in the body axes of that instant.
///
/// The specific force, rotated back to the first attitude by the gyros and averaged, is the mean acceleration less
/// gravity; the mean acceleration is the change of velocity, known from the wheels.
/// @param samples consecutive samples, the first one only gives the start; at least two
/// @param first_speed_mps, last_speed_mps forward speed at either end
/// @return mean specific force free of motion, body axes at the first sample's stamp [m/s²]
Vector3 reactionToGravityOnTheMove(const std::vector<ImuSample>& samples, double first_speed_mps,
                                   double last_speed_mps);

}  // namespace slipnav
