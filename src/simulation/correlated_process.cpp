#include "simulation/correlated_process.h"

#include <cmath>

namespace slipnav::sim {
namespace {

constexpr double kGridPointsPerCorrelation = 6.0;

/// Standard deviation of a uniform cubic B-spline, averaged over the cell, of a unit Gauss-Markov sequence.
/// The weights are the spline's autocorrelation: cardinal B-spline of degree 7 at the integers.
double splineSigma(double persistence) {
  const double rho2 = persistence * persistence;
  return std::sqrt((2416.0 + 2.0 * (1191.0 * persistence + 120.0 * rho2 + rho2 * persistence)) / 5040.0);
}

}  // namespace

CorrelatedProcess::CorrelatedProcess(std::uint64_t seed, std::string_view purpose, double correlation_m)
    : stream_(seed, purpose),
      spacing_m_(correlation_m / kGridPointsPerCorrelation),
      persistence_(std::exp(-1.0 / kGridPointsPerCorrelation)),
      scale_(1.0 / splineSigma(persistence_)),
      grid_{stream_.normal()} {}

CorrelatedProcess::Cell CorrelatedProcess::cellOf(double travel_m) {
  const double cell = std::floor(travel_m / spacing_m_);
  const auto first = static_cast<std::size_t>(cell);
  while (grid_.size() < first + 4) {
    grid_.push_back(persistence_ * grid_.back() + std::sqrt(1.0 - persistence_ * persistence_) * stream_.normal());
  }
  return {first, travel_m / spacing_m_ - cell};
}

double CorrelatedProcess::at(double travel_m) {
  const auto [first, t] = cellOf(travel_m);
  const double r = 1.0 - t;
  const double sum = r * r * r * grid_[first] + (3.0 * t * t * t - 6.0 * t * t + 4.0) * grid_[first + 1] +
                     (3.0 * r * r * r - 6.0 * r * r + 4.0) * grid_[first + 2] + t * t * t * grid_[first + 3];
  return scale_ * sum / 6.0;
}

double CorrelatedProcess::slopeAt(double travel_m) {
  const auto [first, t] = cellOf(travel_m);
  const double r = 1.0 - t;
  const double sum = -r * r * grid_[first] + (3.0 * t * t - 4.0 * t) * grid_[first + 1] -
                     (3.0 * r * r - 4.0 * r) * grid_[first + 2] + t * t * grid_[first + 3];
  return scale_ * sum / (2.0 * spacing_m_);
}

}  // namespace slipnav::sim
