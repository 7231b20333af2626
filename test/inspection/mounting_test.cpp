/// Each of the 24 quarter turns is found in a drive, with what is left over.

#include <gtest/gtest.h>

#include "inspection/inspection.h"
#include "slipnav/core/base/rotation.h"
#include "synthetic_recording.h"

namespace slipnav {
namespace {

Mounting mountingOf(const Matrix3& C_sensor_to_flu) {
  test::SyntheticDrive drive;
  drive.C_sensor_to_flu = C_sensor_to_flu;
  const Recording recording = test::syntheticRecording(drive);
  return inspect(recording, {}).mounting;
}

TEST(InspectionMounting, ThereAre24QuarterTurns) {
  const std::vector<Matrix3> turns = quarterTurns();
  ASSERT_EQ(turns.size(), 24U);
  for (const Matrix3& turn : turns) {
    EXPECT_NEAR(turn.determinant(), 1.0, 1e-12);
    EXPECT_TRUE(toRotation(toMountParams(turn)).isApprox(turn, 1e-7)) << turn;
  }
}

TEST(InspectionMounting, FindsEveryQuarterTurn) {
  for (const Matrix3& turn : quarterTurns()) {
    const Mounting mounting = mountingOf(turn);
    EXPECT_TRUE(mounting.is_sure) << turn;
    EXPECT_TRUE(mounting.nearest.isApprox(turn)) << turn << "\nfound\n" << mounting.nearest;
    EXPECT_GT(mounting.turn_per_rate, 0.0);
  }
}

TEST(InspectionMounting, SaysWhatIsLeftOver) {
  const Matrix3 small = quaternionFromRotationVector(Vector3(0.0, 0.0, 0.2)).toRotationMatrix();
  const Mounting mounting = mountingOf(small);
  EXPECT_TRUE(mounting.nearest.isIdentity());
  EXPECT_NEAR(mounting.left_over_rad, 0.2, 0.04);
}

TEST(InspectionMounting, IsNotSureHalfWayBetweenTwo) {
  EXPECT_FALSE(mountingOf(quaternionFromRotationVector(Vector3(0.0, 0.0, 0.25 * kPi)).toRotationMatrix()).is_sure);
}

TEST(InspectionMounting, NamesAxes) {
  EXPECT_EQ(axesText(Matrix3::Identity()), "x forward, y left, z up");
  EXPECT_EQ(axesText(Vector3(1.0, -1.0, -1.0).asDiagonal()), "x forward, y right, z down");
}

}  // namespace
}  // namespace slipnav
