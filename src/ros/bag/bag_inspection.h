#pragma once
/// Recordings as they are, for inspection.

#include <optional>
#include <string>
#include <vector>

#include "config/frames.h"
#include "core/sensors/imu_mount.h"
#include "inspection/recording.h"

namespace slipnav {

/// All files together, as parts of one drive, in the order of their times. Messages that are damaged are left out and
/// named. Throws std::invalid_argument that names a file that is no complete recording of ROS 1.
Recording readRecording(const std::vector<std::string>& paths);

/// The rows of an RTKLIB file (.pos) as a topic of that name; the reading of the file says what is wrong with it.
void addRtklibFile(const std::string& path, Recording& recording);

/// Pose of `child` in `base` by the transforms of a recording, through any number of frames; nothing when they do not
/// connect the two.
std::optional<MountParams> poseByTransforms(const Recording& recording, const std::string& base,
                                            const std::string& child);

}  // namespace slipnav
