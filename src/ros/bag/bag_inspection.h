#pragma once
/// Unprocessed recordings, for inspection.

#include <optional>
#include <string>
#include <vector>

#include "config/frames.h"
#include "core/sensors/imu_mount.h"
#include "inspection/recording.h"

namespace slipnav {

/// All files together, as parts of one drive, in chronological order. Damaged messages are skipped and
/// reported. Throws std::invalid_argument that names a file that is not a complete ROS 1 recording.
Recording readRecording(const std::vector<std::string>& paths);

/// The rows of an RTKLIB file (.pos) as a topic of that name; reading the file reports what is wrong with it.
void addRtklibFile(const std::string& path, Recording& recording);

/// Pose of `child` in `base` from the transforms of a recording, through any number of frames; nothing if they do not
/// connect the two.
std::optional<MountParams> poseByTransforms(const Recording& recording, const std::string& base,
                                            const std::string& child);

}  // namespace slipnav
