#pragma once
/// Arguments of a tool started by roslaunch.

#include <ros/init.h>

#include "config/command_line.h"

namespace slipnav {

/// Parses a program's arguments with `command_line` after removing those of ROS.
/// Throws like CommandLine::parse().
inline Arguments parseWithoutRosArguments(const CommandLine& command_line, int argc, char** argv) {
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  return command_line.parse({words.begin() + 1, words.end()});
}

}  // namespace slipnav
