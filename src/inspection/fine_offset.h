#pragma once
/// The offset of two clocks to a small part of a sample, once it is known roughly.

#include <optional>

#include "inspection/motion_table.h"

namespace slipnav {

/// An offset and its 1σ.
struct FineOffset {
  double wheels_ahead_s = 0.0;
  double std_s = 0.0;
};

/// Correlates heading rates, or accelerations, over the very intervals of the wheels, shifted by hundredths of a
/// second. The scatter is that of the offset when one tenth of the drive after the other is omitted (jackknife).
/// @param up direction of the mean specific force in the sensor's axes
/// @param roughly_s offset to within a tenth of a second; @param by_turns heading rates; else accelerations
/// @return nothing where the correlation has no maximum nearby
std::optional<FineOffset> fineOffset(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up, double roughly_s,
                                     bool by_turns);

}  // namespace slipnav
