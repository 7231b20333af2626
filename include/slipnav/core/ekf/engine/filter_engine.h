#pragma once
/// The error-state extended Kalman filter: owns the covariance, consumes mechanized steps in order, applies wheel,
/// non-holonomic and zero updates at the stamps of the wheel samples, and sends corrections to the mechanization.
///
/// A step is processed once it is certain which wheel samples belong to it: when all of them are known up to
/// or past its end, when it ends before the next one is due, or when the IMU has advanced by `max_wait_s`.
/// Where wheel samples are further apart than usual, one may still be on its way. The result therefore depends on
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
#include "slipnav/core/ekf/engine/imu_gap_uncertainty.h"
#include "slipnav/core/ekf/engine/innovation.h"
#include "slipnav/core/ekf/engine/lasting_slip.h"
#include "slipnav/core/ekf/engine/mean_motion.h"
#include "slipnav/core/ekf/engine/runaway_watch.h"
#include "slipnav/core/ekf/engine/unexpected_slip.h"
#include "slipnav/core/ekf/engine/wheel_queue.h"
#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/stationary_detector.h"
#include "slipnav/core/ekf/stuck_detector.h"
#include "slipnav/core/ins/ins_engine.h"
#include "slipnav/core/ordering/sample_interval.h"

namespace slipnav {

class FilterHistory;

/// Single-threaded; no allocation once its queues have reached their size.
class FilterEngine {
 public:
  using EstimateSink = std::function<void(const Estimate&, const ErrorCovariance&)>;

  FilterEngine(const Planet& planet, const FilterSetup& setup);

  /// Restarts from `initial`. Wheel samples already received that are later than it are kept.
  void initialize(const InitialState& initial);
  /// Drops everything.
  void reset();
  bool isInitialized() const { return initialized_; }
  /// Counts the corrections since then; steps of an older epoch are void.
  std::uint32_t epoch() const { return epoch_; }

  /// Replaces gates, measurement noise and standstill limits for all steps not yet processed. The
  /// rest of the setup must equal that of the constructor.
  void retune(const FilterSetup& setup);

  /// Passes every innovation to `sink` from now on.
  void onInnovation(InnovationSink sink) { on_innovation_ = std::move(sink); }

  /// Records everything from the next start on in `history`, for a smoother. It changes no bit of the estimate.
  void keepHistory(std::shared_ptr<FilterHistory> history) { history_ = std::move(history); }

  /// Adds a step; one of an old epoch, or that does not start where the one before ends, is ignored.
  void push(const InsStep& step);
  /// Adds a wheel sample; false if it is not finite, repeated, or before what has been processed.
  bool push(const WheelMotion& wheels);
  /// Adds a satellite position or velocity; false as above.
  bool push(const AntennaFix& fix);

  /// Moves the last processed state to another place. Knowledge of body-frame velocity, tilt, biases and
  /// slip is kept. Throws std::invalid_argument for impossible numbers, and when nothing has been processed yet.
  Correction place(const PoseOverride& pose);

  /// The last processed state, for a mechanization that has lost its own and restarts from it. Nothing if
  /// nothing has been processed yet.
  std::optional<Correction> reissue();

  /// Declares that no wheel sample and no fix up to `stamp` is still to come.
  void assumeCompleteUpTo(Nanoseconds stamp) {
    wheels_.assumeCompleteUpTo(stamp);
    fixes_complete_until_ = std::max(fixes_complete_until_, stamp);
  }

  /// Processes steps in order until none is certain, or until a measurement corrects the state. The correction must
  /// then reach the mechanization, whose new steps come back by push().
  /// @param trusted end of a step by which a silent sensor may be judged to be silent; if absent, that of the newest
  std::optional<Correction> advance(const EstimateSink& sink, std::optional<Nanoseconds> trusted = std::nullopt);

  /// Everything needed to resume elsewhere, except the origin of the map frame.
  InitialState snapshot() const;

