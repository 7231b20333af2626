#include "slipnav/core/navigation/input_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "slipnav/core/navigation/direction_check.h"

namespace slipnav {
namespace {

constexpr double kGravity_mps2 = 9.81;

/// 10 s of rest, then 10 s of driving in curves with 0.5 m/s, on ground that tilts by up to 4°.
struct Drive {
  double direction = 1.0;  ///< -1: backwards
  double wheel_sign = 1.0;
  bool unsigned_wheels = false;
  std::function<void(ImuSample&)> damage = [](ImuSample&) {};

  std::string complaint() const {
    InputCheck check(kGravity_mps2, 0.0005);
    std::string complaint;
    for (int i = 1; i <= 2000; ++i) {
      const double t_s = 0.01 * i;
      const double driven_s = std::max(t_s - 10.0, 0.0);
      const double tilt_rad = 0.07 * std::sin(1.5 * driven_s);
      const bool accelerates = driven_s > 0.0 && driven_s <= 0.5;
      const double yaw_rate = driven_s > 0.0 ? 0.3 : 0.0;
      ImuSample imu;
      imu.stamp = fromSeconds(t_s);
      imu.f_ib_b = {direction * (accelerates ? 1.0 : 0.0) + kGravity_mps2 * std::sin(tilt_rad), 0.0,
                    -kGravity_mps2 * std::cos(tilt_rad)};
      imu.omega_ib_b = {0.0, driven_s > 0.0 ? 0.105 * std::cos(1.5 * driven_s) : 0.0, yaw_rate};
      damage(imu);
      check.push(imu);
      if (i % 10 == 0) {
        WheelMotion wheels;
        wheels.stamp = imu.stamp;
        const double speed = wheel_sign * direction * std::min(driven_s, 0.5);
        wheels.motion = {unsigned_wheels ? std::abs(speed) : speed, yaw_rate, true};
        wheels.largest_speed_mps = std::abs(speed);
        check.push(wheels);
      }
      if (complaint.empty()) {
        complaint = check.complaint();
      }
    }
    return complaint;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(InputCheck, findsNothingWrongWithAGoodDrive) {
  EXPECT_EQ(Drive{}.complaint(), "");
  Drive backwards;
  backwards.direction = -1.0;
  EXPECT_EQ(backwards.complaint(), "");
}

TEST(InputCheck, namesSpecificForceInG) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.f_ib_b /= 9.80665; };
  EXPECT_TRUE(has(drive.complaint(), "the mean specific force is 1.00 where gravity is 9.81 m/s^2: in g?"))
      << drive.complaint();
}

TEST(InputCheck, namesGravityTakenOut) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.f_ib_b.z() += kGravity_mps2; };
  EXPECT_TRUE(has(drive.complaint(), "gravity taken out?")) << drive.complaint();
}

/// Hard driving and a poor calibration are within a quarter of gravity.
TEST(InputCheck, namesAForceOfAnotherUnit) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.f_ib_b *= 1.2; };
  EXPECT_EQ(drive.complaint(), "");
  for (const double factor : {0.4, 1.35}) {
    drive.damage = [factor](ImuSample& s) { s.f_ib_b *= factor; };
    EXPECT_TRUE(has(drive.complaint(), "another unit, or another planet?")) << drive.complaint();
  }
  drive.damage = [](ImuSample& s) { s.f_ib_b *= 0.2; };
  EXPECT_TRUE(has(drive.complaint(), "gravity taken out?")) << drive.complaint();
}

/// A rover may stand on a steep slope, but on none of 70°.
TEST(InputCheck, namesAMountingThatNoSlopeExplains) {
  const auto tilted = [](double angle_deg) {
    Drive drive;
    drive.damage = [angle_deg](ImuSample& s) {
      s.f_ib_b = Eigen::AngleAxisd(degToRad(angle_deg), Vector3::UnitX()) * s.f_ib_b;
    };
    return drive.complaint();
  };
  EXPECT_FALSE(has(tilted(50.0), "does not point up"));
  EXPECT_TRUE(has(tilted(70.0), "does not point up"));
}

TEST(InputCheck, namesGravityUpsideDown) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.f_ib_b = -s.f_ib_b; };
  EXPECT_TRUE(has(drive.complaint(), "does not point up")) << drive.complaint();
}

TEST(InputCheck, namesGyrosInDegreesPerSecond) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.omega_ib_b *= 180.0 / kPi; };
  EXPECT_TRUE(has(drive.complaint(), "in deg/s?")) << drive.complaint();
}

/// Wheels that hardly grip in a turn: their track on the ground is another one.
TEST(InputCheck, takesNoScrubForAUnit) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.omega_ib_b.z() *= 10.0; };
  EXPECT_FALSE(has(drive.complaint(), "in deg/s?")) << drive.complaint();
  drive.damage = [](ImuSample& s) { s.omega_ib_b.z() *= 20.0; };
  EXPECT_TRUE(has(drive.complaint(), "in deg/s?")) << drive.complaint();
}

