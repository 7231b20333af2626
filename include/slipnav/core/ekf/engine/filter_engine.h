#pragma once
/// The error-state extended Kalman filter: owns the covariance, consumes mechanised steps in order, applies wheel,
/// non-holonomic and zero updates at the stamps of the wheel samples, and tells the mechanisation what to correct.
///
/// A step is processed only when it is certain which wheel samples count inside it: when all of them are known up to
/// one at or after its end, when it ends before the next one is due, or when the IMU has gone on for `max_wait_s`.
/// Where wheel samples are further apart than usual, one may still be on its way. What is computed therefore depends on
/// the stamps, not on the order of arrival.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/ekf/adaptation/noise_adaptation.h"
#include "slipnav/core/ekf/adaptation/slipping_speed.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ekf/engine/gated_update.h"
#include "slipnav/core/ekf/engine/innovation.h"
#include "slipnav/core/ekf/engine/lasting_slip.h"
#include "slipnav/core/ekf/engine/mean_motion.h"
#include "slipnav/core/ekf/engine/runaway_watch.h"
#include "slipnav/core/ekf/engine/unseen_motion.h"
#include "slipnav/core/ekf/engine/wheel_queue.h"
#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/stationary_detector.h"
#include "slipnav/core/ekf/stuck_detector.h"
#include "slipnav/core/ins/ins_engine.h"
#include "slipnav/core/ordering/cadence.h"

namespace slipnav {

class FilterHistory;

/// Single-threaded; nothing is allocated once its queues have their size.
class FilterEngine {
 public:
  using EstimateSink = std::function<void(const Estimate&, const ErrorCovariance&)>;

  FilterEngine(const Planet& planet, const FilterSetup& setup);

  /// Starts anew from `initial`. Wheel samples that have come already and are later than it are kept.
  void initialise(const InitialState& initial);
  /// Drops everything.
  void reset();
  bool isInitialised() const { return initialised_; }

  /// Takes over gates, noise of measurements and limits of standstill for all steps that are yet to be processed. The
  /// rest of the setup has to be that of the constructor.
  void retune(const FilterSetup& setup);

  /// Tells `sink` of every innovation from now on.
  void onInnovation(InnovationSink sink) { on_innovation_ = std::move(sink); }

  /// Tells `history` of everything from the next start on, for a smoother. It changes no bit of the estimate.
  void keepHistory(std::shared_ptr<FilterHistory> history) { history_ = std::move(history); }

  /// Takes a step; one of an old epoch, or out of sequence, is ignored.
  void push(const InsStep& step);
  /// Takes a wheel sample; false when it is not finite, repeated, or lies before what has been processed.
  bool push(const WheelMotion& wheels);
  /// Takes a satellite position or velocity; false as above.
  bool push(const AntennaFix& fix);

  /// Puts the state that was processed last to another place. What is known of velocity in body axes, tilt, biases and
  /// slip stays. Throws std::invalid_argument for impossible numbers, and when nothing has been processed yet.
  Correction place(const Placement& placement);

  /// The state that was processed last, for a mechanisation that has lost its own and begins anew from it. Nothing when
  /// nothing has been processed yet.
  std::optional<Correction> reissue();

  /// Says that no wheel sample and no fix up to `stamp` is still to come.
  void assumeCompleteUpTo(Nanoseconds stamp) {
    wheels_.assumeCompleteUpTo(stamp);
    fixes_complete_until_ = std::max(fixes_complete_until_, stamp);
  }

  /// The stamp up to which wheel samples are known without a hole between them.
  Nanoseconds wheelsKnownUntil() const { return wheels_.knownUntil(); }
  /// Likewise for fixes, which are waited for with `gnss.use: always` alone; without, they are always known.
  Nanoseconds fixesKnownUntil() const;

  /// Processes steps in order until none is certain, or until a measurement corrects the state. Then the correction has
  /// to reach the mechanisation, whose new steps come back by push().
  std::optional<Correction> advance(const EstimateSink& sink);

  /// All that is needed to go on elsewhere, but for the origin of the map frame.
  InitialState snapshot() const;

