#pragma once
/// Which of the topics are those of sensors.

#include <string>
#include <vector>

#include "config/topics.h"

namespace slipnav {

/// What a recording can provide: sensors and truth, but not commands.
std::vector<std::string> sensorTopics(const TopicNames& topics);

}  // namespace slipnav
