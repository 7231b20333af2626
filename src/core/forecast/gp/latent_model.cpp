#include "core/forecast/gp/latent_model.h"

#include <stdexcept>
#include <utility>

namespace slipnav {
namespace {

constexpr LatentComponent kPaper{ComponentRole::kSlip, Correlation::kRbf, true};
constexpr LatentComponent kRbf{ComponentRole::kSlip, Correlation::kRbf, false};
constexpr LatentComponent kOu{ComponentRole::kSlip, Correlation::kMatern12, false};
constexpr LatentComponent kMatern32{ComponentRole::kSlip, Correlation::kMatern32, false};
constexpr LatentComponent kBrownianMatern52{ComponentRole::kSlip, Correlation::kMatern52, true};
constexpr LatentComponent kBias{ComponentRole::kBias, Correlation::kConstant, false};
constexpr LatentComponent kSlow{ComponentRole::kSlow, Correlation::kMatern12, false};

const std::vector<std::pair<std::string, LatentModel>>& catalogue() {
  static const std::vector<std::pair<std::string, LatentModel>> models = {
      {"paper", {kPaper}},
      {"paper_bias", {kPaper, kBias}},
      {"paper_slow", {kPaper, kSlow}},
      {"brownian_matern", {kBrownianMatern52}},
      {"rbf", {kRbf}},
      {"rbf_bias", {kRbf, kBias}},
      {"rbf_slow", {kRbf, kSlow}},
      {"matern_bias", {kMatern32, kBias}},
      {"ou", {kOu}},
      {"ou_bias", {kOu, kBias}},
      {"ou_slow", {kOu, kSlow}},
  };
  return models;
}

KernelPtr makeCorrelation(Correlation correlation) {
  switch (correlation) {
    case Correlation::kRbf:
      return std::make_shared<RbfKernel>(1.0);
    case Correlation::kMatern12:
      return std::make_shared<MaternKernel>(MaternOrder::kHalf, 1.0);
    case Correlation::kMatern32:
      return std::make_shared<MaternKernel>(MaternOrder::kThreeHalves, 1.0);
    case Correlation::kMatern52:
      return std::make_shared<MaternKernel>(MaternOrder::kFiveHalves, 1.0);
    case Correlation::kMatern72:
      return std::make_shared<MaternKernel>(MaternOrder::kSevenHalves, 1.0);
    case Correlation::kConstant:
      break;
  }
  throw std::logic_error("latent model: a constant component has no correlation kernel");
}

KernelPtr makeKernel(const LatentComponent& component) {
  KernelPtr kernel = std::make_shared<ConstantKernel>(1.0);
  if (component.brownian) {
    kernel = kernel * std::make_shared<BrownianKernel>();
  }
  return component.hasLengthScale() ? kernel * makeCorrelation(component.correlation) : kernel;
}

std::string prefix(ComponentRole role) {
  switch (role) {
    case ComponentRole::kBias:
      return "bias_";
    case ComponentRole::kSlow:
      return "slow_";
    case ComponentRole::kSlip:
      break;
  }
  return "";
}

}  // namespace

const std::vector<std::string>& latentModelNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& entry : catalogue()) {
      result.push_back(entry.first);
    }
    return result;
  }();
  return names;
}

LatentModel latentModelByName(const std::string& name) {
  for (const auto& [known, model] : catalogue()) {
    if (known == name) {
      return model;
    }
  }
  throw std::invalid_argument("forecast.model: unknown slip model '" + name + "'");
}

KernelPtr makeKernel(const LatentModel& model) {
  if (model.empty()) {
    throw std::invalid_argument("latent model: no component");
  }
  KernelPtr kernel = makeKernel(model.front());
  for (std::size_t i = 1; i < model.size(); ++i) {
    kernel = kernel + makeKernel(model[i]);
  }
  return kernel;
}

std::vector<std::string> hyperparameterNames(const LatentModel& model) {
  std::vector<std::string> names;
  for (const LatentComponent& component : model) {
    names.push_back(prefix(component.role) + "variance");
    if (component.hasLengthScale()) {
      names.push_back(prefix(component.role) + "length_scale_s");
    }
  }
  names.push_back("noise_variance");
  return names;
}

}  // namespace slipnav