  /// At the end of the step that was processed last.
  const ErrorCovariance& covariance() const { return P_; }
  const NavigationState& state() const { return state_; }
  const ErrorTransition& lastTransition() const { return transition_; }
  const ComponentStatus& status(Component component) const { return update_.status(component); }
  const ErrorDynamics& dynamics() const { return dynamics_; }
  const WheelMonitor& wheelMonitor() const { return wheel_monitor_; }
  /// Whether the rover stands while its wheels turn, as of the last wheel sample.
  bool isStuck() const { return stuck_.isStuck(); }
  /// How often the estimate had run away from its wheels and was begun anew.
  std::uint64_t recoveries() const { return recoveries_; }

 private:
  bool isCertain(const InsStep& step) const;
  Vector3 propagate(const InsStep& step);
  void endGap(const InsStep& step, const NavigationState& before);
  Vector3 referenceVelocity(const InsStep& step) const;
  void forgetSlipImpulse();
  bool applyWheels(const InsStep& step, const Vector3& v_mean_b);
  void addMotion(const InsStep& step, const Vector3& v_mean_b, Nanoseconds until);
  bool constraintsAreDue() const;
  bool applyWheelSample(const WheelMotion& wheels, const BodyMotion& motion);
  bool stand(const WheelMotion& wheels, const BodyMotion& motion);
  bool drive(const WheelMotion& wheels, const BodyMotion& motion);
  bool spinsOnTheSpot(const WheelMotion& wheels, const BodyMotion& motion);
  bool standOnSpinningWheels(const WheelMotion& wheels, const BodyMotion& motion);
  void recover(const WheelMotion& wheels);
  void openSlowSlip();
  void addForwardSpeed(const WheelMotion& wheels, const BodyMotion& motion, MeasurementSet& set);
  void addConstraints(Nanoseconds stamp, MeasurementSet& set);
  void tell(Component component, Nanoseconds stamp, const Measurement& measurement) const;
  void loosen(const Measurement& forward, Nanoseconds stamp, double jump);
  void noteWheels(const WheelMotion& wheels, double interval_s);
  bool applyFixes(const InsStep& step);
  void addFix(const PositionFix& fix, MeasurementSet& set) const;
  PlanarMotion soundMotion(const WheelMotion& wheels) const;
  bool update(MeasurementSet set);
  bool use(const Measurement& measurement);
  void forget(int index, double variance);
  void take(const ErrorVector& error);
  void conditionOnGround();
  void condition(int state, double variance, double value, double& envelope);
  void turnTo(double heading_rad, double heading_std_rad);

  Planet planet_;
  FilterSetup setup_;
  ErrorDynamics dynamics_;
  StationaryDetector detector_;
  GatedUpdate update_;
  UnseenMotion unseen_motion_;
  StuckDetector stuck_;
  RunawayWatch runaway_;
  std::uint64_t recoveries_ = 0;
  WheelMonitor wheel_monitor_;
  Tremor tremor_;
  NoiseAdaptation adaptation_;
  bool use_wheel_;
  bool use_nonholonomic_;
  bool use_zupt_;
  bool use_zaru_;

  bool initialised_ = false;
  NavigationState state_;
  VehicleState vehicle_;
  ErrorCovariance P_ = ErrorCovariance::Identity();
  ErrorTransition transition_;
  std::uint64_t next_sequence_ = 0;
  std::uint32_t epoch_ = 0;

  RingQueue<InsStep> steps_;
  WheelQueue wheels_;
  RingQueue<AntennaFix> fixes_;  ///< not yet applied, by stamp
  Cadence fix_cadence_;          ///< of those that have been worked off
  Nanoseconds fixes_complete_until_ = 0;
  Nanoseconds used_fix_ = 0;  ///< stamp of the newest one that passed, 0: none
  SlippingSpeed slipping_speed_;
  double last_forward_mps_ = 0.0;    ///< predicted, mean over the wheel interval before
  double way_since_wheels_m_ = 0.0;  ///< of the surface, in the last wheel interval
  double slow_envelope_ = 0.0;       ///< of the variance of slow slip in steady state
  double side_envelope_ = 0.0;
  LastingSlip lasting_slip_;
  double slipping_way_m_ = 0.0;     ///< over which wheel speeds have contradicted
  double surface_speed_mps_ = 0.0;  ///< of the wheels, last sample
  MeanMotion average_;              ///< over the wheel interval that is open
  MeanMotion constraint_average_;   ///< over the wheel intervals since the last constraint
  Estimate estimate_;
  InnovationSink on_innovation_;
  std::shared_ptr<FilterHistory> history_;  ///< where nobody smooths: none
};

}  // namespace slipnav
