#include "simulation/ground.h"

#include <array>
#include <stdexcept>

namespace slipnav::sim {
namespace {

GroundParams paved() {
  GroundParams g;
  g.relief.slope_deg = 0.6;
  g.relief.roughness_deg = 0.2;
  g.slip.mean = 0.005;
  g.slip.mean_spread = 0.3;
  g.slip.climb = 0.05;
  g.slip.fast = 0.006;
  g.slip.slow = 0.003;
  g.slip.wheel_scatter = 0.003;
  g.slip.side_slip_deg = 0.1;
  g.slip.side_slip_per_slope = 0.02;
  g.slip.sway_m = 0.0001;
  g.slip.heave_m = 0.0002;
  g.slip.turning_point_std_m = 0.005;
  g.slip.track_factor = 1.5;
  g.slip.track_factor_spread = 0.02;
  g.vibration_mps2 = 0.15;
  g.vibration_radps = 0.004;
  return g;
}

GroundParams unpaved() {
  GroundParams g;
  g.relief.slope_deg = 1.8;
  g.relief.roughness_deg = 1.0;
  g.slip.mean = 0.016;
  g.slip.mean_spread = 0.25;
  g.slip.climb = 0.1;
  g.slip.sinkage = 0.2;
  g.slip.fast = 0.025;
  g.slip.slow = 0.008;
  g.slip.wheel_scatter = 0.006;
  g.slip.impulses_per_m = 0.04;
  g.slip.impulse_min = 0.08;
  g.slip.impulse_max = 0.35;
  g.slip.side_slip_deg = 0.3;
  g.slip.side_slip_per_slope = 0.05;
  g.slip.sway_m = 0.0005;
  g.slip.heave_m = 0.0008;
  g.slip.turning_point_std_m = 0.01;
  g.slip.track_factor = 1.45;
  g.slip.track_factor_spread = 0.04;
  g.vibration_mps2 = 0.3;
  g.vibration_radps = 0.008;
  return g;
}

GroundParams gravel() {
  GroundParams g;
  g.relief.slope_deg = 2.5;
  g.relief.roughness_deg = 1.7;
  g.slip.mean = 0.045;
  g.slip.mean_spread = 0.2;
  g.slip.climb = 0.3;
  g.slip.sinkage = 0.6;
  g.slip.fast = 0.03;
  g.slip.slow = 0.01;
  g.slip.wheel_scatter = 0.012;
  g.slip.impulses_per_m = 0.05;
  g.slip.impulse_min = 0.1;
  g.slip.impulse_max = 0.45;
  g.slip.side_slip_deg = 0.5;
  g.slip.side_slip_per_slope = 0.08;
  g.slip.sway_m = 0.0008;
  g.slip.heave_m = 0.001;
  g.slip.turning_point_std_m = 0.02;
  g.slip.track_factor = 1.4;
  g.slip.track_factor_spread = 0.06;
  g.vibration_mps2 = 0.35;
  g.vibration_radps = 0.009;
  return g;
}

GroundParams rough() {
  GroundParams g;
  g.relief.slope_deg = 4.2;
  g.relief.roughness_deg = 2.3;
  g.slip.mean = 0.086;
  g.slip.mean_spread = 0.1;
  g.slip.climb = 0.6;
  g.slip.sinkage = 1.2;
  g.slip.fast = 0.055;
  g.slip.slow = 0.03;
  g.slip.wheel_scatter = 0.015;
  g.slip.impulses_per_m = 0.1;
  g.slip.impulse_min = 0.2;
  g.slip.impulse_max = 0.85;
  g.slip.side_slip_deg = 1.2;
  g.slip.side_slip_per_slope = 0.2;
  g.slip.sway_m = 0.0015;
  g.slip.heave_m = 0.002;
  g.slip.turning_point_std_m = 0.03;
  g.slip.track_factor = 1.35;
  g.slip.track_factor_spread = 0.08;
  g.vibration_mps2 = 0.4;
  g.vibration_radps = 0.01;
  return g;
}

GroundParams rocking() {
  GroundParams g;
  g.relief.slope_deg = 2.0;
  g.relief.roughness_deg = 6.0;
  g.relief.roughness_min_wavelength_m = 1.5;
  return g;
}

using Maker = GroundParams (*)();
/// In the order of kTerrainNames.
constexpr std::array<Maker, kTerrainNames.size()> kMakers = {paved, unpaved, gravel, rough, rocking};

}  // namespace

GroundParams groundByName(const std::string& name) {
  std::string known;
  std::size_t index = 0;
  for (const char* candidate : kTerrainNames) {
    if (name == candidate) {
      return kMakers[index]();
    }
    known += std::string(index == 0 ? "" : ", ") + candidate;
    ++index;
  }
  throw std::invalid_argument("terrain '" + name + "' is not known (" + known + ")");
}

GroundParams changed(GroundParams ground, const GroundChangeParams& change) {
  SlipParams& slip = ground.slip;
  slip.offset = change.slip_offset;
  slip.fast *= change.slip_variation;
  slip.slow *= change.slip_variation;
  slip.wheel_scatter *= change.slip_variation;
  slip.patch = change.patch_slip;
  slip.patch_length_m = change.patch_length_m;
  slip.patch_spacing_m = change.patch_spacing_m;
  if (change.track_factor > 0.0) {
    slip.track_factor = change.track_factor;
  }
  slip.turning_point_m = change.turning_point_m;
  if (change.turning_point_std_m > 0.0) {
    slip.turning_point_std_m = change.turning_point_std_m;
  }
  ground.relief.tilt_deg = change.tilt_deg;
  return ground;
}

}  // namespace slipnav::sim
