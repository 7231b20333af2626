#include "config/config.h"

#include <iostream>
#include <stdexcept>
#include <utility>

#include "config/legacy_start.h"
#include "config/renamed_keys.h"
#include "config/yaml_document.h"
#include "config/yaml_reader.h"

namespace slipnav {
namespace {

/// Merges a document into what has been read so far. It is first read separately, so that errors name its location.
void mergeChecked(YAML::Node document, const std::string& source, YAML::Node& merged,
                  std::vector<std::string>& warnings) {
  for (std::string& warning : renameFormerKeys(document, source)) {
    warnings.push_back(std::move(warning));
  }
  Config scratch;
  readParameters(document, scratch, source);
  merged.reset(mergeYaml(merged, document));
}

/// The paper's forecast and the sliding one each have settings that belong to one only or would break the other.
void requireOneMethod(const ForecastParams& forecast, const StopParams& stop) {
  const bool paper = forecast.schedule == "paper";
  if (!paper && forecast.sigma_points.form != "unscented") {
    throw std::invalid_argument("'forecast.sigma_points.form: " + forecast.sigma_points.form +
                                "' needs 'forecast.schedule: paper'");
  }
  if (paper && forecast.bound != "absolute") {
    throw std::invalid_argument("'forecast.schedule: paper' contradicts 'forecast.bound: " + forecast.bound +
                                "', it needs 'absolute'; config/paper.yaml has all that belongs to it");
  }
  if (paper && stop.forecast_timeout_s <= forecast.window_s) {
    throw std::invalid_argument(
        "'forecast.schedule: paper' contradicts 'stop.forecast_timeout_s', which must be above 'forecast.window_s': "
        "before the first forecast stops would become periodic");
  }
}

/// An override has a name, but no lines that an error could refer to.
void mergeOverride(const Override& item, YAML::Node& merged, std::vector<std::string>& warnings) {
  try {
    mergeChecked(toYamlNode(item), "", merged, warnings);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(item.source + ": " + error.what());
  }
}

}  // namespace

void ImuConfig::visit(ParameterVisitor& v) {
  v.group("noise", noise, "as in the data sheet");
  v.group("input", input, "how samples are taken and checked");
  v.group("mount", mount, "where the sensor is");
}

void Config::visit(ParameterVisitor& v) {
  v.choice("planet", planet, {"earth", "mars", "moon"}, "whose ellipsoid, gravity and rotation apply");
  v.group("topics", topics, "what the robot or the recording calls each topic");
  v.group("frames", frames, "coordinate frames");
  v.group("imu", imu, "the inertial sensor");
  v.group("gps_mount", gps_mount, "where the antenna of gps/fix is");
  v.group("truth_mount", truth_mount, "where the point tracked by the truth topics is");
  v.group("truth", truth, "how truth is aligned with the estimate");
  v.list("wheels", wheels, "driven wheels, in the order of slip messages");
  v.group("wheel", wheel, "wheel speeds: source, timing and noise");
  v.group("wheel_monitor", wheel_monitor, "when a wheel is considered faulty");
  v.group("vehicle", vehicle, "how vehicle and ground behave between measurements");
  v.group("nonholonomic", nonholonomic, "non-holonomic constraints: noise and averaging");
  v.group("zero_motion", zero_motion, "zero-velocity and zero-rate updates: noise");
  v.group("stationary", stationary, "when the rover counts as standing still");
  v.group("gnss", gnss, "what satellite positions are used for");
  v.group("filter", filter, "error-state Kalman filter");
  v.group("initialization", initialization, "how the start is found");
  v.group("checkpoint", checkpoint, "resuming after a crash");
  v.group("forecast", forecast, "how slip and position error are forecast");
  v.group("overlay", overlay, "what rviz shows of a drive");
  v.group("stop", stop, "when the rover stops for a zero update, and how");
  v.group("calibration", calibration, "how radii, scrub and IMU mounting are found from a drive with truth");
  v.group("simulator", simulator, "the simulated rover, its ground and its sensors");
}

NavigationSetup Config::navigation() const {
  NavigationSetup setup;
  setup.imu_input = imu.input;
  setup.initialization = initialization;
  setup.filter.filter = filter;
  setup.filter.imu = imu.noise;
  setup.filter.vehicle = vehicle;
  setup.filter.wheel = wheel;
  setup.filter.nonholonomic = nonholonomic;
  setup.filter.zero = zero_motion;
  setup.filter.stationary = stationary;
  setup.filter.wheel_monitor = wheel_monitor;
  setup.filter.gnss = gnss;
  setup.filter.wheels = wheels;
  setup.filter.lever_imu_to_reference_b = -imu.mount.position_b();
  setup.filter.lever_imu_to_antenna_b = gps_mount.position_b() - imu.mount.position_b();
  return setup;
}

void Config::requireConsistent() const {
  if (zero_motion.min_velocity_std_mps > zero_motion.max_velocity_std_mps) {
    throw std::invalid_argument(
        "'zero_motion.min_velocity_std_mps' must not be above 'zero_motion.max_velocity_std_mps'");
  }
  if (gnss.always() && topics.gps_fix == topics.truth_fix) {
    throw std::invalid_argument("'topics.gps/fix' and 'topics.truth/fix' must differ with 'gnss.use: always'");
  }
  if (forecast.horizon_s < forecast.step_s) {
    throw std::invalid_argument("'forecast.horizon_s' must not be below 'forecast.step_s'");
  }
  requireOneMethod(forecast, stop);
}

Config Config::load(const std::vector<std::string>& yaml_files, const std::vector<Override>& overrides) {
  Config config;
  YAML::Node merged(YAML::NodeType::Map);
  for (const std::string& file : yaml_files) {
    mergeChecked(loadYamlFile(file), file, merged, config.warnings);
  }
  for (const Override& item : overrides) {
    mergeOverride(item, merged, config.warnings);
  }
  readParameters(merged, config);
  config.requireConsistent();
  return config;
}

void declareConfigOptions(CommandLine& command_line) {
  command_line.repeated("config", "YAML", "configuration file; later ones win")
      .repeated("legacy-start", "YAML", "init_params.yaml of the paper's software: start, heading and biases")
      .repeated("topic", "NAME:=OTHER", "what the robot or the recording calls a topic")
      .repeated("set", "BLOCK.KEY=VALUE", "one setting, overriding the files");
}

Config configFromOptions(const Arguments& arguments, std::vector<std::string> first) {
  std::vector<Override> overrides;
  for (const std::string& file : arguments.all("legacy-start")) {
    const std::vector<Override> start = legacyStart(file);
    overrides.insert(overrides.end(), start.begin(), start.end());
  }
  for (const std::string& argument : arguments.all("topic")) {
    overrides.push_back(topicOverride(argument));
  }
  for (const std::string& argument : arguments.all("set")) {
    overrides.push_back(keyOverride(argument));
  }
  const std::vector<std::string>& given = arguments.all("config");
  first.insert(first.end(), given.begin(), given.end());
  Config config = Config::load(first, overrides);
  for (const std::string& warning : config.warnings) {
    std::cerr << warning << '\n';
  }
  return config;
}

}  // namespace slipnav
