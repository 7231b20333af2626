#include "calibration/aided_smoother.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/square.h"
#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/ekf/stationary_detector.h"

namespace slipnav {
namespace {

constexpr double kStartTiltStd_rad = 0.05;
constexpr double kStartHeadingStd_rad = 0.2;
constexpr double kStartSpeedStd_mps = 0.2;
constexpr double kStartPositionStd_m = 1.0;

AidedCovariance startCovariance(const ErrorDynamics& dynamics) {
  AidedVector variance = AidedVector::Zero();
  variance.head<kNavStates>() = dynamics.priorVariance().head<kNavStates>();
  variance.segment<2>(kAttitude).setConstant(square(kStartTiltStd_rad));
  variance(kAttitude + 2) = square(kStartHeadingStd_rad);
  variance.segment<3>(kVelocity).setConstant(square(kStartSpeedStd_mps));
  variance.segment<3>(kPosition).setConstant(square(kStartPositionStd_m));
  variance(kAidedYawScale) = dynamics.priorVariance()(kYawScale);
  return variance.asDiagonal();
}

AidedCovariance transitionMatrix(const ErrorTransition& transition) {
  AidedCovariance phi = AidedCovariance::Identity();
  phi.topLeftCorner<9, kNavStates>() = transition.nav;
  phi.block<3, 1>(kAttitude, kAidedYawScale) = transition.attitude_from_yaw_scale;
  phi.block<3, 1>(kVelocity, kAidedYawScale) = transition.velocity_from_yaw_scale;
  return phi;
}

void subtractError(const Planet& planet, const AidedVector& error, AidedState& state) {
  ErrorVector nav = ErrorVector::Zero();
  nav.head<kNavStates>() = error.head<kNavStates>();
  slipnav::subtractError(planet, nav, state.nav);
  state.yaw_scale -= error(kAidedYawScale);
}

AidedVector errorBetween(const Planet& planet, const AidedState& estimate, const AidedState& truth) {
  AidedVector error;
  error.head<kNavStates>() = slipnav::errorBetween(planet, estimate.nav, truth.nav).head<kNavStates>();
  error(kAidedYawScale) = estimate.yaw_scale - truth.yaw_scale;
  return error;
}

}  // namespace

ImuInterval withoutYawScale(const ImuInterval& interval, double yaw_scale) {
  ImuInterval result = interval;
  result.omega_ib_b.z() *= 1.0 - yaw_scale;
  return result;
}

/// What the backward pass needs of one epoch.
struct AidedSmoother::ForwardEpoch {
  AidedState predicted;
  AidedCovariance P_predicted;
  AidedCovariance transition;  ///< from the state after the last epoch to the predicted one
  AidedState updated;
  AidedCovariance P_updated;
  std::size_t next_interval;
};

class AidedSmoother::ForwardPass {
 public:
  ForwardPass(const Planet& planet, const Config& config, const AidedState& start, double variance_factor)
      : planet_(planet),
        config_(config),
        strapdown_(planet),
        dynamics_(planet, config.imu.noise, config.vehicle),
        detector_(config.stationary, imuFloor(config.imu.noise)),
        lever_to_truth_b_(config.truth_mount.position_b() - config.imu.mount.position_b()),
        variance_factor_(variance_factor),
        gate_(chiSquareQuantile(3, config.filter.gate_alpha)),
        state_(start),
        P_(startCovariance(dynamics_)) {}

  void run(const CalibrationDrive& drive, const std::vector<TimedInterval>& intervals) {
    auto fix = drive.truth.begin();
    auto wheels = drive.wheels.begin();
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      propagate(intervals[i], i == 0 ? ImuInterval{} : intervals[i - 1].mean);
      const AidedState predicted = state_;
      const AidedCovariance P_predicted = P_;
      bool measured = false;
      for (; wheels != drive.wheels.end() && wheels->stamp <= intervals[i].end; ++wheels) {
        measured = useStandstill(*wheels) || measured;
      }
      for (; fix != drive.truth.end() && fix->stamp <= intervals[i].end; ++fix) {
        measured = (fix->stamp > intervals[i].start && useFix(*fix)) || measured;
      }
      if (measured) {
        epochs_.push_back({predicted, P_predicted, transition_, state_, P_, i + 1});
        transition_.setIdentity();
      }
    }
  }

  const std::vector<ForwardEpoch>& epochs() const { return epochs_; }
  std::size_t fixes() const { return fixes_; }
  std::size_t refusedFixes() const { return refused_fixes_; }
  double fixNis() const { return fixes_ > 0 ? nis_sum_ / static_cast<double>(3 * fixes_) : 0.0; }

 private:
  void propagate(const TimedInterval& interval, const ImuInterval& previous) {
    const NavigationState before = state_.nav;
    const ImuInterval mean = withoutYawScale(interval.mean, state_.yaw_scale);
    state_.nav = strapdown_.propagate(before, withoutYawScale(previous, state_.yaw_scale), mean, interval.end);
    const Vector3 force = mean.f_ib_b - before.accel_bias_b;
    const Vector3 rate = mean.omega_ib_b - before.gyro_bias_b;
    const ErrorTransition step =
        dynamics_.transition(before, state_.nav, force, rate, Vector3::Zero(), mean.duration_s);
    const AidedCovariance phi = transitionMatrix(step);
    P_.diagonal().head<kNavStates>() += 0.5 * step.noise.head<kNavStates>();
    P_ = phi * P_ * phi.transpose();
    P_.diagonal().head<kNavStates>() += 0.5 * step.noise.head<kNavStates>();
    transition_ = phi * transition_;
    detector_.addImu(interval.end, force, rate);
    turned_rad_ += mean.omega_ib_b * mean.duration_s;
    turned_s_ += mean.duration_s;
  }

