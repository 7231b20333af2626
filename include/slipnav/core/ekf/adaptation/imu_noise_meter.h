#pragma once
/// Noise of an IMU from its own samples, while driving and at rest, before any filter.
///
/// Third differences of block means are blind to motion that is smooth over four blocks; for white noise of density N²
/// (PSD) they have the variance 20 N²/(m Δt) for blocks of m samples of Δt, the Hadamard variance (third-order Allan
/// variance: IEEE Std 1139). Vibration about a fixed position, or rover motion, gives more at some m; white noise gives
/// the same N² at all. The smallest over m = 1, 2, 4, 8 is an upper bound on what integrates like white noise.

#include <array>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Densities of the three accelerometers and gyros.
struct ImuNoiseDensity {
  Vector3 accel = Vector3::Zero();  ///< [m²/s³], body axes
  Vector3 gyro = Vector3::Zero();   ///< [rad²/s]
};

/// Keeps running means over a few seconds.
class ImuNoiseMeter {
 public:
  /// Samples are missing, or the rover's estimate starts: blocks restart, what was learned stays.
  void interrupt();
  void reset() { *this = ImuNoiseMeter(); }

  void add(const Vector3& f_ib_b, const Vector3& omega_ib_b, double duration_s);

  /// Zero until there are enough samples.
  ImuNoiseDensity density() const;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// Blocks of one length.
  struct Scale {
    Vector6 sum = Vector6::Zero();
    double duration_s = 0.0;
    double block_s = 0.0;  ///< length of the newest whole block
    int samples = 0;
    std::array<Vector6, 3> before;  ///< means of the last blocks, newest first
    int blocks = 0;                 ///< number of valid ones
    Vector6 density = Vector6::Zero();
    Vector6 recent = Vector6::Zero();  ///< the same over the last moment: vibration starts abruptly
    double weight_s = 0.0;             ///< averaging time of `density`
  };
  static constexpr int kScales = 4;

  static void closeBlock(Scale& scale);

  std::array<Scale, kScales> scales_;
};

}  // namespace slipnav
