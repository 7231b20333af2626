#include "slipnav/eval/motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>

namespace slipnav {
namespace {

constexpr int kDegree = 3;
/// Two neighbours on either side: one sample more than a cubic has coefficients.
constexpr std::size_t kMinWindow = 5;

struct Point {
  double t_s;
  Vector3 position_m;
};

using Piece = std::vector<Point>;

/// Samples in [from, to], cut where neighbours are further apart than truth interpolates.
std::vector<Piece> continuousPieces(const TruthTrack& truth, Nanoseconds from, Nanoseconds to, bool horizontal) {
  std::vector<Piece> pieces;
  for (const TruthSample& sample : truth.samples()) {
    if (sample.stamp < from || sample.stamp > to) {
      continue;
    }
    const double t_s = toSeconds(sample.stamp - from);
    if (pieces.empty() || t_s - pieces.back().back().t_s > truth.maxGap()) {
      pieces.emplace_back();
    }
    Vector3 position_m = sample.position_enu_m;
    position_m.z() = horizontal ? 0.0 : position_m.z();
    pieces.back().push_back({t_s, position_m});
  }
  return pieces;
}

/// Points [begin, end) that a fit takes.
struct Window {
  std::size_t begin;
  std::size_t end;
};

/// First point later than `t_s`, or the number of points.
std::size_t firstAfter(const Piece& piece, double t_s) {
  const auto found =
      std::upper_bound(piece.begin(), piece.end(), t_s, [](double t, const Point& point) { return t < point.t_s; });
  return static_cast<std::size_t>(found - piece.begin());
}

/// Window about point i; shifted inwards near an end of the piece, where a shorter one would be noisy.
Window windowAbout(const Piece& piece, std::size_t i, double half_window_s) {
  const double earliest_s = piece.front().t_s + half_window_s;
  const double latest_s = piece.back().t_s - half_window_s;
  const double center_s = std::max(earliest_s, std::min(piece[i].t_s, latest_s));
  // a neighbour at just the half window belongs to it on both sides, whatever the rounding
  constexpr double kSlackS = 1e-6;
  Window window{firstAfter(piece, center_s - half_window_s - kSlackS),
                firstAfter(piece, center_s + half_window_s + kSlackS)};
  constexpr std::size_t kSide = kMinWindow / 2;
  window.begin = std::min({window.begin, i - std::min(i, kSide), piece.size() - kMinWindow});
  window.end = std::max({window.end, std::min(i + kSide + 1, piece.size()), window.begin + kMinWindow});
  return window;
}

/// Velocity of the straight line fitted to the window [m/s].
Vector3 meanVelocity(const Piece& piece, const Window& window) {
  const double count = static_cast<double>(window.end - window.begin);
  double t_mean_s = 0.0;
  for (std::size_t i = window.begin; i < window.end; ++i) {
    t_mean_s += piece[i].t_s / count;
  }
  Vector3 moment = Vector3::Zero();
  double spread = 0.0;
  for (std::size_t i = window.begin; i < window.end; ++i) {
    const double t_s = piece[i].t_s - t_mean_s;
    moment += t_s * (piece[i].position_m - piece[window.begin].position_m);
    spread += t_s * t_s;
  }
  return moment / spread;
}

/// Velocity at point `at` of the cubic fitted to the window [m/s].
Vector3 velocityAt(const Piece& piece, const Window& window, std::size_t at) {
  using Normal = Eigen::Matrix<double, kDegree + 1, kDegree + 1>;
  using Right = Eigen::Matrix<double, kDegree + 1, 3>;
  const double scale_s = piece[window.end - 1].t_s - piece[window.begin].t_s;
  Normal normal = Normal::Zero();
  Right right = Right::Zero();
  for (std::size_t i = window.begin; i < window.end; ++i) {
    const double u = (piece[i].t_s - piece[at].t_s) / scale_s;
    const Eigen::Vector4d powers(1.0, u, u * u, u * u * u);
    normal += powers * powers.transpose();
    right += powers * (piece[i].position_m - piece[at].position_m).transpose();
  }
  const Right coefficients = normal.ldlt().solve(right);
  return coefficients.row(1).transpose() / scale_s;
}

double chordLength(const Piece& piece) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < piece.size(); ++i) {
    length_m += (piece[i].position_m - piece[i - 1].position_m).norm();
  }
  return length_m;
}

double pieceLength(const Piece& piece, const DistanceOptions& options) {
  if (piece.size() < kMinWindow) {
    return chordLength(piece);
  }
  double length_m = 0.0;
  double previous_mps = 0.0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Window window = windowAbout(piece, i, options.half_window_s);
    const Vector3 mean_mps = meanVelocity(piece, window);
    // along the mean direction, since the length of a noisy vector is too long
    const bool stands = mean_mps.norm() <= options.standstill_speed_mps;
    const double speed_mps = stands ? 0.0 : velocityAt(piece, window, i).dot(mean_mps.normalized());
    if (i > 0) {
      length_m += 0.5 * (previous_mps + speed_mps) * (piece[i].t_s - piece[i - 1].t_s);
    }
    previous_mps = speed_mps;
  }
  return length_m;
}

/// Uninterrupted standstills.
std::vector<Stop> stationaryRuns(const EstimateTrack& estimates) {
  std::vector<Stop> runs;
  bool was_stationary = false;
  for (const EstimateSample& estimate : estimates) {
    if (estimate.stationary && !was_stationary) {
      runs.push_back({estimate.stamp, estimate.stamp});
    }
    if (estimate.stationary || was_stationary) {
      runs.back().end = estimate.stamp;
    }
    was_stationary = estimate.stationary;
  }
  return runs;
}

}  // namespace

double distanceDriven(const TruthTrack& truth, Nanoseconds from, Nanoseconds to, const DistanceOptions& options) {
  const std::vector<Piece> pieces = continuousPieces(truth, from, to, options.horizontal);
  double distance_m = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    distance_m += pieceLength(pieces[i], options);
    if (i > 0) {
      distance_m += (pieces[i].front().position_m - pieces[i - 1].back().position_m).norm();
    }
  }
  return distance_m;
}

std::vector<Stop> findStops(const EstimateTrack& estimates, double min_duration_s) {
  std::vector<Stop> merged;
  for (const Stop& run : stationaryRuns(estimates)) {
    if (!merged.empty() && toSeconds(run.begin - merged.back().end) < min_duration_s) {
      merged.back().end = run.end;
    } else {
      merged.push_back(run);
    }
  }
  std::vector<Stop> stops;
  for (const Stop& stop : merged) {
    const double since_first_s = toSeconds(stop.begin - estimates.front().stamp);
    const double until_last_s = toSeconds(estimates.back().stamp - stop.end);
    // motion too short to end a stop is too short to come before or after one as well
    if (std::min({toSeconds(stop.end - stop.begin), since_first_s, until_last_s}) >= min_duration_s) {
      stops.push_back(stop);
    }
  }
  return stops;
}

}  // namespace slipnav
