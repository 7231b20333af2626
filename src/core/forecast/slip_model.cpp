#include "core/forecast/slip_model.h"

namespace slipnav {

const char* toString(SlipFitStatus status) {
  switch (status) {
    case SlipFitStatus::kConverged:
      return "converged";
    case SlipFitStatus::kNotConverged:
      return "not converged";
    case SlipFitStatus::kKeptPrevious:
      return "kept previous";
    case SlipFitStatus::kDefaults:
      return "defaults";
    case SlipFitStatus::kConstantSlip:
      return "constant slip";
    case SlipFitStatus::kTooFewSamples:
      return "too few samples";
    case SlipFitStatus::kOriginAfterSample:
      return "origin after sample";
    case SlipFitStatus::kNotPositiveDefinite:
      return "not positive definite";
  }
  return "unknown";
}

bool isAccepted(SlipFitStatus status) {
  return status != SlipFitStatus::kTooFewSamples && status != SlipFitStatus::kOriginAfterSample &&
         status != SlipFitStatus::kNotPositiveDefinite;
}

double SlipFit::hyperparameter(const std::string& name) const {
  for (const auto& [key, value] : hyperparameters) {
    if (key == name) {
      return value;
    }
  }
  return 0.0;
}

}  // namespace slipnav
