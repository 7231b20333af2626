#pragma once
/// Neighbors of an epoch in an ordered track.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Indices around a stamp and how far it lies from the first to the second, in [0, 1].
struct Bracket {
  std::size_t before;
  std::size_t after;
  double fraction;
};

/// Neighbors of `stamp` in samples ordered by their member `stamp`. None outside the track, and none strictly inside
/// a gap longer than `max_gap_s`.
template <class Sample>
std::optional<Bracket> findBracket(const std::vector<Sample>& samples, Nanoseconds stamp, double max_gap_s) {
  const auto next = std::lower_bound(samples.begin(), samples.end(), stamp,
                                     [](const Sample& sample, Nanoseconds t) { return sample.stamp < t; });
  if (next == samples.end()) {
    return std::nullopt;
  }
  const auto after = static_cast<std::size_t>(next - samples.begin());
  if (next->stamp == stamp) {
    return Bracket{after, after, 0.0};
  }
  if (after == 0) {
    return std::nullopt;
  }
  const Nanoseconds begin = samples[after - 1].stamp;
  const double gap_s = toSeconds(next->stamp - begin);
  if (gap_s > max_gap_s) {
    return std::nullopt;
  }
  return Bracket{after - 1, after, toSeconds(stamp - begin) / gap_s};
}

/// Linear interpolation between two values.
template <class Value>
Value blend(const Value& from, const Value& to, double fraction) {
  return (1.0 - fraction) * from + fraction * to;
}

}  // namespace slipnav
