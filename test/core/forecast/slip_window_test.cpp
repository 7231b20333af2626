#include "core/forecast/slip_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace slipnav {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(SlipWindow, OriginIsOneIntervalBeforeTheFirstSample) {
  const SlipWindow window = makeSlipWindow({{100.0, 100.5, 101.0, 101.5}, {0.1, 0.2, 0.1, 0.0}, {}});
  EXPECT_DOUBLE_EQ(window.origin_s, 99.5);
  EXPECT_DOUBLE_EQ(window.interval_s, 0.5);
  EXPECT_TRUE(window.times.isApprox(Eigen::Vector4d(0.5, 1.0, 1.5, 2.0)));
  EXPECT_EQ(window.left_out, 0);
}

TEST(SlipWindow, OriginMayBeGiven) {
  const SlipWindow window = makeSlipWindow({{100.0, 100.5}, {0.1, 0.2}, 90.0});
  EXPECT_DOUBLE_EQ(window.origin_s, 90.0);
  EXPECT_DOUBLE_EQ(window.times(0), 10.0);
}

TEST(SlipWindow, AGapDoesNotMoveTheOrigin) {
  const SlipWindow window = makeSlipWindow({{10.0, 15.0, 15.1, 15.2, 15.3}, {0.1, 0.2, 0.1, 0.0, 0.1}, {}});
  EXPECT_NEAR(window.origin_s, 9.9, 1e-12);
  EXPECT_NEAR(window.times(1) - window.times(0), 5.0, 1e-12);
}

TEST(SlipWindow, LeavesOutWhatIsNoSample) {
  const SlipSamples samples{
      {1.0, 2.0, 2.0, 3.0, 4.0, 5.0, 4.5, kNaN, 7.0, 8.0}, {0.1, 0.2, 0.9, 1.0, -1.0, kNaN, 0.3, 0.3, 1.5, 0.4}, {}};
  const SlipWindow window = makeSlipWindow(samples);
  // 2.0 twice, |slip| ≥ 1 three times, NaN in either column
  EXPECT_EQ(window.left_out, 6);
  ASSERT_EQ(window.size(), 4);
  EXPECT_TRUE(window.slips.isApprox(Eigen::Vector4d(0.1, 0.2, 0.3, 0.4)));
  EXPECT_TRUE((window.times.array() + window.origin_s).isApprox(Eigen::Array4d(1.0, 2.0, 4.5, 8.0)));
}

TEST(SlipWindow, EmptyIsEmpty) {
  EXPECT_EQ(makeSlipWindow({}).size(), 0);
  EXPECT_THROW(makeSlipWindow({{1.0}, {}, {}}), std::invalid_argument);
}

TEST(SlipWindow, ScaleHasItsDefinition) {
  const SlipWindow window = makeSlipWindow({{1.0, 2.0, 3.0, 4.0}, {0.1, 0.3, 0.1, 0.3}, {}});
  const WindowScale scale = measureScale(window, 1e-3);
  EXPECT_DOUBLE_EQ(scale.interval_s, 1.0);
  EXPECT_DOUBLE_EQ(scale.span_s, 3.0);
  EXPECT_DOUBLE_EQ(scale.mean_time_s, 2.5);
  EXPECT_NEAR(scale.power, 0.05, 1e-15);
  EXPECT_NEAR(scale.variance, 0.01, 1e-15);
  EXPECT_NEAR(scale.difference_power, 0.02, 1e-15);
  EXPECT_THROW(measureScale(makeSlipWindow({{1.0}, {0.1}, {}}), 1e-3), std::invalid_argument);
}

TEST(SlipWindow, ConstantSlipHasFlooredPowers) {
  const SlipWindow window = makeSlipWindow({{1.0, 2.0, 3.0}, {0.2, 0.2, 0.2}, {}});
  EXPECT_TRUE(isConstant(window, 1e-3));
  EXPECT_FALSE(isConstant(makeSlipWindow({{1.0, 2.0}, {0.2, 0.202}, {}}), 1e-3));
  const WindowScale scale = measureScale(window, 1e-3);
  EXPECT_DOUBLE_EQ(scale.variance, 1e-6);
  EXPECT_DOUBLE_EQ(scale.difference_power, 1e-6);
  EXPECT_NEAR(scale.power, 0.04, 1e-15);
}

}  // namespace
}  // namespace slipnav
