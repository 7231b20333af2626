#pragma once
/// Fast slip that does not pass: the ground has changed, or the rover is stuck.
///
/// The fast slip takes what a single wheel speed has beyond its gate. As a Gauss-Markov process of length ℓ it has
/// forgotten that after a few ℓ, and would then draw the velocity to the wheels. Where it is still far from zero, and
/// on the same side, it is slip that persists.

namespace slipnav {

/// Measures the way over which the fast slip stays.
class LastingSlip {
 public:
  void reset() { *this = LastingSlip(); }

  /// @param slip estimate of the fast slip [-]; @param std what the ground is believed to have
  /// @param way_m of the wheels' surface since the last call; @param length_m ℓ
  /// @return whether the slip has lasted; once, until it has lasted as long again
  bool add(double slip, double std, double way_m, double length_m);

 private:
  double way_m_ = 0.0;
  int side_ = 0;  ///< sign of the slip, 0 where it is small
};

}  // namespace slipnav
