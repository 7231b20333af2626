#include "ros/bag/bag_calibration.h"

#include <stdexcept>
#include <utility>

#include "io/rtklib_pos.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {
namespace {

/// A calibration has other requirements on a bag than the configured start and updates.
Config forCalibration(Config config) {
  config.initialization.source = "given";
  config.filter.updates = FilterParams{}.updates;
  return config;
}

/// Truth in its own frame, placed about the configured start: north matters only for the planet's rotation.
PositionFix toFix(const TruthSample& sample, const LocalFrame& frame) {
  PositionFix fix;
  fix.stamp = sample.stamp;
  fix.position = frame.toGeodetic(sample.position_enu_m);
  const Matrix3 C_n_to_enu = frame.C_n_to_enu(fix.position);
  fix.variance_ned_m2 = (C_n_to_enu.transpose() * sample.covariance_enu_m2 * C_n_to_enu).diagonal();
  return fix;
}

CalibrationDrive readDrive(const BagReader& reader, bool with_truth) {
  const InitializationParams& start = reader.config().initialization;
  const LocalFrame frame(Planet::byName(reader.config().planet),
                         {degToRad(start.latitude_deg), degToRad(start.longitude_deg), start.height_m});
  CalibrationDrive drive;
  BagSink sink;
  sink.imu = [&drive](const ImuSample& sample) { drive.imu.push_back(sample); };
  sink.wheels = [&drive](const WheelMotion& wheels) { drive.wheels.push_back(wheels); };
  sink.fix = [](const GnssFix&) {};
  sink.velocity = [](const VelocityFix&) {};
  sink.truth_start = [](const NavigationState&, bool) {};
  sink.truth_fix = [&drive, with_truth](const GnssFix& fix) {
    if (with_truth) {
      drive.truth.push_back(toPositionFix(fix));
    }
  };
  sink.truth_pose = [&drive, &frame, with_truth](const TruthSample& sample) {
    if (with_truth) {
      drive.truth.push_back(toFix(sample, frame));
    }
  };
  sink.problem = [](const std::string&, Nanoseconds) {};
  reader.read(sink);
  return drive;
}

}  // namespace

BagCalibration calibrateBag(const std::string& path, const Config& config, const std::string& truth,
                            const BagRange& range) {
  const bool truth_from_file = isRtklibFile(truth);
  const BagReader reader(path, forCalibration(config), truth_from_file ? "" : truth, range);
  CalibrationDrive drive = readDrive(reader, !truth_from_file);
  if (truth_from_file) {
    for (const RtklibSolution& solution : readRtklibPos(truth)) {
      if (!solution.solved()) {
        continue;
      }
      drive.truth.push_back(toPositionFix(solution.fix));
      drive.truth.back().stamp += fromSeconds(config.truth.stamp_offset_s);
    }
  }
  if (drive.truth.empty()) {
    throw std::invalid_argument(path + ": has no truth; calibration needs topic '" + config.topics.truth_fix +
                                "', another one by --truth, or an RTKLIB file");
  }
  try {
    return {reader.config(), calibrate(reader.config(), std::move(drive))};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

}  // namespace slipnav
