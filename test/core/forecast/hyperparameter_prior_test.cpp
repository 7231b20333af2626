#include "core/forecast/hyperparameter_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/base/square.h"
#include "slipnav/core/base/types.h"

namespace slipnav {
namespace {

/// A quarter of a minute at 10 Hz, of slip about 20 %.
WindowScale windowScale() {
  WindowScale scale;
  scale.interval_s = 0.1;
  scale.span_s = 14.9;
  scale.mean_time_s = 7.5;
  scale.count = 150;
  scale.power = 0.05;
  scale.variance = 0.01;
  scale.difference_power = 0.003;
  return scale;
}

/// The priors of a model by the names of its hyperparameters.
std::map<std::string, LogPrior> priorsOf(const std::string& name, const WindowScale& scale = windowScale()) {
  const LatentModel model = latentModelByName(name);
  const std::vector<std::string> names = hyperparameterNames(model);
  const std::vector<LogPrior> priors = makePriors(model, scale, PriorParameters());
  std::map<std::string, LogPrior> by_name;
  for (std::size_t i = 0; i < names.size(); ++i) {
    by_name[names[i]] = priors.at(i);
  }
  return by_name;
}

double center(const LogPrior& prior) { return std::exp(prior.mean); }

TEST(HyperparameterPrior, VaryingSlipExplainsTheMeanOnlyWhereNothingElseDoes) {
  const WindowScale scale = windowScale();
  EXPECT_NEAR(center(priorsOf("rbf").at("variance")), scale.power, 1e-12);
  EXPECT_NEAR(center(priorsOf("ou_bias").at("variance")), scale.variance, 1e-12);
  EXPECT_NEAR(center(priorsOf("ou_bias").at("bias_variance")), scale.power, 1e-12);
}

/// The variance of Brownian slip grows with time; its mean over the window is that of the slip.
TEST(HyperparameterPrior, BrownianSlipIsAsStrongAsTheOtherOverTheWindow) {
  const WindowScale scale = windowScale();
  EXPECT_NEAR(center(priorsOf("paper").at("variance")) * scale.mean_time_s, scale.power, 1e-12);
}

/// Of slip a hundred times as large, or as small, as that of the window.
TEST(HyperparameterPrior, AVarianceMayBeOffByAFactorOfTenThousand) {
  const LogPrior prior = priorsOf("ou_bias").at("variance");
  EXPECT_NEAR(std::exp(prior.upper) / windowScale().variance, square(100.0), 1e-6);
  EXPECT_NEAR(windowScale().variance / std::exp(prior.lower), square(100.0), 1e-6);
}

TEST(HyperparameterPrior, SlipThatVariesDoesSoBetweenSampleAndWindow) {
  const WindowScale scale = windowScale();
  const LogPrior prior = priorsOf("ou").at("length_scale_s");
  EXPECT_NEAR(center(prior) / scale.interval_s, scale.span_s / center(prior), 1e-9);
  EXPECT_NEAR(std::exp(prior.lower), PriorParameters().min_length_scale_samples * scale.interval_s, 1e-12);
  EXPECT_NEAR(std::exp(prior.upper), PriorParameters().max_length_scale_spans * scale.span_s, 1e-12);
}

/// A window of so few samples that its longest length scale would be below its shortest one.
TEST(HyperparameterPrior, BoundsOfAShortWindowAreInOrder) {
  WindowScale scale = windowScale();
  scale.span_s = 2.0 * scale.interval_s;
  const LogPrior prior = priorsOf("ou", scale).at("length_scale_s");
  EXPECT_EQ(prior.lower, prior.upper);
}

/// What lasts for less than half a window is varying slip; over twenty it is a constant.
TEST(HyperparameterPrior, SlowSlipLastsLongerThanTheWindow) {
  const WindowScale scale = windowScale();
  const LogPrior prior = priorsOf("ou_slow").at("slow_length_scale_s");
  EXPECT_NEAR(center(prior), 2.0 * scale.span_s, 1e-9);
  EXPECT_NEAR(std::exp(prior.lower), 0.5 * scale.span_s, 1e-9);
  EXPECT_NEAR(std::exp(prior.upper), 20.0 * scale.span_s, 1e-9);
  EXPECT_GE(std::exp(prior.lower), std::exp(priorsOf("ou_slow").at("length_scale_s").upper) - 1e-9);
}

/// A variance that was estimated from n independent values is off by √(2/n) of itself.
TEST(HyperparameterPrior, StepsAreThoseThatTheWindowCanTell) {
  const WindowScale scale = windowScale();
  const auto valuesBehind = [](const LogPrior& prior) { return 2.0 / square(prior.typical_step); };
  const std::map<std::string, LogPrior> priors = priorsOf("ou_bias");
  EXPECT_NEAR(valuesBehind(priors.at("noise_variance")), static_cast<double>(scale.count), 1e-9);
  EXPECT_NEAR(valuesBehind(priors.at("bias_variance")), 2.0, 1e-9) << "one, and no variance is known better than that";
  const double length_scale_s = center(priors.at("length_scale_s"));
  const double integral_s = std::sqrt(2.0 * kPi) * length_scale_s;  // of the RBF
  EXPECT_NEAR(valuesBehind(priors.at("variance")) * integral_s / scale.span_s, 1.0, 0.01);
  EXPECT_EQ(priors.at("length_scale_s").typical_step, priors.at("variance").typical_step);
}

TEST(HyperparameterPrior, NoiseIsWhatChangesFromSampleToSample) {
  const WindowScale scale = windowScale();
  const PriorParameters parameters;
  const LogPrior prior = priorsOf("ou").at("noise_variance");
  EXPECT_NEAR(center(prior), scale.difference_power, 1e-12);
  EXPECT_NEAR(std::exp(prior.lower), parameters.min_noise_ratio * scale.difference_power, 1e-12);
  EXPECT_NEAR(std::exp(prior.upper), parameters.max_noise_ratio * scale.difference_power, 1e-12);
}

/// Cold fits differ in how fast slip varies, not in what is slow.
TEST(HyperparameterPrior, StartsDifferInTheLengthScaleOfVaryingSlipOnly) {
  const LatentModel model = latentModelByName("ou_slow");
  const std::vector<std::string> names = hyperparameterNames(model);
  const std::vector<LogPrior> priors = makePriors(model, windowScale(), PriorParameters());
  const Eigen::VectorXd moved = startPoint(model, priors, 1.5) - startPoint(model, priors, 1.0);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double expected = names[i] == "length_scale_s" ? std::log(1.5) : 0.0;
    EXPECT_NEAR(moved(static_cast<Eigen::Index>(i)), expected, 1e-12) << names[i];
  }
}

}  // namespace
}  // namespace slipnav