  bool useStandstill(const WheelMotion& wheels) {
    detector_.addWheels(wheels.stamp, wheels.largest_speed_mps);
    const double duration_s = std::exchange(turned_s_, 0.0);
    const Vector3 turned_rad = std::exchange(turned_rad_, Vector3::Zero());
    if (duration_s <= 0.0 || !detector_.judge(planet_.gravity_n(state_.nav.position).norm())) {
      return false;
    }
    BodyMotion motion;
    motion.duration_s = duration_s;
    motion.omega_ib_b = turned_rad / duration_s - state_.nav.gyro_bias_b;
    const Vector3 omega_ie_n = planet_.omega_ie_n(state_.nav.position.latitude_rad);
    update(
        zeroAngularRateMeasurement(config_.zero_motion, dynamics_.gyroNoiseDensity(), motion, state_.nav, omega_ie_n));
    update(zeroVelocityMeasurement(square(config_.zero_motion.velocity_std_mps), state_.nav));
    return true;
  }

  bool useFix(const PositionFix& fix) {
    PositionFix weighted = fix;
    weighted.variance_ned_m2 = variance_factor_ * fix.variance_ned_m2.cwiseMax(square(config_.calibration.truth_std_m));
    const Measurement measurement = positionMeasurement(planet_, weighted, state_.nav, lever_to_truth_b_);
    const std::optional<double> nis = normalizedInnovation(measurement);
    if (!nis || *nis > gate_) {
      ++refused_fixes_;
      return false;
    }
    nis_sum_ += *nis;
    ++fixes_;
    update(measurement);
    return true;
  }

  struct Innovation {
    Eigen::Matrix<double, kAidedStates, 3> PHt;
    Eigen::LLT<Matrix3> cholesky;
  };

  /// Of a three-row measurement.
  Innovation innovationOf(const Measurement& measurement) const {
    Innovation innovation;
    const Eigen::Matrix<double, 3, kNavStates> H = measurement.H.leftCols<kNavStates>();
    innovation.PHt = P_.leftCols<kNavStates>() * H.transpose();
    Matrix3 S = H * innovation.PHt.topRows<kNavStates>();
    S.diagonal() += measurement.variance;
    innovation.cholesky.compute(S);
    return innovation;
  }

  std::optional<double> normalizedInnovation(const Measurement& measurement) const {
    const Innovation innovation = innovationOf(measurement);
    if (innovation.cholesky.info() != Eigen::Success || !measurement.residual.allFinite()) {
      return std::nullopt;
    }
    return measurement.residual.dot(innovation.cholesky.solve(measurement.residual));
  }

  void update(const Measurement& measurement) {
    const Innovation innovation = innovationOf(measurement);
    const Eigen::Matrix<double, kAidedStates, 3> K = innovation.cholesky.solve(innovation.PHt.transpose()).transpose();
    Eigen::Matrix<double, 3, kAidedStates> H = Eigen::Matrix<double, 3, kAidedStates>::Zero();
    H.leftCols<kNavStates>() = measurement.H.leftCols<kNavStates>();
    const AidedCovariance kept = AidedCovariance::Identity() - K * H;
    const Vector3 variance = measurement.variance;
    P_ = kept * P_ * kept.transpose() + K * variance.asDiagonal() * K.transpose();
    P_ = 0.5 * (P_ + P_.transpose()).eval();
    subtractError(planet_, -K * measurement.residual, state_);
  }

  Planet planet_;
  const Config& config_;
  Strapdown strapdown_;
  ErrorDynamics dynamics_;
  StationaryDetector detector_;
  Vector3 lever_to_truth_b_;
  double variance_factor_;
  double gate_;
  AidedState state_;
  AidedCovariance P_;
  AidedCovariance transition_ = AidedCovariance::Identity();
  Vector3 turned_rad_ = Vector3::Zero();  ///< by the gyros since the last wheel sample, bias included
  double turned_s_ = 0.0;
  std::vector<ForwardEpoch> epochs_;
  std::size_t fixes_ = 0;
  std::size_t refused_fixes_ = 0;
  double nis_sum_ = 0.0;
};

AidedSmoother::AidedSmoother(const Planet& planet, const Config& config) : planet_(planet), config_(config) {}

SmoothedDrive AidedSmoother::smooth(const CalibrationDrive& drive, const std::vector<TimedInterval>& intervals,
                                    const AidedState& start, double variance_factor) const {
  ForwardPass pass(planet_, config_, start, variance_factor);
  pass.run(drive, intervals);
  SmoothedDrive smoothed;
  smoothed.fixes = pass.fixes();
  smoothed.refused_fixes = pass.refusedFixes();
  smoothed.fix_nis = pass.fixNis();
  smoothBackwards(planet_, pass.epochs(), smoothed.epochs);
  return smoothed;
}

void AidedSmoother::smoothBackwards(const Planet& planet, const std::vector<ForwardEpoch>& forward,
                                    std::vector<SmoothedEpoch>& epochs) {
  epochs.resize(forward.size());
  for (std::size_t i = forward.size(); i-- > 0;) {
    const ForwardEpoch& now = forward[i];
    epochs[i] = {now.updated, now.P_updated, now.next_interval};
    if (i + 1 == forward.size()) {
      continue;
    }
    const ForwardEpoch& next = forward[i + 1];
    const AidedCovariance cross = next.transition * now.P_updated;
    const AidedCovariance gain = next.P_predicted.llt().solve(cross).transpose();
    subtractError(planet, gain * errorBetween(planet, next.predicted, epochs[i + 1].state), epochs[i].state);
    epochs[i].P += gain * (epochs[i + 1].P - next.P_predicted) * gain.transpose();
  }
}

}  // namespace slipnav
