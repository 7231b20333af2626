#include "slipnav/core/navigation/drive_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference_trace.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

constexpr double kBegin_s = 1000.0;
constexpr double kRest_s = 20.0;
constexpr double kEnd_s = 60.0;
constexpr double kSpeed_mps = 0.5;
constexpr double kHeading_rad = 2.0;
constexpr double kScale = 0.9;  ///< of the wheels, which are smaller than they are taken for
constexpr double kFixStd_m = 0.02;
const Geodetic kReference{0.7, -1.4, 300.0};
const Vector2 kStart_ne_m(3.0, -2.0);

/// Rest, and then a bend to the right that becomes a straight line.
class DriveFitTest : public ::testing::Test {
 protected:
  using Damage = std::function<void(double t_s, Vector2& fix_ne_m)>;

  DriveFitTest() {
    Vector2 driven_m = Vector2::Zero();
    double heading_rad = 0.0;
    for (int i = 0; i <= static_cast<int>(50.0 * kEnd_s); ++i) {
      const double t_s = 0.02 * i;
      const double rate = t_s > kRest_s && t_s <= kRest_s + 10.0 ? 0.1 : 0.0;
      const double speed = t_s > kRest_s ? kSpeed_mps : 0.0;
      heading_rad += 0.02 * rate;
      driven_m += 0.02 * speed * Vector2(std::cos(heading_rad), std::sin(heading_rad));
      WheelMotion wheels;
      wheels.stamp = fromSeconds(kBegin_s + t_s);
      wheels.motion.forward_mps = wheels.largest_speed_mps = speed;
      recording_.push(wheels);
      recording_.push(ImuSample{wheels.stamp, Vector3(0.0, 0.0, -9.8), Vector3(0.0, 0.0, rate)});
      if (i % 10 == 0) {
        way_.push_back({t_s, driven_m});
      }
    }
  }

  /// @param late_s the stamps are this much later than the fixes
  std::vector<PositionFix> fixes(double late_s, const Damage& damage) const {
    std::vector<PositionFix> fixes;
    for (const auto& [t_s, driven_m] : way_) {
      Vector2 ne_m = kStart_ne_m + kScale * (Eigen::Rotation2Dd(kHeading_rad) * driven_m);
      damage(t_s, ne_m);
      PositionFix fix;
      fix.stamp = fromSeconds(kBegin_s + t_s + late_s);
      fix.position = kReference;
      fix.position.latitude_rad += ne_m.x() / planet_.meridianRadius(kReference.latitude_rad);
      fix.position.longitude_rad +=
          ne_m.y() / planet_.transverseRadius(kReference.latitude_rad) / std::cos(kReference.latitude_rad);
      fix.variance_ned_m2.setConstant(kFixStd_m * kFixStd_m);
      fixes.push_back(fix);
    }
    return fixes;
  }

  DriveTrack track() const { return {recording_, fromSeconds(kBegin_s), 0.0, Vector3::Zero()}; }

  std::optional<double> lag(const std::vector<PositionFix>& fixes, double until_s) const {
    return lagOfFixes(planet_, fixes, track(), kReference, fromSeconds(kBegin_s), fromSeconds(kBegin_s + until_s));
  }

  static void kNone(double, Vector2&) {}

  const Planet planet_ = Planet::byName("earth");
  StartRecording recording_{StationaryParams{}, ImuFloor{}, 9.8, 5.0, 600.0};
  std::vector<std::pair<double, Vector2>> way_;
};

TEST_F(DriveFitTest, FindsHeadingStartAndScale) {
  const std::optional<DriveFit> fit =
      fitDrive(planet_, fixes(0.0, kNone), track(), kReference, fromSeconds(kBegin_s), fromSeconds(kBegin_s + kEnd_s));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->heading_rad, kHeading_rad, 0.01);
  EXPECT_NEAR(fit->scale, kScale, 0.01);
  EXPECT_LT((fit->start_ne_m - kStart_ne_m).norm(), 0.05);
  EXPECT_LT(fit->residual_m, 0.05);
  EXPECT_NEAR(fit->fix_std_m, kFixStd_m * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(fit->distance_m, track().reach(), 0.1);
}

TEST_F(DriveFitTest, TwoFixesFarApartGiveAHeading) {
  const std::vector<PositionFix> all = fixes(0.0, kNone);
  const std::optional<DriveFit> fit = fitDrive(planet_, {all.front(), all.back()}, track(), kReference,
                                               fromSeconds(kBegin_s), fromSeconds(kBegin_s + kEnd_s));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->heading_rad, kHeading_rad, 0.01);
}

TEST_F(DriveFitTest, AVehicleOfWhichNoWheelHasBeenHeardHasNoWay) {
  StartRecording only_imu{StationaryParams{}, ImuFloor{}, 9.8, 5.0, 600.0};
  for (const ImuSample& sample : recording_.imu()) {
    only_imu.push(sample);
  }
  EXPECT_EQ(DriveTrack(only_imu, fromSeconds(kBegin_s), 0.0, Vector3::Zero()).reach(), 0.0);
}

/// Of wheels whose samples end before those of the IMU.
TEST_F(DriveFitTest, TheLastSpeedThatIsKnownLasts) {
  const double reach_m = track().reach();
  WheelMotion wheels = recording_.wheels().back();
  wheels.stamp += 1;
  wheels.motion.forward_mps = wheels.largest_speed_mps = 2.0 * kSpeed_mps;
  recording_.push(wheels);
  ImuSample sample = recording_.imu().back();
  sample.stamp += fromSeconds(0.1);
  recording_.push(sample);
  EXPECT_NEAR(track().reach() - reach_m, 0.1 * 2.0 * kSpeed_mps, 0.01);
}

