#pragma once
/// Poses of the sensors from TF.

#include <tf2/buffer_core.h>

#include <string>

#include "config/config.h"

namespace slipnav {

/// Replaces the poses of IMU and antenna in the configuration by those in `buffer`.
/// @param with_gps whether the antenna is needed
/// @return what is missing ("no transform base_link → imu_link"), "" if all is known; only then, config changes
std::string takeExtrinsics(const tf2::BufferCore& buffer, bool with_gps, Config& config);

}  // namespace slipnav
