#pragma once
/// Random numbers that are the same with every standard library.

#include <cstdint>
#include <random>
#include <string_view>

#include "slipnav/core/base/types.h"

namespace slipnav::sim {

/// An independent stream for each purpose, so that drawing more from one leaves the others unchanged.
class RandomStream {
 public:
  /// @param seed of the run
  /// @param purpose name of the stream, e.g. "terrain"
  RandomStream(std::uint64_t seed, std::string_view purpose);

  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal, by Box and Muller.
  double normal();
  /// Three independent standard normals.
  Vector3 normal3();

 private:
  std::mt19937_64 engine_;  // its output sequence is fixed by the C++ standard; std::normal_distribution's is not
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace slipnav::sim
