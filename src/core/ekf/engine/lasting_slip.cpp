#include "slipnav/core/ekf/engine/lasting_slip.h"

#include <utility>

namespace slipnav {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kLengths = 4.0;  // exp(-4): 2 % of a fast slip is left

}  // namespace

bool LastingSlip::add(double slip, double std, double way_m, double length_m) {
  const int side = slip > kSigmas * std ? 1 : slip < -kSigmas * std ? -1 : 0;
  way_m_ = side != 0 && side == side_ ? way_m_ + way_m : 0.0;
  side_ = side;
  if (way_m_ <= kLengths * length_m) {
    return false;
  }
  way_m_ = 0.0;
  return true;
}

}  // namespace slipnav