  /// At the end of the last processed step.
  const ErrorCovariance& covariance() const { return P_; }
  const NavigationState& state() const { return state_; }
  const ErrorTransition& lastTransition() const { return transition_; }
  const ComponentStatus& status(Component component) const { return update_.status(component); }
  const ErrorDynamics& dynamics() const { return dynamics_; }
  const WheelMonitor& wheelMonitor() const { return wheel_monitor_; }
  /// Whether the rover stands while its wheels turn, as of the last wheel sample.
  bool isStuck() const { return estimate_.stuck; }
  /// How often the estimate ran away from its wheels and was restarted.
  std::uint64_t recoveries() const { return recoveries_; }
  /// How often the way since the last stop has shown a slip that was not expected.
  std::uint64_t unexpectedSlips() const { return unexpected_slips_; }

 private:
  /// The stamp up to which fixes are known without a hole; those not waited for are always known.
  Nanoseconds fixesKnownUntil() const;
  bool isCertain(Nanoseconds end, Nanoseconds trusted) const;
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
  bool hasRunAway(const WheelMotion& wheels, const BodyMotion& motion);
  bool spinsOnTheSpot(const WheelMotion& wheels, const BodyMotion& motion);
  bool standOnSpinningWheels(const WheelMotion& wheels, const BodyMotion& motion);
  void recover(const WheelMotion& wheels);
  /// The slip if it is significant, else 0. @param state its index
  double shown(int state, double slip) const;
  bool isSlip(double contradiction_mps) const;
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
  bool use(const Measurement& measurement, bool is_evidence = true);
  void allowForUnexpectedSlip();
  void forget(int index, double variance);
  void take(const ErrorVector& error);
  void conditionOnGround();
  void allowForBiasShift();
  void condition(int state, double variance, double value, double& envelope);
  void turnTo(double heading_rad, double heading_std_rad);

  Planet planet_;
  FilterSetup setup_;
  ErrorDynamics dynamics_;
  StationaryDetector detector_;
  GatedUpdate update_;
  ImuGapUncertainty imu_gap_uncertainty_;
  StuckDetector stuck_;
  RunawayWatch runaway_;
  std::uint64_t recoveries_ = 0;
  WheelMonitor wheel_monitor_;
  StandstillNoise standstill_noise_;
  NoiseAdaptation adaptation_;
  bool use_wheel_;
  bool use_nonholonomic_;
  bool use_zupt_;
  bool use_zaru_;

  bool initialized_ = false;
  NavigationState state_;
  VehicleState vehicle_;
  ErrorCovariance P_ = ErrorCovariance::Identity();
  ErrorTransition transition_;
  std::optional<Vector3> last_rate_b_;  ///< mean of the last step, with its bias [rad/s]
  bool has_moved_ = false;              ///< a step was processed since the start
  bool has_rested_ = false;             ///< a standstill was accepted since the last motion
  std::uint32_t epoch_ = 0;

  RingQueue<InsStep> steps_;
  WheelQueue wheels_;
  RingQueue<AntennaFix> fixes_;  ///< not yet applied, by stamp
  SampleInterval fix_interval_;  ///< of the processed ones
  Nanoseconds fixes_complete_until_ = 0;
  Nanoseconds used_fix_ = 0;  ///< stamp of the newest one that passed the gate, 0: none
  SlippingSpeed slipping_speed_;
  double last_forward_mps_ = 0.0;    ///< predicted, mean over the previous wheel interval
  double way_since_wheels_m_ = 0.0;  ///< of the surface, in the last wheel interval
  double slow_envelope_ = 0.0;       ///< of the steady-state variance of slow slip
  double side_envelope_ = 0.0;
  LastingSlip lasting_slip_;
  UnexpectedSlip unexpected_slip_;  ///< since the last standstill
  std::uint64_t unexpected_slips_ = 0;
  bool slow_slip_lasts_ = false;    ///< it was unexpected, and still shows
  double slipping_way_m_ = 0.0;     ///< over which wheel speeds have contradicted
  double contradiction_mps_ = 0.0;  ///< innovation of the last wheel speed if it failed its gate, else 0
  double surface_speed_mps_ = 0.0;  ///< of the wheels, last sample
  MeanMotion average_;              ///< over the open wheel interval
  MeanMotion constraint_average_;   ///< over the wheel intervals since the last constraint
  Estimate estimate_;
  InnovationSink on_innovation_;
  std::shared_ptr<FilterHistory> history_;  ///< null unless the drive is to be smoothed
};

}  // namespace slipnav
