#pragma once
/// Everything a user can configure, and where it is read.

#include <string>
#include <vector>

#include "config/calibration_params.h"
#include "config/command_line.h"
#include "config/frames.h"
#include "config/overlay_params.h"
#include "config/override.h"
#include "config/topics.h"
#include "config/truth_params.h"
#include "core/forecast/forecast_params.h"
#include "core/navigation/checkpoint.h"
#include "core/sensors/imu_mount.h"
#include "core/stopping/stop_params.h"
#include "simulation/params.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/navigation/pipeline.h"
#include "slipnav/core/parameters/parameter_visitor.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// The inertial sensor: noise, mounting and how its samples are taken.
struct ImuConfig {
  ImuNoiseParams noise;
  ImuInputParams input;
  MountParams mount;
  void visit(ParameterVisitor& v);
};

/// All parameters, block by block; meaning, unit and range of each are in the visit() of its block.
struct Config {
  std::string planet = "earth";
  TopicNames topics;
  FrameNames frames;
  ImuConfig imu;
  MountParams gps_mount;
  MountParams truth_mount;
  TruthParams truth;
  std::vector<WheelParams> wheels = pathfinderWheels();
  WheelOdometryParams wheel;
  WheelMonitorParams wheel_monitor;
  VehicleModelParams vehicle;
  NonholonomicParams nonholonomic;
  ZeroMotionParams zero_motion;
  StationaryParams stationary;
  FixParams gnss;
  FilterParams filter;
  InitializationParams initialization;
  CheckpointParams checkpoint;
  ForecastParams forecast;
  StopParams stop;
  OverlayParams overlay;
  CalibrationParams calibration;
  sim::SimulatorParams simulator;

  std::vector<std::string> warnings;  ///< lines for the user: keys that have been renamed

  void visit(ParameterVisitor& v);

  /// The parameters of mechanization, filter and initialization.
  NavigationSetup navigation() const;
  WheelGeometry wheelGeometry() const { return {wheels, wheel.scrub_factor}; }

  /// Throws std::invalid_argument with one line if values that are each in range contradict each other.
  void requireConsistent() const;

  /// Reads YAML files over the defaults: blocks are merged, of a value or list given twice the later one wins; then the
  /// overrides in order. Throws std::invalid_argument with one line that names the file or override, the key and
  /// what is wrong.
  static Config load(const std::vector<std::string>& yaml_files, const std::vector<Override>& overrides = {});
};

/// Declares the options that every executable with a configuration shares: --config, --topic, --set.
void declareConfigOptions(CommandLine& command_line);

/// The configuration selected by those options. Throws std::invalid_argument, see Config::load().
/// @param first files that come before those of the options
Config configFromOptions(const Arguments& arguments, std::vector<std::string> first = {});

}  // namespace slipnav
