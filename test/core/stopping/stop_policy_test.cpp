#include "core/stopping/stop_policy.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "sample_parameters.h"

namespace slipnav::test {
namespace {

Nanoseconds at(double t_s) { return fromSeconds(1000.0 + t_s); }

constexpr double kSpeed_mps = 0.8;

bool holds(StopPolicy& policy, Nanoseconds stamp, bool standstill) {
  return policy.command({{kSpeed_mps, 0.0, 0.0}, {}}, {stamp, standstill, true}).isZero();
}

/// A rover that needs 0.5 s to come to rest; times at which holds begin and end.
struct Drive {
  std::vector<double> stops;
  std::vector<double> starts;
};

Drive drive(StopPolicy& policy, double duration_s) {
  Drive result;
  bool holding = false;
  double held_since = 0.0;
  for (int i = 0; i <= static_cast<int>(10.0 * duration_s); ++i) {
    const double t_s = 0.1 * i;
    const bool hold = holds(policy, at(t_s), holding && t_s - held_since >= 0.45);
    if (hold && !holding) {
      held_since = t_s;
      result.stops.push_back(t_s);
    } else if (!hold && holding) {
      result.starts.push_back(t_s);
    }
    holding = hold;
  }
  return result;
}

TEST(StopPolicy, NoneNeverStops) {
  const auto policy = makeStopPolicy("none", {});
  EXPECT_TRUE(drive(*policy, 1000.0).stops.empty());
}

TEST(StopPolicy, PeriodicDrivesAndStands) {
  const auto policy = makeStopPolicy("periodic:10:3", {});
  const Drive result = drive(*policy, 40.0);
  // 10 s of driving, 0.5 s until it stands, 3 s of standing
  ASSERT_EQ(result.stops.size(), 3U);
  ASSERT_EQ(result.starts.size(), 2U);
  EXPECT_NEAR(result.stops[0], 10.0, 0.11);
  EXPECT_NEAR(result.starts[0], 13.5, 0.21);
  EXPECT_NEAR(result.stops[1] - result.starts[0], 10.0, 0.11);
  EXPECT_NEAR(result.starts[1] - result.stops[1], 3.5, 0.21);
}

TEST(StopPolicy, HoldsUntilItStands) {
  PeriodicStops policy(10.0, 3.0);
  holds(policy, at(0.0), true);
  EXPECT_FALSE(holds(policy, at(9.9), false));
  EXPECT_TRUE(holds(policy, at(10.0), false));
  EXPECT_TRUE(holds(policy, at(60.0), false));  // cannot stop: the time of standing has not begun
  EXPECT_TRUE(holds(policy, at(61.0), true));
  EXPECT_TRUE(holds(policy, at(63.9), true));
  EXPECT_FALSE(holds(policy, at(64.0), true));
}

TEST(StopPolicy, ThePeriodBeginsWithTheRoute) {
  PeriodicStops policy(10.0, 3.0);
  const VelocityCommand in{{kSpeed_mps, 0.0, 0.0}, {}};
  for (int i = 0; i < 60; ++i) {
    EXPECT_FALSE(policy.command(in, {at(i), false, false}).isZero());
  }
  EXPECT_FALSE(holds(policy, at(60.0), false));
  EXPECT_FALSE(holds(policy, at(69.9), false));
  EXPECT_TRUE(holds(policy, at(70.0), false));
}

TEST(StopPolicy, AutonomousStopsTheRoverWhateverTheModeSays) {
  StopParams params;
  params.mode = "off";
  params.min_drive_s = 0.0;
  const auto policy = makeStopPolicy("autonomous", params);
  policy->observe({at(0.0), kSpeed_mps, 0.1, false, false, false});
  EXPECT_FALSE(holds(*policy, at(0.0), false));
  policy->setForecast({at(0.0), 0.0});
  policy->observe({at(2.0), kSpeed_mps, 0.1, false, false, false});
  EXPECT_TRUE(holds(*policy, at(2.0), false));
}

TEST(StopPolicy, FractionsOfASecond) {
  const auto policy = makeStopPolicy("periodic:0.5:0.25", {});
  holds(*policy, at(0.0), false);
  EXPECT_FALSE(holds(*policy, at(0.4), false));
  EXPECT_TRUE(holds(*policy, at(0.5), false));
}

TEST(StopPolicy, WrongTextsAreRefusedByName) {
  const auto complaint = [](const std::string& text) {
    return messageOf<std::invalid_argument>([&text] { makeStopPolicy(text, {}); });
  };
  for (const char* text :
       {"", "nonsense", "periodic", "periodic:", "periodic:10", "None", "autonomous:3", "periodic10:3"}) {
    EXPECT_NE(complaint(text).find("'" + std::string(text) + "'"), std::string::npos) << text;
  }
  EXPECT_NE(complaint("periodic:ten:3").find("'ten'"), std::string::npos);
  EXPECT_NE(complaint("periodic:10:3s").find("'3s'"), std::string::npos);
  EXPECT_NE(complaint("periodic:10:nan").find("'nan'"), std::string::npos);
  EXPECT_NE(complaint("periodic::3").find("''"), std::string::npos);
  EXPECT_THROW(makeStopPolicy("periodic:0:3", {}), std::invalid_argument);
  EXPECT_THROW(makeStopPolicy("periodic:10:-1", {}), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav::test
