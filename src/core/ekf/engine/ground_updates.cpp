/// The part of FilterEngine that follows the ground: how much its slip may be, and what the way has shown of it.

#include <algorithm>
#include <cmath>

#include "core/base/square.h"
#include "core/ekf/possible_slip.h"
#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav {
namespace {

constexpr double kMoreThanSteady = 1.1;
constexpr double kEnvelope_m = 8.0;

}  // namespace

/// Persistent slip is a property of the ground. If the ground turns out worse, it may have changed at once; if
/// better, the state is conditioned on it: 1/R = 1/σ² − 1/P. The envelope over some meters keeps the two from
/// alternating.
void FilterEngine::conditionOnGround() {
  const GroundStep& ground = adaptation_.ground();
  condition(kSlowSlip, ground.slow_slip_variance, vehicle_.slow_slip, slow_envelope_);
  condition(kSideSlip, ground.side_slip_variance, vehicle_.side_slip, side_envelope_);
}

void FilterEngine::condition(int state, double variance, double value, double& envelope) {
  if (variance > envelope) {
    P_(state, state) += envelope > 0.0 ? variance - envelope : 0.0;
    envelope = variance;
    return;
  }
  envelope = std::max(variance, envelope * std::exp(-way_since_wheels_m_ / kEnvelope_m));
  if (envelope > 0.0 && P_(state, state) > kMoreThanSteady * envelope) {
    Measurement m(1);
    m.residual(0) = -value;
    m.H(0, state) = 1.0;
    m.variance(0) = 1.0 / (1.0 / envelope - 1.0 / P_(state, state));
    use(m, false);
  }
}

/// What rest has taught of an accelerometer is not exact in motion: vibration shifts its bias. Only along the vertical,
/// where the shift would become a vertical speed; across, it could not be told from tilt at the next stop, which
/// would cost what stops have taught of both.
void FilterEngine::allowForBiasShift() {
  const Vector3 up_b = state_.q_b_to_n.conjugate() * -Vector3::UnitZ();
  P_.block<3, 3>(kAccelBias, kAccelBias) += adaptation_.biasShiftVariance() * up_b * up_b.transpose();
}

/// Only where the way since the last stop contradicts the filter as a standstill must in order to fail its gate: less
/// is as well explained by a shift of the accelerometers' biases. Nor where the slip would be one that no ground has.
void FilterEngine::allowForUnexpectedSlip() {
  if (setup_.vehicle.slow_slip_std <= 0.0 || unexpected_slip_.squared() <= update_.zeroGate(UnexpectedSlip::kTerms)) {
    return;
  }
  const UnexpectedSlip::Finding found = unexpected_slip_.finding();
  if (!canLast(found.slip) || !canLast(vehicle_.slow_slip - found.error(kSlowSlip))) {
    return;
  }
  ++unexpected_slips_;
  slow_slip_lasts_ = true;
  P_ += found.P;
  if (history_) {
    history_->advance(P_);
  }
  take(found.error);
  unexpected_slip_.begin();
}

void FilterEngine::openSlowSlip() {
  const GroundStep& ground = adaptation_.ground();
  if (lasting_slip_.add(vehicle_.fast_slip, std::sqrt(ground.fast_slip_variance), way_since_wheels_m_,
                        setup_.vehicle.fast_slip_length_m)) {
    P_(kSlowSlip, kSlowSlip) += square(vehicle_.fast_slip);
    P_(kFastSlip, kFastSlip) += square(vehicle_.fast_slip);
    slow_envelope_ = std::max(slow_envelope_, square(vehicle_.fast_slip));
  }
}

}  // namespace slipnav
