#include "config/tuning.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "config/yaml_writer.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;

const char* const kNodelets[] = {"Filter", "Forecast", "StopSupervisor"};

std::string complaint(const std::vector<ParameterChange>& changes) {
  return messageOf<std::invalid_argument>([&] { withChanges(Config{}, changes); });
}

TEST(Tuning, NoParameterIsOfferedByTwo) {
  std::size_t offered = 0;
  for (const char* nodelet : kNodelets) {
    offered += tunableParameters(nodelet, Config{}).size();
  }
  EXPECT_EQ(tunableKeys().size(), offered);
}

TEST(Tuning, OffersThresholdsAndNoiseButNothingThatTheStateWasMadeWith) {
  const std::set<std::string> keys = tunableKeys();
  for (const char* key : {"forecast.threshold_m", "filter.gate_alpha", "wheel.speed_std_mps", "stop.mode",
                          "stationary.accel_std_mps2", "nonholonomic.lateral_std_mps"}) {
    EXPECT_EQ(keys.count(key), 1U) << key;
  }
  for (const char* key : {"planet", "wheel.scrub_factor", "forecast.step_s", "filter.max_wait_s",
                          "zero_motion.velocity_std_mps", "vehicle.slow_slip_std"}) {
    EXPECT_EQ(keys.count(key), 0U) << key;
  }
}

TEST(Tuning, AChangeChangesThatAndNothingElse) {
  Config expected;
  expected.forecast.threshold_m = 1.0 / 3.0;
  expected.stop.mode = "off";
  expected.stop.min_zero_updates = 3;
  const Config changed = withChanges(
      Config{}, {{"forecast.threshold_m", 1.0 / 3.0}, {"stop.mode", std::string("off")}, {"stop.min_zero_updates", 3}});
  EXPECT_EQ(toYaml(changed), toYaml(expected));
}

TEST(Tuning, RefusesWhatAFileCouldNotSayEither) {
  EXPECT_EQ(complaint({{"forecast.threshold_m", -1.0}}), "'forecast.threshold_m' must be 0.001 to 10000, not -1");
  EXPECT_EQ(complaint({{"forecast.threshold_m", std::numeric_limits<double>::quiet_NaN()}}),
            "'forecast.threshold_m' must be a finite number, not 'nan'");
  EXPECT_EQ(complaint({{"stop.mode", std::string("go")}}), "'stop.mode' must be off, advise or active, not 'go'");
  EXPECT_EQ(complaint({{"stop.min_zero_updates", 2.5}}), "'stop.min_zero_updates' must be a whole number, not '2.5'");
  EXPECT_EQ(complaint({{"forecast.treshold_m", 1.0}}),
            "unknown key 'forecast.treshold_m', did you mean 'forecast.threshold_m'?");
}

TEST(Tuning, RefusesWhatContradictsAnotherValue) {
  EXPECT_EQ(complaint({{"zero_motion.min_velocity_std_mps", 0.5}}),
            "'zero_motion.min_velocity_std_mps' must not be above 'zero_motion.max_velocity_std_mps'");
  EXPECT_EQ(complaint({{"zero_motion.min_velocity_std_mps", 0.5}, {"zero_motion.max_velocity_std_mps", 0.6}}),
            "nothing was thrown");
}

TEST(Tuning, SaysWhatHasChanged) {
  const std::vector<ParameterInfo> before = tunableParameters("Forecast", Config{});
  const Config changed = withChanges(Config{}, {{"forecast.sigmas", 2.0}, {"forecast.threshold_m", 2.5}});
  EXPECT_EQ(toText(differences(before, tunableParameters("Forecast", changed))),
            "forecast.threshold_m from 3 to 2.5, forecast.sigmas from 3 to 2");
  EXPECT_TRUE(differences(before, before).empty());
}

}  // namespace
}  // namespace slipnav
