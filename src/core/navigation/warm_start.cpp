#include "core/navigation/warm_start.h"

#include <utility>

namespace slipnav {

WarmStart::WarmStart(const Planet& planet, const CheckpointParams& params, const FilterSetup& setup)
    : params_(params), prior_variance_(ErrorDynamics(planet, setup.imu, setup.vehicle).priorVariance()) {
  if (params.enabled()) {
    LoadedCheckpoint loaded = loadCheckpoint(params.place());
    checkpoint_ = std::move(loaded.checkpoint);
    refused_ = std::move(loaded.refused);
  }
}

InitialState WarmStart::resume(Nanoseconds now) {
  const Checkpoint checkpoint = *std::exchange(checkpoint_, std::nullopt);
  unwatched_s_ = toSeconds(now - checkpoint.state.nav.stamp);
  return resumeFrom(checkpoint, now, prior_variance_, params_);
}

void WarmStart::deleteFiles() {
  forget();
  if (params_.enabled()) {
    deleteCheckpoint(params_.place());
  }
}

}  // namespace slipnav
