#include "simulation/terrain.h"

#include <cmath>

namespace slipnav::sim {
namespace {

/// Where the firm area around the start has given way to 63 % of the terrain.
constexpr double kFirmRadius_m = 20.0;
/// Standard deviation of the Gaussian footprint: four contacts at half the wheelbase and half the track.
constexpr double kFootprint_m = 0.3;

/// Largest change of a wave's phase that the follower computes by its power series.
constexpr double kMaxPhaseStep_rad = 0.25;

/// Transition from the firm area (0) to the open terrain (1): 1 − exp(−(ρ/R)⁴), with its derivatives.
struct Transition {
  double value;
  Vector2 gradient;
  Eigen::Matrix2d hessian;
};

Transition transitionAt(const Vector2& from_center_m) {
  const double q = from_center_m.squaredNorm() / (kFirmRadius_m * kFirmRadius_m);
  const double rest = std::exp(-q * q);
  const Vector2 q_gradient = 2.0 / (kFirmRadius_m * kFirmRadius_m) * from_center_m;
  const double first = 2.0 * q * rest;
  const double second = (2.0 - 4.0 * q * q) * rest;
  return {1.0 - rest, first * q_gradient,
          second * q_gradient * q_gradient.transpose() +
              first * 2.0 / (kFirmRadius_m * kFirmRadius_m) * Eigen::Matrix2d::Identity()};
}

}  // namespace

Terrain::Terrain(const ReliefParams& relief, double start_heading_rad, double straight_m, std::uint64_t seed)
    : firm_center_m_(0.5 * straight_m * Vector2(std::sin(start_heading_rad), std::cos(start_heading_rad))),
      tilt_(std::tan(degToRad(relief.tilt_deg)) * Vector2(std::sin(start_heading_rad), std::cos(start_heading_rad))) {
  RandomStream stream(seed, "terrain");
  setWaves({degToRad(relief.slope_deg), relief.slope_min_wavelength_m, relief.slope_max_wavelength_m, 0, kSlopeWaves},
           stream);
  setWaves({degToRad(relief.roughness_deg), relief.roughness_min_wavelength_m, relief.roughness_max_wavelength_m,
            kSlopeWaves, kRoughnessWaves},
           stream);
  center_height_m_ = openTerrain(phasesAt(firm_center_m_)).height_m;
  start_height_m_ = at(Vector2::Zero()).height_m;
}

void Terrain::setWaves(const Band& band, RandomStream& stream) {
  // a cosine of slope s in a random direction has mean square slope s²/4 along a track
  const double wave_slope = 2.0 * band.slope_rad / std::sqrt(static_cast<double>(band.count));
  for (int i = 0; i < band.count; ++i) {
    const double place = (static_cast<double>(i) + stream.uniform()) / static_cast<double>(band.count);
    const double wavelength_m = band.min_wavelength_m * std::pow(band.max_wavelength_m / band.min_wavelength_m, place);
    const double wave_number = 2.0 * kPi / wavelength_m;
    const double direction = stream.uniform(0.0, 2.0 * kPi);
    const double smoothing = std::exp(-0.5 * std::pow(wave_number * kFootprint_m, 2));
    const int k = band.first + i;
    wave_east_per_m_[k] = wave_number * std::sin(direction);
    wave_north_per_m_[k] = wave_number * std::cos(direction);
    phase_rad_[k] = stream.uniform(0.0, 2.0 * kPi);
    amplitude_m_[k] = smoothing * wave_slope / wave_number;
  }
}

Terrain::Phases Terrain::phasesAt(const Vector2& east_north_m) const {
  const PerWave phase = wave_east_per_m_ * east_north_m.x() + wave_north_per_m_ * east_north_m.y() + phase_rad_;
  return {phase.cos(), phase.sin()};
}

SurfacePoint Terrain::openTerrain(const Phases& phases) const {
  const PerWave height = amplitude_m_ * phases.cosine;
  const PerWave slope = -amplitude_m_ * phases.sine;
  SurfacePoint point;
  point.looseness = 1.0;
  point.height_m = height.sum();
  point.gradient << (slope * wave_east_per_m_).sum(), (slope * wave_north_per_m_).sum();
  const double east_north = -(height * wave_east_per_m_ * wave_north_per_m_).sum();
  point.hessian_per_m << -(height * wave_east_per_m_.square()).sum(), east_north, east_north,
      -(height * wave_north_per_m_.square()).sum();
  return point;
}

SurfacePoint Terrain::blended(const Vector2& east_north_m, const Phases& phases) const {
  SurfacePoint open = openTerrain(phases);
  open.height_m -= center_height_m_;
  const Transition blend = transitionAt(east_north_m - firm_center_m_);
  SurfacePoint point;
  point.looseness = blend.value;
  point.height_m = blend.value * open.height_m - start_height_m_ + tilt_.dot(east_north_m);
  point.gradient = blend.value * open.gradient + open.height_m * blend.gradient + tilt_;
  const Eigen::Matrix2d mixed = blend.gradient * open.gradient.transpose();
  point.hessian_per_m = blend.value * open.hessian_per_m + mixed + mixed.transpose() + open.height_m * blend.hessian;
  return point;
}

SurfacePoint Terrain::at(const Vector2& east_north_m) const { return blended(east_north_m, phasesAt(east_north_m)); }

TerrainFollower::TerrainFollower(const Terrain& terrain)
    : terrain_(terrain), anchor_phases_(terrain_.phasesAt(anchor_m_)) {
  const double shortest_wave =
      std::sqrt((terrain_.wave_east_per_m_.square() + terrain_.wave_north_per_m_.square()).maxCoeff());
  reach_m_ = kMaxPhaseStep_rad / shortest_wave;
}

SurfacePoint TerrainFollower::at(const Vector2& east_north_m) {
  if ((east_north_m - anchor_m_).squaredNorm() > reach_m_ * reach_m_) {
    anchor_m_ = east_north_m;
    anchor_phases_ = terrain_.phasesAt(anchor_m_);
  }
  const Vector2 step_m = east_north_m - anchor_m_;
  const Terrain::PerWave x = terrain_.wave_east_per_m_ * step_m.x() + terrain_.wave_north_per_m_ * step_m.y();
  const Terrain::PerWave x2 = x.square();
  // power series to x⁹ and x¹⁰: within the reach the rest is below rounding
  const Terrain::PerWave sine =
      x * (1.0 + x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362880.0)))));
  const Terrain::PerWave cosine =
      1.0 + x2 * (-0.5 + x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0 + x2 * (-1.0 / 3628800.0)))));
  return terrain_.blended(east_north_m, {anchor_phases_.cosine * cosine - anchor_phases_.sine * sine,
                                         anchor_phases_.sine * cosine + anchor_phases_.cosine * sine});
}

}  // namespace slipnav::sim
