#include "config/legacy_start.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "config/config.h"

namespace slipnav {
namespace {

class LegacyStart : public ::testing::Test {
 protected:
  ~LegacyStart() override { std::remove(file_.c_str()); }

  Config read(const std::string& text) {
    std::ofstream(file_) << text;
    return Config::load({}, legacyStart(file_));
  }

  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  std::string file_ = ::testing::TempDir() + "/slipnav_init_params.yaml";
};

TEST_F(LegacyStart, IsReadInItsUnits) {
  const Config config = read(
      "init_llh: {x: 0.6920, y: -1.3946, z: 285.5}\n"
      "init_ecef: {x: 859000.0, y: -4842000.0, z: 4048000.0}\n"
      "init_att: {x: 0.01, y: -0.02, z: -1.5707963267948966}\n"
      "init_bias_a: {x: 0.0, y: 9.80665e-3, z: -9.80665e-4}\n"
      "init_bias_g: {x: 4.84813681109536e-6, y: 0.0, z: 0.0}\n");
  EXPECT_EQ(config.initialization.source, "given");
  EXPECT_NEAR(config.initialization.latitude_deg, 0.6920 * 180.0 / kPi, 1e-12);
  EXPECT_NEAR(config.initialization.longitude_deg, -1.3946 * 180.0 / kPi, 1e-12);
  EXPECT_EQ(config.initialization.height_m, 285.5);
  EXPECT_NEAR(config.initialization.heading_deg, -90.0, 1e-12);
  EXPECT_NEAR(config.initialization.accel_bias_ug[1], 1000.0, 1e-9);
  EXPECT_NEAR(config.initialization.accel_bias_ug[2], -100.0, 1e-9);
  EXPECT_NEAR(config.initialization.gyro_bias_deg_per_h[0], 1.0, 1e-9);
}

TEST_F(LegacyStart, MayStandInsideOtherBlocksWithoutBiases) {
  const Config config = read(
      "core_nav: {core_nav: {init_llh: {x: 0.5, y: 0.25, z: 1}, init_att: {x: 0, y: 0, z: 7.0}},"
      " mean_bias_g: {x: 0, y: 0, z: 4.84813681109536e-6}}\n");
  EXPECT_NEAR(config.initialization.latitude_deg, 0.5 * 180.0 / kPi, 1e-12);
  EXPECT_NEAR(config.initialization.heading_deg, 7.0 * 180.0 / kPi - 360.0, 1e-9);
  EXPECT_NEAR(config.initialization.gyro_bias_deg_per_h[2], 1.0, 1e-9);
  EXPECT_EQ(config.initialization.accel_bias_ug[0], 0.0);
}

TEST_F(LegacyStart, SaysWhatIsMissing) {
  EXPECT_EQ(complaint("init_att: {x: 0, y: 0, z: 0}\n"), file_ + ": there is no init_llh");
  EXPECT_EQ(complaint("init_llh: {x: 0, y: 0, z: 0}\n"), file_ + ": there is no init_att");
  EXPECT_EQ(complaint("init_llh: {x: 0, y: abc, z: 0}\ninit_att: {x: 0, y: 0, z: 0}\n"),
            file_ + ": init_llh/y must be a number");
  EXPECT_EQ(complaint("init_llh: 3\ninit_att: {x: 0, y: 0, z: 0}\n"), file_ + ": init_llh/x must be a number");
  EXPECT_NE(complaint("init_llh: {x: 40.0, y: 0, z: 0}\ninit_att: {x: 0, y: 0, z: 0}\n").find("latitude_deg"),
            std::string::npos)
      << "degrees where radians are wanted";
  EXPECT_THROW(legacyStart("/nowhere/init_params.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
