#include "simulation/soft_patches.h"

#include <algorithm>

namespace slipnav::sim {
namespace {

/// The wheels of one rover do not enter a patch at the same time.
constexpr double kEdge_m = 0.3;

double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

SoftPatches::SoftPatches(double length_m, double spacing_m, std::uint64_t seed)
    : length_m_(length_m), spacing_m_(spacing_m), stream_(seed, "soft patches") {
  begin_m_ = drawLength(spacing_m_);
  end_m_ = begin_m_ + drawLength(length_m_);
}

double SoftPatches::at(double travel_m) {
  while (travel_m > end_m_ + kEdge_m) {
    begin_m_ = end_m_ + kEdge_m + drawLength(spacing_m_);
    end_m_ = begin_m_ + drawLength(length_m_);
  }
  return smoothStep((travel_m - begin_m_) / kEdge_m) * smoothStep((end_m_ + kEdge_m - travel_m) / kEdge_m);
}

}  // namespace slipnav::sim
