#include "tuning/tuner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "config/yaml_document.h"
#include "config/yaml_reader.h"
#include "sample_parameters.h"
#include "tuning/tuning_report.h"
#include "tuning_drive.h"

namespace slipnav::test {
namespace {

const TunedKnob& knobOf(const TuningResult& result, const std::string& key) {
  for (const TunedKnob& tuned : result.knobs) {
    if (tuned.knob.keys.front() == key) {
      return tuned;
    }
  }
  throw std::logic_error(key);
}

Config fromYaml(Config config, const std::string& yaml) {
  readParameters(parseYaml(yaml, ""), config);
  return config;
}

const std::vector<std::string> kWheels = {"wheel.speed_std_mps", "wheel.stamp_delay_s"};

TuningResult tuned(const Config& config, std::vector<TuningDrive> drives) {
  return tune(tuningKnobs(config, kWheels), std::move(drives), [](const TuningProgress&) {});
}

TEST(TuningKnobTest, everyKeyIsAParameterAndMoves) {
  const Config config;
  const std::vector<Knob> knobs = tuningKnobs(config);
  Eigen::VectorXd position(knobs.size());
  position.setConstant(0.1);
  const Config other = withKnobs(config, knobs, position);
  EXPECT_NEAR(other.wheel.speed_std_mps, config.wheel.speed_std_mps * std::exp(0.1), 1e-9);
  EXPECT_NEAR(other.wheel.stamp_delay_s, config.wheel.stamp_delay_s + 0.1, 1e-9);
  EXPECT_NEAR(other.nonholonomic.lateral_turn_std_m, config.nonholonomic.lateral_turn_std_m * std::exp(0.1), 1e-9);
  std::set<std::string> keys;
  for (const Knob& knob : knobs) {
    for (const std::string& key : knob.keys) {
      EXPECT_TRUE(keys.insert(key).second) << key;
    }
  }
}

TEST(TuningKnobTest, whatIsTheLeastAssumedGoesUpwardsOnly) {
  const std::set<std::string> floors = {"imu.noise.accel_noise_mps_per_sqrt_h", "imu.noise.gyro_noise_deg_per_sqrt_h",
                                        "imu.noise.accel_bias_std_ug",          "vehicle.fast_slip_std",
                                        "nonholonomic.lateral_std_mps",         "nonholonomic.vertical_std_mps"};
  for (const Knob& knob : tuningKnobs(Config{})) {
    EXPECT_EQ(knob.lower == 0.0, floors.count(knob.keys.front()) > 0) << knob.name;
  }
}

TEST(TuningKnobTest, zeroIsMeant) {
  Config config;
  config.wheel.stamp_std_s = 0.0;
  for (const Knob& knob : tuningKnobs(config)) {
    EXPECT_NE(knob.keys.front(), "wheel.stamp_std_s");
  }
}

TEST(TuningKnobTest, someOnly) {
  EXPECT_EQ(tuningKnobs(Config{}, {"wheel.slip_noise_std", "wheel.stamp_delay_s"}).size(), 2U);
  EXPECT_EQ(messageOf<std::invalid_argument>([] { tuningKnobs(Config{}, {"wheel.speed_std"}); }),
            "'wheel.speed_std' cannot be tuned, did you mean 'wheel.speed_std_mps'?");
}

constexpr double kNoise_mps = 0.04;

TuningDrive noisyDrive(const Config& config) {
  TuningDrive drive = simulateTuningDrive(config);
  addWheelNoise(kNoise_mps, drive);
  return drive;
}

TEST(TunerTest, findsTheNoiseOfADrive) {
  const Config config = tuningConfig(3, 50.0);
  const TuningResult result = tuned(config, {noisyDrive(config)});
  EXPECT_TRUE(result.worthwhile);
  const TunedKnob& noise = knobOf(result, "wheel.speed_std_mps");
  ASSERT_TRUE(noise.told);
  EXPECT_NEAR(noise.position, std::log(kNoise_mps / config.wheel.speed_std_mps), 3.0 * *noise.std);
  EXPECT_LT(*noise.std, 0.2);
  const Config read = fromYaml(config, tuningYaml(config, result));
  EXPECT_NEAR(read.wheel.speed_std_mps, kNoise_mps, 0.2 * kNoise_mps);
  EXPECT_NE(tuningTable(config, result).find("\nworth it"), std::string::npos);
}

TEST(TunerTest, findsTheDelayOfADrive) {
  constexpr double kDelay_s = 0.05;
  Config config = tuningConfig(4, 120.0);
  config.wheel.stamp_std_s = 0.005;
  TuningDrive drive = simulateTuningDrive(config);
  for (Sample& sample : drive.samples) {
    if (auto* wheels = std::get_if<WheelMotion>(&sample)) {
      wheels->stamp += fromSeconds(kDelay_s);
    }
  }
  const TuningResult result = tune(tuningKnobs(config, {"wheel.stamp_delay_s"}), {drive}, [](const TuningProgress&) {});
  EXPECT_TRUE(result.worthwhile) << tuningTable(config, result);
  const TunedKnob& delay = knobOf(result, "wheel.stamp_delay_s");
  ASSERT_TRUE(delay.told);
  EXPECT_NEAR(delay.position, kDelay_s, 3.0 * *delay.std + 0.005);
  EXPECT_LT(*delay.std, 0.02);
}

TEST(TunerTest, saysWhenItIsNotWorthIt) {
  Config config = tuningConfig(5, 50.0);
  config.wheel.speed_std_mps = kNoise_mps;
  const TuningResult result = tuned(config, {noisyDrive(config)});
  EXPECT_FALSE(result.worthwhile) << tuningTable(config, result);
  EXPECT_NE(tuningTable(config, result).find("\nnot worth it"), std::string::npos);
}

TEST(TunerTest, oneSetForSeveralDrivesHeldOutByDrives) {
  Config config = tuningConfig(1, 30.0);
  std::vector<TuningDrive> drives;
  for (int seed = 1; seed <= 3; ++seed) {
    config.simulator.seed = seed;
    drives.push_back(simulateTuningDrive(config));
    addWheelNoise(0.05, drives.back());
  }
  std::size_t runs = 0;
  const TuningResult result =
      tune(tuningKnobs(config, {"wheel.speed_std_mps"}), drives, [&runs](const TuningProgress& progress) {
        EXPECT_EQ(progress.runs, runs + 1);
        EXPECT_LE(progress.runs, progress.expected);
        runs = progress.runs;
      });
  EXPECT_EQ(result.drives, 3U);
  EXPECT_TRUE(result.worthwhile);
  EXPECT_NEAR(knobOf(result, "wheel.speed_std_mps").halves[0], knobOf(result, "wheel.speed_std_mps").halves[1], 0.3);
}

TEST(TunerTest, aDriveThatSaysTooLittleIsRefused) {
  Config config = tuningConfig(1, 20.0);
  TuningDrive drive = simulateTuningDrive(config);
  drive.samples.resize(drive.samples.size() / 4);
  EXPECT_THROW(tuned(config, {drive}), std::invalid_argument);
  drive.samples.resize(10);
  EXPECT_THROW(tuned(config, {drive}), std::invalid_argument);
  config.initialization.source = "truth";
  EXPECT_THROW(tuned(config, {drive}), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav::test
