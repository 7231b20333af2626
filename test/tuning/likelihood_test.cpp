#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tuning/drive_likelihood.h"
#include "tuning/gain.h"
#include "tuning_drive.h"

namespace slipnav::test {
namespace {

DriveLikelihood oneStretch(Component kind, int measurements, double each) {
  DriveLikelihood likelihood(1);
  InnovationSums& sums = likelihood[0][kind];
  sums.measurements = sums.rows = measurements;
  sums.log_likelihood = measurements * each;
  return likelihood;
}

double gainOf(const DriveLikelihood& base, const DriveLikelihood& other) {
  return gainsOver(base, other, {0, 0, 1})[0];
}

TEST(TuningLikelihoodTest, aPlainGaussianInsideTheGate) {
  InnovationSums sums;
  sums.add({1, 4.0, std::log(0.25)});
  EXPECT_NEAR(sums.log_likelihood, std::log(std::exp(-2.0) / (0.5 * std::sqrt(2.0 * kPi))), 1e-12);
  EXPECT_EQ(sums.squared, 4.0);
}

/// exp(−½ρ(r²/S))/√S over r, to a constant the same for every S: a density.
TEST(TuningLikelihoodTest, theTailIsThatOfADensity) {
  const auto mass = [](double from, double to) {
    double sum = 0.0;
    const double step = 1.0001;
    for (double r = from; r < to; r *= step) {
      sum += std::exp(-0.5 * robustSquare(1, r * r)) * r * (step - 1.0);
    }
    return sum;
  };
  EXPECT_LT(mass(3.29, 1e6), 2e-3);
  EXPECT_GT(mass(3.29, 10.0), 0.9 * mass(3.29, 1e6));
  const double gate = 10.8276;
  EXPECT_NEAR(robustSquare(1, gate + 1e-6), gate, 1e-3);
  const double slope = (robustSquare(1, gate + 1e-3) - robustSquare(1, gate - 1e-3)) / 2e-3;
  EXPECT_NEAR(slope, 1.0, 1e-3);
}

/// Were an outlier cut off instead, the likelihood would grow without bound when S shrinks.
TEST(TuningLikelihoodTest, nothingIsGainedByRejectingAll) {
  double last = std::numeric_limits<double>::infinity();
  for (const double variance : {1.0, 0.01, 1e-4, 1e-8}) {
    InnovationSums sums;
    sums.add({1, 1.0 / variance, std::log(variance)});
    EXPECT_LT(sums.log_likelihood, last);
    last = sums.log_likelihood;
  }
}

TEST(TuningLikelihoodTest, moreMeasurementsAreNoGain) {
  EXPECT_NEAR(gainOf(oneStretch(kLateral, 10, 3.0), oneStretch(kLateral, 14, 3.0)), 0.0, 1e-12);
  EXPECT_NEAR(gainOf(oneStretch(kLateral, 10, 3.0), oneStretch(kLateral, 5, 3.5)), 5.0, 1e-12);
}

TEST(TuningLikelihoodTest, measurementsThatVanishAreALoss) {
  EXPECT_NEAR(gainOf(oneStretch(kZeroVelocity, 7, 12.0), oneStretch(kLateral, 5, 3.5)), -70.0, 1e-12);
}

/// The navigation is the same whether somebody listens or not, and every wheel sample that is compared is told.
TEST(TuningLikelihoodTest, aDriveIsScoredFromItsStartOn) {
  const Config config = tuningConfig(1, 20.0);
  const TuningDrive drive = simulateTuningDrive(config);
  const DriveLikelihood likelihood = likelihoodOf(drive, config, stretchCount(drive));
  const ComponentSums sums = sumsOf(likelihood, {0, 0, likelihood.size()});
  EXPECT_GT(sums[kForwardSpeed].measurements, 200.0);
  EXPECT_GT(sums[kYawRate].measurements, 200.0);
  EXPECT_GT(sums[kLateral].measurements, 15.0);
  EXPECT_EQ(sums[kLateral].measurements, sums[kVertical].measurements);
  EXPECT_EQ(sums[kZeroVelocity].rows, 3.0 * sums[kZeroVelocity].measurements);
  EXPECT_GT(sums[kZeroVelocity].measurements, 20.0);
}

TEST(TuningLikelihoodTest, theBeginningOfADriveIsThatOfTheWhole) {
  const Config config = tuningConfig(1, 20.0);
  const TuningDrive drive = simulateTuningDrive(config);
  const DriveLikelihood whole = likelihoodOf(drive, config, stretchCount(drive));
  const DriveLikelihood begin = likelihoodOf(drive, config, 4);
  for (std::size_t stretch = 0; stretch < 3; ++stretch) {  // the last one may lack what its end decides
    EXPECT_EQ(whole[stretch][kForwardSpeed].log_likelihood, begin[stretch][kForwardSpeed].log_likelihood) << stretch;
  }
}

/// An outlier is told as well, though the filter rejects it.
TEST(TuningLikelihoodTest, whatIsRejectedCounts) {
  const Config config = tuningConfig(1, 20.0);
  TuningDrive drive = simulateTuningDrive(config);
  const auto likelihood = [&drive, &config] {
    const DriveLikelihood all = likelihoodOf(drive, config, stretchCount(drive));
    return sumsOf(all, {0, 0, all.size()})[kForwardSpeed];
  };
  const InnovationSums before = likelihood();
  int samples = 0;
  for (Sample& sample : drive.samples) {
    if (auto* wheels = std::get_if<WheelMotion>(&sample); wheels != nullptr && ++samples == 200) {
      wheels->motion.forward_mps += 4.0;
    }
  }
  const InnovationSums after = likelihood();
  EXPECT_NEAR(after.measurements, before.measurements, 2.0);
  EXPECT_LT(after.log_likelihood, before.log_likelihood - 10.0);
  EXPECT_GT(after.log_likelihood, before.log_likelihood - 200.0);
}

}  // namespace
}  // namespace slipnav::test
