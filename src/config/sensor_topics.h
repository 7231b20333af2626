#pragma once
/// Which of the names at the boundary are those of sensors.

#include <string>
#include <vector>

#include "config/topics.h"

namespace slipnav {

/// What a recording has to offer: sensors and truth. Commands are none.
std::vector<std::string> sensorTopics(const TopicNames& topics);

}  // namespace slipnav
