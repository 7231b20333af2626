# Language level, optimization, warnings and sanitizers of this package's own targets.
#
# Results must be equal bit for bit across machines and builds. Hence no -march=native, no -ffast-math, and no fused
# multiply-add that the compiler would otherwise form wherever the target has one.
#
# Headers of others that most sources need are compiled once for each target of many files: a
# build then takes half the time.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
# -O3 makes nothing here faster.
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

set(SLIPNAV_COMMON_HEADERS
  <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
  <algorithm> <array> <cmath> <fstream> <functional> <limits> <map> <memory> <optional> <sstream> <stdexcept> <string>
  <utility> <vector>)
set(SLIPNAV_ROS_HEADERS
  <ros/ros.h> <diagnostic_msgs/DiagnosticArray.h> <diagnostic_updater/diagnostic_updater.h>
  <dynamic_reconfigure/Reconfigure.h> <geometry_msgs/Twist.h> <nav_msgs/Odometry.h> <nodelet/nodelet.h>
  <sensor_msgs/Imu.h> <sensor_msgs/JointState.h> <sensor_msgs/NavSatFix.h> <tf2_ros/buffer.h>
  <tf2_ros/transform_listener.h> <visualization_msgs/MarkerArray.h>)

find_program(SLIPNAV_CCACHE ccache)
if(SLIPNAV_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this, ccache does not cache anything compiled with a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros "${SLIPNAV_CCACHE}")
endif()

if(SLIPNAV_CLANG_TIDY)
  find_program(SLIPNAV_CLANG_TIDY_PROGRAM clang-tidy)
  if(NOT SLIPNAV_CLANG_TIDY_PROGRAM)
    message(FATAL_ERROR "slipnav: SLIPNAV_CLANG_TIDY is on, but clang-tidy was not found")
  endif()
endif()

# Applies the above to one target of this package, and shows it the headers that are not installed.
function(slipnav_configure_target target)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(SLIPNAV_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SLIPNAV_SANITIZE)
    # GCC mistakes the sanitizers' own code for uninitialized use, above all in Eigen.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
      -fsanitize=${SLIPNAV_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${SLIPNAV_SANITIZE})
  endif()
  if(SLIPNAV_CLANG_TIDY)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${SLIPNAV_CLANG_TIDY_PROGRAM};--quiet")
  endif()
endfunction()

# A shared library with undefined symbols does not link. Sanitizers leave their own symbols undefined.
function(slipnav_refuse_undefined_symbols target)
  if(NOT SLIPNAV_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
endfunction()
