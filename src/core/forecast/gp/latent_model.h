#pragma once
/// The Gaussian process models of slip by name: sums of a few components, each a correlation shape with a variance.
///
/// One description serves both implementations of the regression: makeKernel() for the dense one, the transition of
/// markov_shape.h for the one in state-space form. doc/slip_gaussian_process.md has the equations.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/forecast/gp/kernel.h"

namespace slipnav {

/// Shape of a component's correlation over time.
enum class Correlation { kConstant, kRbf, kMatern12, kMatern32, kMatern52, kMatern72 };

/// Purpose of a component; decides its priors and its name prefix.
enum class ComponentRole {
  kSlip,  ///< slip that varies within the window
  kBias,  ///< constant over window and horizon
  kSlow,  ///< persists longer than the window
};

/// variance · correlation(t − t'; length scale) [· min(t, t') when `brownian`]
struct LatentComponent {
  ComponentRole role = ComponentRole::kSlip;
  Correlation correlation = Correlation::kRbf;
  bool brownian = false;

  bool hasLengthScale() const { return correlation != Correlation::kConstant; }
};

/// Components add up. Hyperparameters in order: per component log variance and, if it has one, log length scale; then
/// log noise variance.
using LatentModel = std::vector<LatentComponent>;

/// Names that latentModelByName() knows, the paper's first.
const std::vector<std::string>& latentModelNames();

/// Throws std::invalid_argument naming an unknown model.
LatentModel latentModelByName(const std::string& name);

/// The kernel of f: everything but the white noise.
KernelPtr makeKernel(const LatentModel& model);

/// "variance", "length_scale_s", "bias_variance", …, "noise_variance", in the order of the hyperparameter vector.
std::vector<std::string> hyperparameterNames(const LatentModel& model);

}  // namespace slipnav
