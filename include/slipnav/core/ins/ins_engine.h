#pragma once
/// Keeps the nominal state: checks and buffers IMU samples, mechanizes them one by one, and rewinds to the step
/// a correction belongs to. Every result depends only on the stamps and values of the samples.

#include <cstdint>
#include <optional>

#include "slipnav/core/base/ring_queue.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ins/strapdown.h"
#include "slipnav/core/sensors/imu_screen.h"

namespace slipnav {

/// A longer gap is not driving time: a clock has been set, or a computer was asleep. The
/// vehicle is assumed to have stood still for all of it, and its covariance grows as over this length [s].
inline constexpr double kLongestGap_s = 60.0;

/// One mechanized IMU interval.
struct InsStep {
  std::uint32_t epoch = 0;  ///< counts corrections; a step of an older epoch is void
  Nanoseconds start = 0;
  NavigationState state;                 ///< at the end of the interval
  Vector3 f_ib_b = Vector3::Zero();      ///< bias-corrected mean over the interval [m/s²]
  Vector3 omega_ib_b = Vector3::Zero();  ///< bias-corrected mean over the interval [rad/s]
  double gap_s = 0.0;                    ///< time without samples inside the interval
};

/// The state at the end of a step, which its stamp identifies, as the filter corrected it.
struct Correction {
  std::uint32_t epoch = 0;  ///< of all steps that follow from it
  NavigationState state;
};

/// The newest intervals, with the state at the end of each mechanized one.
class InsEngine {
 public:
  InsEngine(const Planet& planet, const ImuInputParams& params)
      : strapdown_(planet), screen_(params), params_(params) {}

  /// Starts mechanizing from `state`; samples up to its stamp are dropped, later buffered ones are used.
  void initialize(const NavigationState& state);
  bool isInitialized() const { return initialized_; }
  /// Stops mechanizing; samples are buffered for the next initial state.
  void release() { initialized_ = false; }

  /// Checks and buffers a sample. When the source has restarted everything before is dropped, the initial state too.
  ImuVerdict push(const ImuSample& sample);

  /// Mechanizes the next buffered interval; nothing if all are done or there is no initial state.
  std::optional<InsStep> step();

  /// Rewinds to the step the correction is for; step() then mechanizes the later ones again.
  /// @return false if that step is no longer, or not yet, buffered
  bool correct(const Correction& correction);

  /// Resumes from a correction without the steps before it, which another engine has made: the time between its state
  /// and the first sample is a gap.
  void adopt(const Correction& correction);

  /// Stamp of the newest accepted sample, 0 before the first.
  Nanoseconds newestStamp() const { return screen_.newestStamp(); }
  /// How often the source has restarted.
  std::uint32_t restarts() const { return screen_.restarts(); }
  /// All axes of the IMU repeat themselves.
  bool isImuFrozen() const { return screen_.isFrozen(); }
  const Planet& planet() const { return strapdown_.planet(); }

 private:
  struct Slot {
    Nanoseconds end;
    ImuInterval interval;
    double gap_s;
    NavigationState state;  ///< at the end, once mechanized
  };

  /// What an IMU measures if the vehicle keeps turning about the vertical as in `interval`, with all else constant.
  ImuInterval steadyTurn(const NavigationState& state, const ImuInterval& interval) const;
  void append(const Slot& slot);

  Strapdown strapdown_;
  ImuScreen screen_;
  ImuInputParams params_;
  RingQueue<Slot> slots_;
  std::size_t next_ = 0;  ///< of `slots_`, to be mechanized; the first one starts at `initial_`
  std::uint32_t epoch_ = 0;
  bool initialized_ = false;
  NavigationState initial_;
};

}  // namespace slipnav
