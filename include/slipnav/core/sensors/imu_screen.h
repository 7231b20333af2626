#pragma once
/// Tells usable IMU samples from unusable ones, and makes intervals of the usable ones. The same samples in the same
/// order give the same verdicts, so that all listeners of one IMU agree on what has happened.

#include <array>
#include <cstdint>
#include <string>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ordering/usual_interval.h"
#include "slipnav/core/parameters/parameter_visitor.h"
#include "slipnav/core/sensors/imu_interval.h"

namespace slipnav {

/// Block `imu.input`.
struct ImuInputParams {
  std::string sampling = "mean";
  double max_specific_force_mps2 = 200.0;
  double max_rate_deg_per_s = 2000.0;
  double gap_factor = 1.6;
  double max_bridged_gap_s = 1.2;
  int stuck_samples = 20;
  void visit(ParameterVisitor& v);
};

/// What happens to a sample.
enum class ImuVerdict {
  kAccepted,
  kAfterGap,      ///< accepted; samples are missing before it
  kTimeWentBack,  ///< accepted: older by a second or more; the source has restarted, and nothing before it counts
  kNotFinite,     ///< rejected: NaN or infinite
  kOutOfRange,    ///< rejected: at or beyond the limit of the sensor's range
  kStuck,         ///< rejected: one axis has not changed for long while others of its kind do
  kNotNewer,      ///< rejected: repeated stamp, or older than the newest by less than a second
};

constexpr bool isAccepted(ImuVerdict verdict) { return verdict <= ImuVerdict::kTimeWentBack; }

/// The verdict in words, "" for a sample that continues from its predecessors.
const char* complaintOf(ImuVerdict verdict);

/// Judges each sample by its predecessors.
class ImuScreen {
 public:
  /// Verdict on a sample, and the interval that it ends.
  struct Result {
    ImuVerdict verdict = ImuVerdict::kAccepted;
    ImuInterval interval = {};  ///< since the previous accepted sample; none for the first
    double gap_s = 0.0;         ///< time without samples in it
  };

  explicit ImuScreen(const ImuInputParams& params)
      : params_(params), instantaneous_(params.sampling == "instantaneous") {}

  /// Discards all samples, as after a restart.
  void reset();

  Result check(const ImuSample& sample);

  /// Stamp of the newest accepted sample, 0 before the first.
  Nanoseconds newestStamp() const { return newest_.stamp; }
  /// How often the source has restarted.
  std::uint32_t restarts() const { return restarts_; }
  /// Whether all axes have repeated exactly the same values `stuck_samples` times: a sensor or driver that hangs. The
  /// samples are accepted nevertheless, since a sensor with coarse resolution repeats itself at rest.
  bool isFrozen() const;

 private:
  /// How often in a row each axis of one triad has had exactly the same value.
  struct Repeats {
    Vector3 value = Vector3::Zero();
    std::array<int, 3> count = {};
    void add(const Vector3& next);
    /// Whether an axis has repeated itself `limit` times, and another one has not.
    bool isStuck(int limit) const;
    bool areFrozen(int limit) const;
  };

  bool isInRange(const ImuSample& sample) const;

  ImuInputParams params_;
  bool instantaneous_;
  std::uint32_t restarts_ = 0;
  Repeats force_;
  Repeats rate_;
  ImuSample newest_;  ///< accepted; stamp 0 before the first
  UsualInterval usual_;
};

}  // namespace slipnav
