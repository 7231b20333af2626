#pragma once
/// Poses of the sensors from TF.

#include <tf2/buffer_core.h>

#include <string>

#include "config/config.h"

namespace slipnav {

/// Puts the poses of IMU and antenna in `buffer` in place of those of the configuration.
/// @param with_gps whether the antenna is needed
/// @return what is missing ("no transform base_link → imu_link"), "" when all is known; then only, config changes
std::string takeExtrinsics(const tf2::BufferCore& buffer, bool with_gps, Config& config);

}  // namespace slipnav
