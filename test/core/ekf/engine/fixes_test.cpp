/// Satellite positions while driving.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "evaluation/simulated_run.h"
#include "recorded_drive.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav::test {
namespace {

TEST(RepeatedFixFactor, IsOneForIndependentErrorsAndGrowsWithTheirLikeness) {
  EXPECT_EQ(repeatedFixFactor(0.1, 0.0), 1.0);
  EXPECT_NEAR(repeatedFixFactor(100.0, 1.0), 1.0, 1e-9);
  EXPECT_NEAR(repeatedFixFactor(0.1, 10.0), 200.0, 0.1);
  const double persistence = std::exp(-0.3);
  EXPECT_NEAR(repeatedFixFactor(0.3, 1.0), (1.0 + persistence) / (1.0 - persistence), 1e-9);
}

/// A drive of some meters, and fixes of its receiver that are exact but for what the simulator adds.
class Fixes : public ::testing::Test {
 protected:
  static constexpr double kNoise_m = 0.05;

  void SetUp() override {
    config_.simulator.gps.horizontal_noise_m = kNoise_m;
    config_.simulator.gps.vertical_noise_m = kNoise_m;
    drive_ = recordDrive(config_);
    NeverStop policy;
    simulateDrive(config_.simulator, Planet::byName(config_.planet), policy,
                  [this](const sim::Measurements& m, const sim::TruthState& truth) {
                    if (m.gps) {
                      fixes_.push_back(toPositionFix(*m.gps));
                    }
                    last_truth_ = truth;
                  });
  }

  /// @param late_s how long after the IMU sample of its time each fix comes
  EstimateLog run(const std::string& use, const std::vector<PositionFix>& fixes, double late_s = 0.0) {
    config_.gnss.use = use;
    const NavigationSetup setup = config_.navigation();
    Navigator navigator(Planet::byName(config_.planet), setup.imu_input, setup.filter);
    EstimateLog log;
    const auto sink = [&log](const Estimate& estimate, const ErrorCovariance& P) { log.push_back({estimate, P}); };
    navigator.initialize(drive_.initial);
    std::size_t next = 0;
    refused_ = 0;
    for (const DriveSample& sample : drive_.samples) {
      for (; next < fixes.size() && fixes[next].stamp + fromSeconds(late_s) <= sample.stamp(); ++next) {
        refused_ += navigator.push(AntennaFix(fixes[next])) ? 0 : 1;
      }
      sample.is_imu ? void(navigator.push(sample.imu, sink)) : void(navigator.push(sample.wheels, sink));
    }
    for (; next < fixes.size(); ++next) {
      refused_ += navigator.push(AntennaFix(fixes[next])) ? 0 : 1;
    }
    navigator.completeUpTo(drive_.samples.back().stamp(), sink);
    return log;
  }

  double finalError_m(const EstimateLog& log) const {
    const Planet planet = Planet::byName(config_.planet);
    const NavigationState truth = toNavState(last_truth_, planet, config_.imu.mount.position_b());
    return positionDifference(planet, log.back().estimate.nav.position, truth.position).head<2>().norm();
  }

  static double finalSigma_m(const EstimateLog& log) { return std::sqrt(log.back().P(kPosition, kPosition)); }

