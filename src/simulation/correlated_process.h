#pragma once
/// A stationary random process over the distance traveled, with unit variance and exponential correlation.

#include <vector>

#include "simulation/random.h"

namespace slipnav::sim {

/// First-order Gauss-Markov values on a grid, joined by a uniform cubic B-spline: twice continuously differentiable.
/// The value depends on the travel only, not on when or how often it is queried.
class CorrelatedProcess {
 public:
  /// @param correlation_m distance over which the correlation falls to 1/e
  CorrelatedProcess(std::uint64_t seed, std::string_view purpose, double correlation_m);

  /// @param travel_m not negative
  double at(double travel_m);
  /// Derivative of at() with respect to the travel [1/m].
  double slopeAt(double travel_m);

 private:
  /// Grid cell of a travel, with its four control values drawn, and the place inside it in [0, 1).
  struct Cell {
    std::size_t first;
    double part;
  };
  Cell cellOf(double travel_m);

  RandomStream stream_;
  double spacing_m_;
  double persistence_;  ///< correlation of neighboring grid values
  double scale_;        ///< makes up for the variance that the spline smooths away
  std::vector<double> grid_;
};

}  // namespace slipnav::sim