TEST_F(DriveFitTest, FindsTheLagOfAnotherClockInBothDirections) {
  EXPECT_EQ(lag(fixes(0.0, kNone), 50.0), std::nullopt);
  EXPECT_NEAR(lag(fixes(9.0, kNone), 50.0).value_or(0.0), -9.0, 0.5);
  EXPECT_NEAR(lag(fixes(-9.0, kNone), 50.0).value_or(0.0), 9.0, 0.5);
}

TEST_F(DriveFitTest, FindsTheLagOfABufferThatHoldsHalfAMinute) {
  EXPECT_NEAR(lag(fixes(30.0, kNone), 88.0).value_or(0.0), -30.0, 0.5);
}

/// A fix far off that does not say so.
TEST_F(DriveFitTest, OutliersHardlyMoveTheFit) {
  const Damage far_off = [](double t_s, Vector2& ne_m) { ne_m.x() += std::fmod(t_s, 4.0) < 0.1 ? 6.0 : 0.0; };
  const std::optional<DriveFit> fit = fitDrive(planet_, fixes(0.0, far_off), track(), kReference, fromSeconds(kBegin_s),
                                               fromSeconds(kBegin_s + kEnd_s));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->heading_rad, kHeading_rad, 1e-3);
  EXPECT_LT((fit->start_ne_m - kStart_ne_m).norm(), 0.01);
}

TEST_F(DriveFitTest, HeightIsThatOfTheRest) {
  std::vector<PositionFix> all = fixes(0.0, kNone);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].position.height_m += i % 20 == 3 ? 9.0 : 0.01 * (i % 2 == 0 ? 1.0 : -1.0);
    all[i].position.height_m += toSeconds(all[i].stamp) > kBegin_s + kRest_s ? 2.0 : 0.0;  // uphill
  }
  const double height_m = meanHeight(all, fromSeconds(kBegin_s), fromSeconds(kBegin_s + kRest_s));
  EXPECT_NEAR(height_m, kReference.height_m, 0.01);
  EXPECT_EQ(meanHeight(all, 0, 1), all.front().position.height_m) << "of no fix in the rest the first one";
}

TEST_F(DriveFitTest, HeightIsWeighedByWhatTheReceiverSays) {
  std::vector<PositionFix> two(2, fixes(0.0, kNone).front());
  two[0].variance_ned_m2.z() = 1.0;
  two[1].variance_ned_m2.z() = 4.0;
  two[1].position.height_m += 0.1;
  EXPECT_NEAR(meanHeight(two, 0, two.front().stamp) - kReference.height_m, 0.1 / 5.0, 1e-3);
}

TEST(DriveFit, ALagIsDescribedByItsDirection) {
  EXPECT_NE(describeLag(9.0).find("9.0 s too early"), std::string::npos);
  EXPECT_NE(describeLag(-9.0).find("9.0 s too late"), std::string::npos);
  EXPECT_EQ(describeLag(9.0).find("GPS time"), std::string::npos);
  for (const double leap_s : {17.5, -18.0, 18.5}) {
    EXPECT_NE(describeLag(leap_s).find("GPS time instead of UTC"), std::string::npos) << leap_s;
  }
  EXPECT_EQ(describeLag(19.5).find("GPS time"), std::string::npos);
}

/// A lag that moved the newest fixes beyond the recording would omit just those that contradict.
TEST_F(DriveFitTest, FixesThatWorsenInTheEndAreNotThoseOfAnotherClock) {
  const Damage reflected = [](double t_s, Vector2& ne_m) { ne_m += t_s > 45.0 ? Vector2(4.0, 4.0) : Vector2::Zero(); };
  std::vector<PositionFix> on_the_straight_line = fixes(0.0, reflected);
  on_the_straight_line.erase(on_the_straight_line.begin(), on_the_straight_line.begin() + 160);
  EXPECT_EQ(lag(on_the_straight_line, kEnd_s), std::nullopt);
}

/// Of fixes that are early or late, and scatter more or less, before the drive and far into it.
TEST_F(DriveFitTest, FitsAndLagsAreTheSame) {
  test::ReferenceTrace trace("drive_fit");
  const Nanoseconds begin = fromSeconds(kBegin_s);
  for (const double noise_m : {0.01, 0.05, 0.3}) {
    test::Dice dice(9);
    for (const double late_s : {0.0, -0.5, 0.75, 2.0, -9.0, 39.5, 42.0}) {
      const std::vector<PositionFix> scattered =
          fixes(late_s, [&](double, Vector2& ne_m) { ne_m += noise_m * Vector2(dice.normal(), dice.normal()); });
      for (const double until_s : {20.4, 40.0, 60.0}) {
        const std::optional<DriveFit> fit =
            fitDrive(planet_, scattered, track(), kReference, begin, begin + fromSeconds(until_s));
        const DriveFit f = fit.value_or(DriveFit{});
        trace.note(late_s, until_s, fit.has_value(), f.heading_rad, f.heading_std_rad, f.scale, f.distance_m,
                   f.residual_m, f.fix_std_m, f.start_ne_m.norm(), meanHeight(scattered, begin, begin + kSecond));
      }
      trace.note(late_s, "lag", lag(scattered, 50.0).value_or(0.0),
                 lag(scattered, 58.0 + std::max(0.0, late_s)).value_or(0.0));
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav
