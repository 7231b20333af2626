#pragma once
/// The drive according to IMU and truth positions together, without wheels: a Kalman filter over the whole recording
/// and back again (Rauch, Tung and Striebel 1965; Groves 3.4.3).
///
/// Error states are the fifteen of navigation and the scale factor error of the gyro about body z, which is estimated
/// here. Measurements are truth positions, and zero velocity and zero rate while wheels and IMU agree on standstill.

#include <vector>

#include "calibration/calibration_drive.h"
#include "config/config.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

inline constexpr int kAidedYawScale = kNavStates;
inline constexpr int kAidedStates = kNavStates + 1;
using AidedVector = Eigen::Matrix<double, kAidedStates, 1>;
using AidedCovariance = Eigen::Matrix<double, kAidedStates, kAidedStates>;

/// What the smoother estimates: a navigation state, and the scale factor of the gyro about z.
struct AidedState {
  NavigationState nav;
  double yaw_scale = 0.0;  ///< of the gyro about body z: it reports (1 + yaw_scale) ω_z
};

/// IMU interval corrected for the scale factor error; biases are still included.
ImuInterval withoutYawScale(const ImuInterval& interval, double yaw_scale);

/// The state after a measurement, given all measurements before and after it.
struct SmoothedEpoch {
  AidedState state;
  AidedCovariance P = AidedCovariance::Zero();  ///< layout of ErrorIndex, then kAidedYawScale
  std::size_t next_interval = 0;                ///< the IMU interval that starts here
};

/// The states of a whole drive, at the stamps of its measurements, and how well truth agreed with them.
struct SmoothedDrive {
  std::vector<SmoothedEpoch> epochs;
  std::size_t fixes = 0;          ///< truth positions used
  std::size_t refused_fixes = 0;  ///< contradicted the IMU and all others
  double fix_nis = 0.0;           ///< mean normalized innovation squared of the used ones per degree of freedom
};

/// Runs a drive forwards and backwards. Immutable.
class AidedSmoother {
 public:
  AidedSmoother(const Planet& planet, const Config& config);

  /// @param start state at the start of the first interval: tilt and heading good to a few degrees
  /// @param variance_factor on the variances of the truth positions
  SmoothedDrive smooth(const CalibrationDrive& drive, const std::vector<TimedInterval>& intervals,
                       const AidedState& start, double variance_factor) const;

 private:
  struct ForwardEpoch;
  class ForwardPass;

  static void smoothBackwards(const Planet& planet, const std::vector<ForwardEpoch>& forward,
                              std::vector<SmoothedEpoch>& epochs);

  Planet planet_;
  Config config_;
};

}  // namespace slipnav
