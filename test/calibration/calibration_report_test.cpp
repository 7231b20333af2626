#include "calibration/calibration_report.h"

#include <gtest/gtest.h>

#include "config/yaml_document.h"
#include "config/yaml_reader.h"

namespace slipnav {
namespace {

CalibrationResult fullResult() {
  CalibrationResult result;
  result.left_radius_ratio = Calibrated{1.01, 0.0005};
  result.right_radius_ratio = Calibrated{0.98, 0.0005};
  result.sides_differ = true;
  result.scrub_factor = Calibrated{1.5, 0.01};
  result.track_m = 0.685;
  result.mount_pitch_rad = Calibrated{degToRad(0.2), degToRad(0.01)};
  result.mount_yaw_rad = Calibrated{degToRad(-0.25), degToRad(0.05)};
  result.not_observable = {"roll of the IMU: not visible in any course"};
  return result;
}

Config configFrom(const std::string& yaml) {
  Config config;
  readParameters(parseYaml(yaml, "calibration"), config, "calibration");
  return config;
}

TEST(CalibrationReportTest, whatIsWrittenIsAConfiguration) {
  const Config config = configFrom(calibrationYaml(Config{}, fullResult()));
  ASSERT_EQ(config.wheels.size(), 4U);
  EXPECT_DOUBLE_EQ(config.wheels[0].radius_m, 0.11 * 1.01);
  EXPECT_DOUBLE_EQ(config.wheels[1].radius_m, 0.11 * 0.98);
  EXPECT_DOUBLE_EQ(config.wheels[2].radius_m, 0.11 * 1.01);
  EXPECT_EQ(config.wheels[3].name, "back_right_wheel");
  EXPECT_DOUBLE_EQ(config.wheel.scrub_factor, 1.5);
  EXPECT_NEAR(config.imu.mount.yaw_deg, 0.25, 1e-9);    // URDF counts to the left
  EXPECT_NEAR(config.imu.mount.pitch_deg, -0.2, 1e-9);  // and nose down
}

TEST(CalibrationReportTest, whatIsUnknownStaysAsConfigured) {
  CalibrationResult result = fullResult();
  result.scrub_factor.reset();
  result.mount_pitch_rad.reset();
  result.mount_yaw_rad.reset();
  const std::string yaml = calibrationYaml(Config{}, result);
  EXPECT_EQ(yaml.find("scrub_factor"), std::string::npos);
  EXPECT_EQ(yaml.find("mount"), std::string::npos);
  EXPECT_EQ(configFrom(yaml).wheel.scrub_factor, Config{}.wheel.scrub_factor);
}

TEST(CalibrationReportTest, aRobotsOwnOdometryHasNoRadiiToChange) {
  CalibrationResult result = fullResult();
  result.has_wheel_rates = false;
  result.scrub_factor.reset();
  EXPECT_EQ(calibrationYaml(Config{}, result).find("wheels:"), std::string::npos);
  Config scaled;
  scaled.wheel.odometry_scale = 1.1;
  EXPECT_NEAR(configFrom(calibrationYaml(scaled, result)).wheel.odometry_scale, 1.1 * 1.01, 1e-9);
  EXPECT_NE(calibrationTable(Config{}, result).find("ground over odometry speed             -     1.01000"),
            std::string::npos)
      << calibrationTable(Config{}, result);
}

TEST(CalibrationReportTest, theTableHasEveryQuantityAndReason) {
  const std::string table = calibrationTable(Config{}, fullResult());
  for (const char* line : {"radius front_left_wheel [m]     0.110000    0.111100    0.000055",
                           "scrub factor                      1.0000      1.5000      0.0100",
                           "effective track [m]               0.6850      1.0275      0.0069",
                           "imu.mount.yaw_deg                  0.000       0.250       0.050",
                           "not observable: roll of the IMU: not visible in any course"}) {
    EXPECT_NE(table.find(line), std::string::npos) << line << "\n" << table;
  }
}

}  // namespace
}  // namespace slipnav
