#include "slipnav/sim/terrain.h"

#include <cmath>

namespace slipnav::sim {
namespace {

constexpr int kSlopeWaves = 12;
constexpr int kRoughnessWaves = 28;
/// Where the firm area around the start has given way to 63 % of the terrain.
constexpr double kFirmRadius_m = 20.0;
/// Standard deviation of the Gaussian footprint: four contacts at half the wheelbase and half the track.
constexpr double kFootprint_m = 0.3;

/// Transition from the firm area (0) to the open terrain (1): 1 − exp(−(ρ/R)⁴), with its derivatives.
struct Transition {
  double value;
  Vector2 gradient;
  Eigen::Matrix2d hessian;
};

Transition transitionAt(const Vector2& from_centre_m) {
  const double q = from_centre_m.squaredNorm() / (kFirmRadius_m * kFirmRadius_m);
  const double rest = std::exp(-q * q);
  const Vector2 q_gradient = 2.0 / (kFirmRadius_m * kFirmRadius_m) * from_centre_m;
  const double first = 2.0 * q * rest;
  const double second = (2.0 - 4.0 * q * q) * rest;
  return {1.0 - rest, first * q_gradient,
          second * q_gradient * q_gradient.transpose() +
              first * 2.0 / (kFirmRadius_m * kFirmRadius_m) * Eigen::Matrix2d::Identity()};
}

}  // namespace

Terrain::Terrain(const ReliefParams& relief, double start_heading_rad, double straight_m, std::uint64_t seed)
    : firm_centre_m_(0.5 * straight_m * Vector2(std::sin(start_heading_rad), std::cos(start_heading_rad))) {
  RandomStream stream(seed, "terrain");
  addWaves({degToRad(relief.slope_deg), relief.slope_min_wavelength_m, relief.slope_max_wavelength_m, kSlopeWaves},
           stream);
  addWaves({degToRad(relief.roughness_deg), relief.roughness_min_wavelength_m, relief.roughness_max_wavelength_m,
            kRoughnessWaves},
           stream);
  centre_height_m_ = openTerrainAt(firm_centre_m_).height_m;
  start_height_m_ = blendedAt(Vector2::Zero()).height_m;
}

void Terrain::addWaves(const Band& band, RandomStream& stream) {
  const Eigen::Index old_count = phase_rad_.size();
  for (Eigen::ArrayXd* field : {&wave_east_per_m_, &wave_north_per_m_, &phase_rad_, &amplitude_m_}) {
    field->conservativeResize(old_count + band.count);
  }
  // a cosine of slope s in a random direction has mean square slope s²/4 along a track
  const double wave_slope = 2.0 * band.slope_rad / std::sqrt(static_cast<double>(band.count));
  for (int i = 0; i < band.count; ++i) {
    const double place = (static_cast<double>(i) + stream.uniform()) / static_cast<double>(band.count);
    const double wavelength_m = band.min_wavelength_m * std::pow(band.max_wavelength_m / band.min_wavelength_m, place);
    const double wave_number = 2.0 * kPi / wavelength_m;
    const double direction = stream.uniform(0.0, 2.0 * kPi);
    const double smoothing = std::exp(-0.5 * std::pow(wave_number * kFootprint_m, 2));
    const Eigen::Index k = old_count + i;
    wave_east_per_m_[k] = wave_number * std::sin(direction);
    wave_north_per_m_[k] = wave_number * std::cos(direction);
    phase_rad_[k] = stream.uniform(0.0, 2.0 * kPi);
    amplitude_m_[k] = smoothing * wave_slope / wave_number;
  }
}

SurfacePoint Terrain::openTerrainAt(const Vector2& east_north_m) const {
  SurfacePoint point;
  point.looseness = 1.0;
  double& east_east = point.hessian_per_m(0, 0);
  double& east_north = point.hessian_per_m(0, 1);
  double& north_north = point.hessian_per_m(1, 1);
  for (Eigen::Index i = 0; i < phase_rad_.size(); ++i) {
    const double ke = wave_east_per_m_[i];
    const double kn = wave_north_per_m_[i];
    const double angle = ke * east_north_m.x() + kn * east_north_m.y() + phase_rad_[i];
    const double height = amplitude_m_[i] * std::cos(angle);
    const double slope = -amplitude_m_[i] * std::sin(angle);
    point.height_m += height;
    point.gradient += slope * Vector2(ke, kn);
    east_east -= height * ke * ke;
    east_north -= height * ke * kn;
    north_north -= height * kn * kn;
  }
  point.hessian_per_m(1, 0) = east_north;
  return point;
}

SurfacePoint Terrain::blendedAt(const Vector2& east_north_m) const {
  SurfacePoint open = openTerrainAt(east_north_m);
  open.height_m -= centre_height_m_;
  const Transition blend = transitionAt(east_north_m - firm_centre_m_);
  SurfacePoint point;
  point.looseness = blend.value;
  point.height_m = blend.value * open.height_m;
  point.gradient = blend.value * open.gradient + open.height_m * blend.gradient;
  const Eigen::Matrix2d mixed = blend.gradient * open.gradient.transpose();
  point.hessian_per_m =
      blend.value * open.hessian_per_m + mixed + mixed.transpose() + open.height_m * blend.hessian;
  return point;
}

SurfacePoint Terrain::at(const Vector2& east_north_m) const {
  SurfacePoint point = blendedAt(east_north_m);
  point.height_m -= start_height_m_;
  return point;
}

}  // namespace slipnav::sim
