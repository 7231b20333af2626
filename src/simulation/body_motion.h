#pragma once
/// Motion of the body against the path: the response of rocker and suspension to stones under the wheels.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/correlated_process.h"
#include "simulation/params.h"

namespace slipnav::sim {

/// Height [m], offset to the right [m], pitch and roll [rad] of the body against the path.
enum BodyAxis { kHeave, kSway, kPitch, kRoll, kBodyAxes };
using BodyVector = Eigen::Matrix<double, kBodyAxes, 1>;

/// Excitation by the stones, as a function of the distance, and the response of a suspension.
class BodyMotion {
 public:
  BodyMotion(const BodyParams& params, std::uint64_t seed);

  bool rocks() const { return rocks_; }
  /// With springs the position of the body must be integrated; without, it is that of the stones.
  bool isSprung() const { return spring_radps_ > 0.0; }

  /// Where the stones put the body.
  BodyVector stones(double travel_m);
  /// Its derivative with respect to the travel.
  BodyVector stoneSlopes(double travel_m);

  /// Acceleration of a sprung body.
  /// @param offset of the stones over the body
  /// @param offset_rate its derivative by time
  BodyVector acceleration(const BodyVector& offset, const BodyVector& offset_rate) const;
  /// Whether joint friction holds a sprung body that moves this little.
  bool holds(const BodyVector& offset, const BodyVector& rate) const;

 private:
  BodyVector sigma_;
  bool rocks_;
  double spring_radps_;
  double damping_ratio_;
  std::vector<CorrelatedProcess> stones_;
};

}  // namespace slipnav::sim
