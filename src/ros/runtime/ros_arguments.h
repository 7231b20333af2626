#pragma once
/// Arguments of a tool that roslaunch starts.

#include <ros/init.h>

#include "config/command_line.h"

namespace slipnav {

/// What is left for `command_line` of a program's arguments when those of ROS are taken out.
/// Throws as CommandLine::parse() does.
inline Arguments parseWithoutRosArguments(const CommandLine& command_line, int argc, char** argv) {
  ros::V_string words;
  ros::removeROSArgs(argc, argv, words);
  return command_line.parse({words.begin() + 1, words.end()});
}

}  // namespace slipnav
