#include "core/navigation/start_covariance.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

/// A gyro that turns at rest by far more than its data sheet allows is believed, with doubt.
TEST(StartCovariance, ABiasBeyondTheDataSheetIsBelieved) {
  constexpr double kStd_radps = 1e-4;
  InitialState initial;
  initial.P.diagonal().segment<3>(kGyroBias).setConstant(square(kStd_radps));
  initial.nav.gyro_bias_b = Vector3(0.001, 0.0, 0.0);
  believeSurprisingBias(Vector3(0.021, kStd_radps, 0.0), initial);
  EXPECT_EQ(initial.nav.gyro_bias_b.x(), 0.021);
  EXPECT_NEAR(initial.P(kGyroBias, kGyroBias), square(kStd_radps) + square(0.02), 1e-12);
  EXPECT_EQ(initial.nav.gyro_bias_b.y(), 0.0) << "no surprise";
  EXPECT_EQ(initial.P(kGyroBias + 1, kGyroBias + 1), square(kStd_radps));
}

/// Three deviations, and the rotation of any planet.
TEST(StartCovariance, ASurpriseIsMoreThanAPlanetTurns) {
  for (const double side : {1.0, -1.0}) {
    for (const double off_radps : {3.9e-4, 4.1e-4}) {
      InitialState initial;
      initial.P.diagonal().segment<3>(kGyroBias).setConstant(square(1e-4));
      believeSurprisingBias(Vector3(0.0, 0.0, side * off_radps), initial);
      EXPECT_EQ(initial.nav.gyro_bias_b.z(), off_radps > 4e-4 ? side * off_radps : 0.0);
    }
  }
}

}  // namespace
}  // namespace slipnav::test