TEST(InputCheck, namesGyrosThatTurnTheOtherWay) {
  Drive drive;
  drive.damage = [](ImuSample& s) { s.omega_ib_b.z() = -s.omega_ib_b.z(); };
  EXPECT_TRUE(has(drive.complaint(), "opposite directions")) << drive.complaint();
  drive.damage = [](ImuSample& s) { s.omega_ib_b.z() *= -0.4; };
  EXPECT_TRUE(has(drive.complaint(), "opposite directions")) << "of a rover that scrubs: " << drive.complaint();
  drive.damage = [](ImuSample& s) { s.omega_ib_b.z() *= -0.2; };
  EXPECT_EQ(drive.complaint(), "") << "sliding sideways on a slope";
}

/// A straight drive whose wheels climb stones one by one, then curves.
struct RoughDrive {
  InputCheck check{kGravity_mps2, 0.0005};
  double t_s = 0.0;

  /// One wheel sample with this turn by the wheels, and by the gyros.
  void turn(double wheels_rad, double gyro_rad) {
    for (int i = 0; i < 10; ++i) {
      t_s += 0.01;
      ImuSample imu;
      imu.stamp = fromSeconds(t_s);
      imu.f_ib_b = {0.0, 0.0, -kGravity_mps2};
      imu.omega_ib_b = {0.0, 0.0, gyro_rad / 0.1};
      check.push(imu);
    }
    WheelMotion wheels;
    wheels.stamp = fromSeconds(t_s);
    wheels.motion = {1.0, wheels_rad / 0.1, true};
    wheels.largest_speed_mps = 1.0;
    check.push(wheels);
  }
};

/// The body turns a little against the wheels, and much that has nothing to do with them.
TEST(InputCheck, takesNoStonesForOppositeTurns) {
  RoughDrive drive;
  for (int i = 0; i < 200; ++i) {
    const double stone_rad = i % 2 == 0 ? 0.03 : -0.03;
    drive.turn(stone_rad, -0.4 * stone_rad + (i % 4 < 2 ? 0.03 : -0.03));
    ASSERT_EQ(drive.check.complaint(), "") << "after " << drive.t_s << " s";
  }
}

TEST(InputCheck, takesBackThatTurnsAreOppositeOnceTheyAgree) {
  RoughDrive drive;
  for (int i = 0; i < 40; ++i) {
    drive.turn(0.03, -0.03);
  }
  EXPECT_TRUE(has(drive.check.complaint(), "opposite directions")) << drive.check.complaint();
  for (int i = 0; i < 40; ++i) {
    drive.turn(0.03, 0.03);
  }
  EXPECT_EQ(drive.check.complaint(), "");
}

TEST(InputCheck, namesWheelsWithoutSign) {
  Drive drive;
  drive.direction = -1.0;
  drive.unsigned_wheels = true;
  EXPECT_TRUE(has(drive.complaint(), "disagree on the direction: the wheel speed has no sign")) << drive.complaint();
  drive.direction = 1.0;
  EXPECT_EQ(drive.complaint(), "");
}

TEST(InputCheck, namesWheelsWithTheWrongSign) {
  Drive drive;
  drive.wheel_sign = -1.0;
  EXPECT_TRUE(has(drive.complaint(), "disagree on the direction: wheels[].sign")) << drive.complaint();
}

/// A start after a halt in which the IMU could not be learned at rest.
TEST(DirectionCheck, aStartAfterAShortHaltSaysNothing) {
  const auto contradictsAfter = [](double rest_s) {
    DirectionCheck check(0.0005);
    for (int i = 0; i <= 600; ++i) {
      const double driven_s = std::max(0.01 * i - rest_s, 0.0);
      ImuSample imu;
      imu.stamp = fromSeconds(1000.0 + 0.01 * i);
      imu.f_ib_b = {driven_s > 0.0 && driven_s <= 0.5 ? -1.0 : 0.0, 0.0, -kGravity_mps2};
      check.push(imu);
      if (i % 10 == 0) {
        WheelMotion wheels;
        wheels.stamp = imu.stamp;
        wheels.motion.forward_mps = wheels.largest_speed_mps = std::min(driven_s, 0.5);
        check.push(wheels);
      }
    }
    return check.contradicts();
  };
  EXPECT_TRUE(contradictsAfter(3.0));
  EXPECT_FALSE(contradictsAfter(0.8));
}

/// A bias of 5°/s and one of 60 mg are nothing of the kind.
TEST(InputCheck, isNotMisledByBiases) {
  Drive drive;
  drive.damage = [](ImuSample& s) {
    s.omega_ib_b += Vector3::Constant(degToRad(5.0));
    s.f_ib_b += Vector3::Constant(0.6);
  };
  EXPECT_EQ(drive.complaint(), "");
}

/// Ten samples in two seconds are enough for a mean, nine are not.
TEST(InputCheck, judgesAForceByTenSamples) {
  for (const int intervals : {8, 9, 10}) {
    InputCheck check(kGravity_mps2, 0.0005);
    for (int i = 0; i <= intervals; ++i) {
      check.push(ImuSample{kSecond + i * 2 * kSecond / intervals + 1, {0.0, 0.0, -1.0}, Vector3::Zero()});
    }
    EXPECT_EQ(check.complaint().empty(), intervals < 9) << intervals;
  }
}

}  // namespace
}  // namespace slipnav
