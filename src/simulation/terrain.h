#pragma once
/// Analytic ground: a sum of cosines over the tangent plane, firm and nearly level around the start.

#include <Eigen/Core>
#include <cstdint>

#include "simulation/random.h"
#include "slipnav/core/base/types.h"

namespace slipnav::sim {

/// Shape of the ground. Slopes are root mean squares along a straight track.
struct ReliefParams {
  double slope_deg = 0.0;  ///< of the long waves
  double slope_min_wavelength_m = 20.0;
  double slope_max_wavelength_m = 150.0;
  double roughness_deg = 0.0;  ///< of the short waves, before the vehicle's footprint smooths them
  double roughness_min_wavelength_m = 0.7;
  double roughness_max_wavelength_m = 10.0;
  double tilt_deg = 0.0;  ///< of the whole plane, the firm area included; uphill in the direction of the start
};

/// The surface that the center of the wheels follows, at one place.
struct SurfacePoint {
  double height_m = 0.0;                                    ///< above the start
  Vector2 gradient = Vector2::Zero();                       ///< d/d(east, north)
  Eigen::Matrix2d hessian_per_m = Eigen::Matrix2d::Zero();  ///< second derivatives
  double looseness = 0.0;  ///< 0 on the firm area around the start, 1 out in the terrain
};

/// Height as a function of position. Immutable.
class Terrain {
 public:
  /// @param start_heading_rad the firm area is centered on the straight that begins at the origin with this heading
  Terrain(const ReliefParams& relief, double start_heading_rad, double straight_m, std::uint64_t seed);

  /// Height and its derivatives; infinitely differentiable over the whole plane.
  SurfacePoint at(const Vector2& east_north_m) const;

 private:
  friend class TerrainFollower;

  static constexpr int kSlopeWaves = 12;
  static constexpr int kRoughnessWaves = 28;
  static constexpr int kWaves = kSlopeWaves + kRoughnessWaves;
  using PerWave = Eigen::Array<double, kWaves, 1>;

  /// Cosine and sine of each wave's phase at one place.
  struct Phases {
    PerWave cosine;
    PerWave sine;
  };
  /// A group of waves with logarithmically spaced lengths and equal slopes.
  struct Band {
    double slope_rad;
    double min_wavelength_m;
    double max_wavelength_m;
    int first;
    int count;
  };

  void setWaves(const Band& band, RandomStream& stream);
  Phases phasesAt(const Vector2& east_north_m) const;
  SurfacePoint openTerrain(const Phases& phases) const;
  SurfacePoint blended(const Vector2& east_north_m, const Phases& phases) const;

  PerWave wave_east_per_m_;  ///< wave vector [rad/m]
  PerWave wave_north_per_m_;
  PerWave phase_rad_;
  PerWave amplitude_m_;
  Vector2 firm_center_m_;
  double center_height_m_ = 0.0;  ///< of the open terrain, so that the blend starts from zero height
  double start_height_m_ = 0.0;
  Vector2 tilt_;  ///< gradient of the whole plane
};

/// The same surface for successive positions close to each other: sines come from those at a nearby anchor by
/// the addition theorem, which is several times faster and agrees to rounding.
class TerrainFollower {
 public:
  explicit TerrainFollower(const Terrain& terrain);

  SurfacePoint at(const Vector2& east_north_m);

 private:
  Terrain terrain_;
  double reach_m_;
  Vector2 anchor_m_ = Vector2::Zero();
  Terrain::Phases anchor_phases_;
};

}  // namespace slipnav::sim
