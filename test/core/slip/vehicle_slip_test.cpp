#include "core/slip/vehicle_slip.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

WheelGeometry geometry() { return WheelGeometry({{"left", 0.1, 0.0, 0.5, 1.0}, {"right", 0.1, 0.0, -0.5, 1.0}}, 1.0); }

/// A right turn at 1 m/s and 0.4 rad/s: the left wheel's place moves at 1.2 m/s, the right one's at 0.8 m/s.
Estimate turning() {
  Estimate estimate;
  estimate.motion = {0.1, Vector3(1.0, 0.1, 0.0), Vector3(0.0, 0.0, 0.4)};
  estimate.wheels.stamp = 7;
  estimate.wheels.count = 2;
  estimate.wheels.circumferential_mps[0] = 1.5;
  estimate.wheels.circumferential_mps[1] = 1.0;
  estimate.wheels.motion.forward_mps = 1.25;
  return estimate;
}

TEST(VehicleSlip, TakesEachWheelAgainstTheSpeedAtItsPlace) {
  const VehicleSlip slip = vehicleSlip(turning(), geometry());
  EXPECT_EQ(slip.stamp, 7);
  EXPECT_EQ(slip.count, 2U);
  ASSERT_TRUE(slip.ratio[0] && slip.ratio[1] && slip.mean_ratio && slip.angle_rad);
  EXPECT_NEAR(*slip.ratio[0], 1.0 - 1.2 / 1.5, 1e-12);
  EXPECT_NEAR(*slip.ratio[1], 1.0 - 0.8 / 1.0, 1e-12);
  EXPECT_NEAR(*slip.mean_ratio, 1.0 - 1.0 / 1.25, 1e-12);
  EXPECT_NEAR(*slip.angle_rad, std::atan2(0.1, 1.0), 1e-12);
}

TEST(VehicleSlip, IsUndefinedAtRest) {
  Estimate estimate = turning();
  estimate.stationary = true;
  const VehicleSlip slip = vehicleSlip(estimate, geometry());
  EXPECT_FALSE(slip.ratio[0] || slip.ratio[1] || slip.mean_ratio || slip.angle_rad);
  EXPECT_EQ(slip.forward_mps, 1.0);
}

TEST(VehicleSlip, KnowsTheVehicleAloneWhereWheelsAreNotKnown) {
  Estimate estimate = turning();
  estimate.wheels.count = 0;
  const VehicleSlip slip = vehicleSlip(estimate, geometry());
  EXPECT_TRUE(slip.mean_ratio);
  EXPECT_FALSE(slip.ratio[0]);
}

}  // namespace
}  // namespace slipnav