  Config config_ = driveConfig(30.0);
  RecordedDrive drive_;
  std::vector<PositionFix> fixes_;
  sim::TruthState last_truth_;
  int refused_ = 0;
};

TEST_F(Fixes, AreOfNoEffectUnlessAskedFor) {
  const EstimateLog without = run("start", {});
  EXPECT_TRUE(sameEstimates(without, run("always", {}))) << "without fixes the same bits";
  EXPECT_FALSE(sameEstimates(without, run("always", fixes_)));
}

TEST_F(Fixes, BoundTheErrorAsTheyDeserve) {
  config_.gnss.correlation_s = 0.0;
  const EstimateLog log = run("always", fixes_);
  EXPECT_LT(finalSigma_m(log), 0.3 * kNoise_m);
  EXPECT_LT(finalError_m(log), 5.0 * finalSigma_m(log));
  config_.gnss.correlation_s = 10.0;
  const EstimateLog careful = run("always", fixes_);
  EXPECT_GT(finalSigma_m(careful), 1.5 * finalSigma_m(log))
      << "many that share an error are worth little more than one";
}

/// The few fixes of a start are weighed by their drive, not by how alike their errors are.
TEST_F(Fixes, OfAStartCountInFull) {
  config_.gnss.correlation_s = 0.0;
  const EstimateLog independent = run("start", fixes_);
  config_.gnss.correlation_s = 10.0;
  EXPECT_TRUE(sameEstimates(independent, run("start", fixes_)));
  EXPECT_FALSE(sameEstimates(independent, run("start", {})));
}

TEST_F(Fixes, ThatComeLateGiveTheSameBits) {
  const EstimateLog prompt = run("always", fixes_);
  const EstimateLog late = run("always", fixes_, 0.8 * config_.gnss.max_wait_s);
  EXPECT_EQ(refused_, 0);
  EXPECT_TRUE(sameEstimates(prompt, late));
}

TEST_F(Fixes, ThatComeTooLateAreLeftOut) {
  const EstimateLog log = run("always", fixes_, config_.gnss.max_wait_s + 0.5);
  EXPECT_GT(refused_, static_cast<int>(fixes_.size()) / 2);
  EXPECT_EQ(log.size(), run("start", {}).size()) << "nothing waits for ever";
}

TEST_F(Fixes, ThatStandOffHaveNoEffect) {
  std::vector<PositionFix> with_outliers;
  std::vector<PositionFix> without;
  for (std::size_t i = 0; i < fixes_.size(); ++i) {
    PositionFix fix = fixes_[i];
    const bool outlier = i % 5 == 4;
    fix.position.latitude_rad += outlier ? 30.0 / 6.4e6 : 0.0;
    with_outliers.push_back(fix);
    if (!outlier) {
      without.push_back(fix);
    }
  }
  config_.gnss.correlation_s = 0.0;
  const EstimateLog log = run("always", with_outliers);
  EXPECT_LT(std::abs(finalError_m(log) - finalError_m(run("always", without))), 1e-3);
}

/// A filter that waits for wheels and fixes, and steps of a rover at rest.
class WaitingFilter : public ::testing::Test {
 protected:
  WaitingFilter() {
    initial_.nav.stamp = 1000 * kSecond;
    initial_.nav.position = {0.7, 0.1, 200.0};
    initial_.P = 1e-4 * ErrorCovariance::Identity();
    filter_.initialize(initial_);
  }

  static FilterSetup setup() {
    Config config;
    config.gnss.use = "always";
    return config.navigation().filter;
  }

  InsStep step(int number) const {
    InsStep step;
    step.start = initial_.nav.stamp + number * kSecond / 50;
    step.state = initial_.nav;
    step.state.stamp = step.start + kSecond / 50;
    step.f_ib_b = Vector3(0.0, 0.0, -9.8);
    return step;
  }
  void pushSteps() {
    for (int number = 0; number < 5; ++number) {
      filter_.push(step(number));
    }
  }
  AntennaFix fixAfter(Nanoseconds time) const {
    return PositionFix{initial_.nav.stamp + time, initial_.nav.position, Vector3::Ones()};
  }

  /// How many estimates there are, over all corrections.
  int advance() {
    int estimates = 0;
    filter_.advance([&estimates](const Estimate&, const ErrorCovariance&) { ++estimates; });
    return estimates;
  }

