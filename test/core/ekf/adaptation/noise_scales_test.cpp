#include "slipnav/core/ekf/adaptation/noise_scales.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/square.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

/// Innovations that a learned noise explains but for `rest`, of a true standard deviation.
void learn(NoiseScales& scales, NoiseKind kind, double true_std, double rest, int samples) {
  sim::RandomStream random(1, "innovations");
  for (int i = 0; i < samples; ++i) {
    NoiseVector shares = NoiseVector::Zero();
    shares(kind) = scales.factor(kind);  // configured: 1
    const double r = std::sqrt(square(true_std) + rest) * random.normal();
    scales.learn(shares, square(r), shares(kind) + rest);
    scales.fade(0.08);
  }
}

TEST(NoiseScales, LearnsUpAndDown) {
  for (const double true_std : {0.1, 0.5, 3.0, 10.0}) {
    NoiseScales scales({});
    learn(scales, kLateralNoise, true_std, 0.0, 2000);
    EXPECT_NEAR(std::sqrt(scales.factor(kLateralNoise)) / true_std, 1.0, 0.25) << true_std;
    EXPECT_EQ(scales.factor(kVerticalNoise), 1.0);
  }
}

/// No news is not good news: what is measured is all somebody else's noise.
TEST(NoiseScales, WhatCannotBeSeenStays) {
  NoiseScales scales({});
  learn(scales, kFastSlipNoise, 0.0, 1e4, 2000);
  EXPECT_NEAR(scales.factor(kFastSlipNoise), 1.0, 0.1);
}

TEST(NoiseScales, OneOutlierDoesNotTurnARoadIntoSand) {
  NoiseScales scales({});
  learn(scales, kFastSlipNoise, 0.1, 0.0, 2000);
  const double before = scales.factor(kFastSlipNoise);
  NoiseVector shares = NoiseVector::Zero();
  shares(kFastSlipNoise) = before;
  scales.learn(shares, 1e6, before);
  EXPECT_LT(scales.factor(kFastSlipNoise), 2.0 * before);
}

/// Five and a half sigma may be noise, and count for what they are; what is farther out counts no more than that.
TEST(NoiseScales, AnInnovationBeyondAllNoiseCountsAsTheLargestThatMayBeNoise) {
  const auto after = [](double nis) {
    NoiseScales scales({});
    NoiseVector shares = NoiseVector::Zero();
    shares(kWheelNoise) = 0.25;
    scales.learn(shares, nis * 4.0, 4.0);
    return scales.factor(kWheelNoise);
  };
  EXPECT_GT(after(30.0), 1.01 * after(25.0));
  EXPECT_EQ(after(31.0), after(30.0));
  EXPECT_EQ(after(1e6), after(30.0));
}

TEST(NoiseScales, ForgetsOverTheWay) {
  NoiseScales scales({});
  learn(scales, kFastSlipNoise, 0.1, 0.0, 500);
  ASSERT_LT(scales.factor(kFastSlipNoise), 0.1);
  scales.fade(2000.0);
  EXPECT_NEAR(scales.factor(kFastSlipNoise), 1.0, 1e-3);
}

/// Wheels are compared every tenth of a meter, constraints every meter. Either way what was learned is two thirds new
/// after one length.
TEST(NoiseScales, WhatHasChangedIsLearnedWithinALength) {
  const NoiseScaleParams params;
  const std::vector<std::pair<NoiseKind, double>> intervals_m = {
      {kWheelNoise, 0.1}, {kFastSlipNoise, 0.1}, {kLateralNoise, 1.0}, {kVerticalNoise, 1.0}};
  for (const auto& [kind, interval_m] : intervals_m) {
    NoiseScales scales(params);
    const auto drive = [&, kind = kind, interval_m = interval_m](double true_std, double lengths) {
      for (double way_m = 0.0; way_m < lengths * params.length_m; way_m += interval_m) {
        NoiseVector shares = NoiseVector::Zero();
        shares(kind) = scales.factor(kind);
        scales.learn(shares, square(true_std), shares(kind));
        scales.fade(interval_m);
      }
    };
    drive(1.0, 20.0);
    const double before = std::log(scales.factor(kind));
    constexpr double kChanged = 1.1;
    drive(kChanged, 1.0);
    const double learned = (std::log(scales.factor(kind)) - before) / std::log(square(kChanged));
    EXPECT_NEAR(learned, 1.0 - std::exp(-1.0), 0.05) << kind;
  }
}

