#include "evaluation/stop_ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace slipnav {
namespace {

/// A drive of 60 s with wheels at rest from 10 s to 14 s and from 30 s to 34 s, an IMU of 50 Hz, wheels of 10 Hz.
struct Drive {
  double gyro_bias_radps = 0.0;
  bool second_stop_is_real = true;  ///< else the wheels' encoders are dead in a moving rover

  static bool inFirst(double t_s) { return t_s > 10.0 && t_s <= 14.0; }
  static bool inSecond(double t_s) { return t_s > 30.0 && t_s <= 34.0; }

  StopLedger ledger() const {
    StopLedger ledger(StationaryParams{}, ImuFloor{}, 9.8);
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    for (int i = 1; i <= 3000; ++i) {
      const double t_s = 0.02 * i;
      const bool wheels_rest = inFirst(t_s) || inSecond(t_s);
      const bool at_rest = inFirst(t_s) || (inSecond(t_s) && second_stop_is_real);
      const double tremor = at_rest ? 0.001 : 0.1;
      const auto noise = [&] { return tremor * normal(generator); };
      ledger.add(ImuSample{fromSeconds(t_s), Vector3(noise(), noise(), -9.8),
                           Vector3(gyro_bias_radps + noise(), noise(), noise())});
      if (i % 5 == 0) {
        WheelMotion wheels;
        wheels.stamp = fromSeconds(t_s);
        wheels.largest_speed_mps = wheels_rest ? 0.0 : 0.5;
        ledger.add(wheels);
      }
    }
    return ledger;
  }
};

TEST(StopLedger, countsStopsAndThoseWithAZeroUpdate) {
  StopLedger ledger = Drive{}.ledger();
  ledger.noteZeroUpdate(fromSeconds(12.0));
  const StopCounts counts = ledger.counts(0, fromSeconds(60.0));
  EXPECT_EQ(counts.seen, 2);
  EXPECT_EQ(counts.used, 1);
}

TEST(StopLedger, aBiasOfTheGyroHidesNoStop) {
  Drive drive;
  drive.gyro_bias_radps = degToRad(5.0);
  EXPECT_EQ(drive.ledger().counts(0, fromSeconds(60.0)).seen, 2);
}

TEST(StopLedger, deadEncodersOfAMovingRoverAreNoStop) {
  Drive drive;
  drive.second_stop_is_real = false;
  EXPECT_EQ(drive.ledger().counts(0, fromSeconds(60.0)).seen, 1);
}

TEST(StopLedger, leavesOutWhatLiesBeforeTheEstimate) {
  EXPECT_EQ(Drive{}.ledger().counts(fromSeconds(20.0), fromSeconds(60.0)).seen, 1);
}

}  // namespace
}  // namespace slipnav