  InitialState initial_;
  FilterEngine filter_{Planet::byName("earth"), setup()};
};

TEST_F(WaitingFilter, AResetDropsEverything) {
  pushSteps();
  WheelMotion wheels;
  wheels.stamp = initial_.nav.stamp + kSecond / 50;
  EXPECT_TRUE(filter_.push(wheels));
  EXPECT_TRUE(filter_.push(fixAfter(kSecond / 100)));
  filter_.assumeCompleteUpTo(initial_.nav.stamp + 100 * kSecond);
  filter_.reset();
  EXPECT_FALSE(filter_.isInitialized());
  EXPECT_EQ(advance(), 0) << "no step is left";
  filter_.initialize(initial_);
  pushSteps();
  EXPECT_EQ(advance(), 0) << "it waits again";
  filter_.assumeCompleteUpTo(initial_.nav.stamp + kSecond);
  EXPECT_EQ(advance(), 5);
  EXPECT_EQ(filter_.status(kFixPosition).measured(), 0U);
  EXPECT_EQ(filter_.status(kZeroVelocity).measured(), 0U);
}

TEST_F(WaitingFilter, StepsThatDoNotContinueAreIgnored) {
  filter_.assumeCompleteUpTo(initial_.nav.stamp + kSecond);
  filter_.push(step(1));
  InsStep corrected = step(0);
  corrected.epoch = 1;
  filter_.push(corrected);
  EXPECT_EQ(advance(), 0);
  filter_.push(step(0));
  filter_.push(step(0));
  filter_.push(step(2));
  filter_.push(step(1));
  EXPECT_EQ(advance(), 2);
  FilterEngine without_start(Planet::byName("earth"), setup());
  without_start.push(step(0));
  without_start.initialize(initial_);
  without_start.assumeCompleteUpTo(initial_.nav.stamp + kSecond);
  EXPECT_FALSE(without_start.advance([](const Estimate&, const ErrorCovariance&) { FAIL(); }));
}

TEST_F(WaitingFilter, KeepsTheNewestFixes) {
  for (int i = 1; i <= 4100; ++i) {
    EXPECT_TRUE(filter_.push(fixAfter(i)));
  }
  filter_.push(step(0));
  filter_.assumeCompleteUpTo(initial_.nav.stamp + kSecond);
  EXPECT_EQ(advance(), 1);
  EXPECT_EQ(filter_.status(kFixPosition).measured(), 4096U);
}

TEST_F(WaitingFilter, FixesThatAreNotLaterOrNotFiniteAreRefused) {
  EXPECT_FALSE(filter_.push(fixAfter(0)));
  EXPECT_TRUE(filter_.push(fixAfter(1)));
  const double nan = std::nan("");
  for (int component = 0; component < 6; ++component) {
    PositionFix fix{initial_.nav.stamp + 2, initial_.nav.position, Vector3::Ones()};
    VelocityFix velocity{initial_.nav.stamp + 2, Vector3::Zero(), Vector3::Ones()};
    double* const position[] = {&fix.position.latitude_rad, &fix.position.longitude_rad, &fix.position.height_m};
    *(component < 3 ? position[component] : &fix.variance_ned_m2(component - 3)) = nan;
    (component < 3 ? velocity.v_ea_n(component) : velocity.variance_ned_m2ps2(component - 3)) = nan;
    EXPECT_FALSE(filter_.push(AntennaFix(fix))) << component;
    EXPECT_FALSE(filter_.push(AntennaFix(velocity))) << component;
  }
}

/// Without wheels it waits for fixes alone.
TEST_F(WaitingFilter, AResetForgetsThatFixesWereComplete) {
  FilterSetup only_fixes = setup();
  only_fixes.filter.updates.clear();
  filter_ = FilterEngine(Planet::byName("earth"), only_fixes);
  filter_.initialize(initial_);
  filter_.assumeCompleteUpTo(initial_.nav.stamp + 100 * kSecond);
  pushSteps();
  EXPECT_EQ(advance(), 5);
  filter_.reset();
  filter_.initialize(initial_);
  pushSteps();
  EXPECT_EQ(advance(), 0);
}

/// Nothing has moved meanwhile: what a fix says of the end holds for the start as well.
TEST_F(WaitingFilter, ASmootherTakesAFixBackToTheStart) {
  constexpr double kOff_m = 0.02;
  const Planet planet = Planet::byName("earth");
  const auto history = std::make_shared<FilterHistory>(planet);
  filter_.keepHistory(history);
  filter_.initialize(initial_);
  PositionFix fix{initial_.nav.stamp + kSecond / 11, initial_.nav.position, Vector3::Constant(1e-8)};
  fix.position.latitude_rad += kOff_m / (planet.meridianRadius(0.7) + 200.0);
  filter_.push(AntennaFix(fix));
  pushSteps();
  filter_.assumeCompleteUpTo(initial_.nav.stamp + kSecond);
  EXPECT_EQ(advance(), 5);
  const std::vector<SmoothedState> epochs = history->smooth();
  ASSERT_EQ(epochs.size(), 2U);
  for (const SmoothedState& epoch : epochs) {
    EXPECT_NEAR(positionDifference(planet, epoch.nav.position, initial_.nav.position).x(), kOff_m, 0.1 * kOff_m);
  }
}

}  // namespace
}  // namespace slipnav::test