/// Equally uncertain factors learn the same from the same innovation.
TEST(NoiseScales, LearnsAsFastAsItsFactorIsUncertain) {
  const auto after = [](NoiseKind kind, double factor_std) {
    NoiseScaleParams params;
    params.factor_std = params.slip_factor_std = params.whiteness_factor_std = factor_std;
    params.whiteness = 1.0;
    NoiseScales scales(params);
    NoiseVector shares = NoiseVector::Zero();
    shares(kind) = 1.0;
    scales.learn(shares, 0.2, 4.0);
    return scales.factor(kind);
  };
  for (int kind = 0; kind < kNoiseKinds; ++kind) {
    EXPECT_EQ(after(static_cast<NoiseKind>(kind), 2.0), after(kLateralNoise, 2.0)) << kind;
    EXPECT_LT(after(static_cast<NoiseKind>(kind), 3.0), after(static_cast<NoiseKind>(kind), 2.0)) << kind;
  }
}

TEST(NoiseScales, ShakingIsNeverMoreThanWhite) {
  NoiseScales scales({});
  learn(scales, kVibrationNoise, 10.0, 0.0, 500);
  EXPECT_LE(scales.factor(kVibrationNoise), 1.0);
}

TEST(NoiseScales, WhatIsNotFiniteChangesNothing) {
  NoiseScales scales({});
  NoiseVector shares = NoiseVector::Constant(1.0);
  scales.learn(shares, std::nan(""), 7.0);
  scales.learn(shares, 1.0, 0.0);
  EXPECT_EQ(scales.factor(kWheelNoise), 1.0);
}

/// Natural logarithms of the largest factor that is still noise, and of the smallest of all.
TEST(NoiseScales, NoFactorLeavesWhatIsPossible) {
  const std::vector<double> largest = {9.0, 2.2, 3.2, 4.2, 3.2, 4.2, 0.0};
  NoiseScaleParams unknown;
  unknown.factor_std = unknown.slip_factor_std = unknown.whiteness_factor_std = 100.0;
  unknown.length_m = 0.1;  // what was learned is forgotten at once
  for (int i = 0; i < kNoiseKinds; ++i) {
    const NoiseKind kind = static_cast<NoiseKind>(i);
    const auto after = [&unknown, kind](double squared) {
      NoiseScales scales(unknown);
      NoiseVector shares = NoiseVector::Zero();
      for (int sample = 0; sample < 100; ++sample) {
        scales.fade(0.05);
        shares(kind) = scales.factor(kind);
        scales.learn(shares, squared, shares(kind));
      }
      return scales.factor(kind);
    };
    EXPECT_DOUBLE_EQ(after(0.0), std::exp(-9.0)) << kind;
    EXPECT_DOUBLE_EQ(after(1e9), std::exp(largest.at(static_cast<std::size_t>(i)))) << kind;
  }
}

TEST(NoiseScales, AfterALongWayItIsLikeANewOne) {
  NoiseScales scales({});
  NoiseScales fresh({});
  for (int i = 0; i < kNoiseKinds; ++i) {
    learn(scales, static_cast<NoiseKind>(i), 0.3, 0.0, 50);
  }
  scales.fade(1e6);
  const NoiseVector shares = NoiseVector::LinSpaced(0.1, 0.7);
  for (NoiseScales* each : {&scales, &fresh}) {
    each->learn(shares, 7.0, 4.0);
  }
  for (int i = 0; i < kNoiseKinds; ++i) {
    const double factor = fresh.factor(static_cast<NoiseKind>(i));
    EXPECT_NEAR(scales.factor(static_cast<NoiseKind>(i)), factor, 0.02 * factor) << i;
  }
}

TEST(NoiseScales, WhatNoNoiseExplainsTeachesNothing) {
  NoiseScales scales({});
  scales.learn(NoiseVector::Zero(), 5.0, 1.0);
  for (int i = 0; i < kNoiseKinds; ++i) {
    EXPECT_EQ(scales.factor(static_cast<NoiseKind>(i)), 1.0) << i;
  }
}

TEST(NoiseScales, ShakingThatIsNotWhiteAtAllCanStillBeLearned) {
  NoiseScaleParams params;
  params.whiteness = 0.0;
  EXPECT_NEAR(NoiseScales(params).factor(kVibrationNoise), 1e-4, 1e-12);
  params.whiteness = 0.5;
  EXPECT_DOUBLE_EQ(NoiseScales(params).factor(kVibrationNoise), 0.5);
}

}  // namespace
}  // namespace slipnav::test
