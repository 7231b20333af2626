#pragma once
/// Fast slip that does not pass: the ground has changed, or the rover is stuck.
///
/// The fast slip absorbs whatever part of a single wheel speed is beyond its gate. As a Gauss-Markov process of length
/// ℓ it has forgotten that after a few ℓ, and would then pull the velocity towards the wheels. If it is still far from
/// zero, and on the same side, it is persistent slip.

namespace slipnav {

/// Measures the distance over which the fast slip stays.
class LastingSlip {
 public:
  void reset() { *this = LastingSlip(); }

  /// @param slip estimate of the fast slip [-]; @param std assumed for the ground
  /// @param way_m of the wheels' surface since the last call; @param length_m ℓ
  /// @return whether the slip has lasted; true once, then not until it has lasted as long again
  bool add(double slip, double std, double way_m, double length_m);

 private:
  double way_m_ = 0.0;
  int side_ = 0;  ///< sign of the slip, 0 where it is small
};

}  // namespace slipnav
