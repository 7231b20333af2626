#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav {
namespace {

/// A little less than a tenth of a second: stamps jitter.
constexpr Nanoseconds kSpacing = kSecond / 10 - kSecond / 1000;

}  // namespace

void FilterHistory::begin(const ErrorCovariance& P) {
  smoother_.begin(P);
  epochs_.clear();
  is_kept_ = true;
}

void FilterHistory::endStep(const NavigationState& nav, const VehicleState& vehicle, const Vector3& omega_ib_b,
                            const ErrorCovariance& P) {
  newest_ = {nav, vehicle, omega_ib_b};
  newest_P_ = P;
  is_kept_ = false;
  if (epochs_.empty() || nav.stamp - epochs_.back().nav.stamp >= kSpacing) {
    keepNewest();
  }
}

void FilterHistory::keepNewest() {
  smoother_.keep(newest_P_);
  epochs_.push_back(newest_);
  is_kept_ = true;
}

std::vector<SmoothedState> FilterHistory::smooth() {
  if (!is_kept_) {
    keepNewest();
  }
  const std::vector<SmoothedError> errors = smoother_.smooth();
  std::vector<SmoothedState> smoothed;
  smoothed.reserve(epochs_.size());
  for (std::size_t i = 0; i < epochs_.size(); ++i) {
    const ErrorVector& error = errors[i].error;
    SmoothedState epoch{epochs_[i].nav, epochs_[i].vehicle, epochs_[i].omega_ib_b, errors[i].P};
    applyReset(::slipnav::correct(planet_, error, epoch.nav), epoch.P);
    subtractError(error, epoch.vehicle);
    epoch.omega_ib_b += error.segment<3>(kGyroBias);
    smoothed.push_back(epoch);
  }
  return smoothed;
}

}  // namespace slipnav
