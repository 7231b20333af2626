#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibration/start_guess.h"
#include "evaluation/simulated_drive.h"
#include "simulated_calibration.h"

namespace slipnav {
namespace {

class AidedSmootherTest : public testing::Test {
 protected:
  AidedSmootherTest() {
    config_ = test::calibrationConfig(7, 100.0);
    config_.simulator.imu.misalignment_yaw_deg = 0.0;
    config_.simulator.imu.misalignment_pitch_deg = 0.0;
    simulated_ = test::simulateCalibrationDrive(config_);
    intervals_ = imuIntervals(simulated_.drive.imu, config_.imu.input);
    start_.nav = guessStart(planet_, config_, simulated_.drive, intervals_);
    intervals_.erase(intervals_.begin(),
                     std::find_if(intervals_.begin(), intervals_.end(),
                                  [this](const TimedInterval& i) { return i.start >= start_.nav.stamp; }));
  }

  NavigationState truthAt(Nanoseconds stamp) const {
    const auto truth = std::find_if(simulated_.truth.begin(), simulated_.truth.end(),
                                    [stamp](const sim::TruthState& t) { return t.stamp >= stamp; });
    return toNavState(*truth, planet_, config_.imu.mount.position_b());
  }

  SmoothedDrive smooth() const {
    return AidedSmoother(planet_, config_).smooth(simulated_.drive, intervals_, start_, 1.0);
  }

  Planet planet_ = Planet::byName("earth");
  Config config_;
  test::SimulatedCalibrationDrive simulated_;
  std::vector<TimedInterval> intervals_;
  AidedState start_;
};

TEST_F(AidedSmootherTest, theGuessIsGoodEnoughToStartFrom) {
  const ErrorVector error = errorBetween(planet_, start_.nav, truthAt(start_.nav.stamp));
  EXPECT_LT(radToDeg(error.segment<2>(kAttitude).norm()), 0.5);
  EXPECT_LT(radToDeg(std::abs(error(kAttitude + 2))), 3.0);
  EXPECT_LT(error.segment<3>(kPosition).norm(), 0.1);
}

TEST_F(AidedSmootherTest, errorsAreAsLargeAsItsCovarianceSays) {
  const SmoothedDrive smoothed = smooth();
  ASSERT_GT(smoothed.epochs.size(), 1000U);
  double heading_nees = 0.0;
  double position_nees = 0.0;
  for (const SmoothedEpoch& epoch : smoothed.epochs) {
    const ErrorVector error = errorBetween(planet_, epoch.state.nav, truthAt(epoch.state.nav.stamp));
    const auto normalized = [&](int index) { return error(index) * error(index) / epoch.P(index, index); };
    heading_nees += normalized(kAttitude + 2);
    position_nees += (normalized(kPosition) + normalized(kPosition + 1) + normalized(kPosition + 2)) / 3.0;
  }
  const double count = static_cast<double>(smoothed.epochs.size());
  EXPECT_LT(heading_nees / count, 6.0);  // one heading error for the whole drive
  EXPECT_GT(position_nees / count, 0.3);
  EXPECT_LT(position_nees / count, 2.0);
}

TEST_F(AidedSmootherTest, whatComesLaterHelpsWhatWasBefore) {
  const SmoothedDrive smoothed = smooth();
  const double first = smoothed.epochs.front().P(kAttitude + 2, kAttitude + 2);
  const double last = smoothed.epochs.back().P(kAttitude + 2, kAttitude + 2);
  EXPECT_LT(std::sqrt(first), degToRad(0.3));
  EXPECT_LT(std::sqrt(last), degToRad(0.3));
}

TEST_F(AidedSmootherTest, theNoiseOfTruthIsAsItSays) {
  const SmoothedDrive smoothed = smooth();
  EXPECT_NEAR(smoothed.fix_nis, 1.0, 0.15);
  EXPECT_LT(smoothed.refused_fixes, smoothed.fixes / 100);
}

}  // namespace
}  // namespace slipnav
