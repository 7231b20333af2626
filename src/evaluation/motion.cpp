#include "evaluation/motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace slipnav {
namespace {

constexpr int kDegree = 3;
/// Two neighbors on either side: one sample more than a cubic has coefficients.
constexpr std::size_t kMinWindow = 5;

struct Point {
  double t_s;
  Vector3 position_m;
};

using Piece = std::vector<Point>;

/// Samples in [from, to], split where neighbors are further apart than truth interpolates.
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
  // a neighbor at exactly the half window belongs to it on both sides, whatever the rounding
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

/// Slope at point i of the curve through the points: central difference, one-sided at the ends [m/s].
Vector3 slopeAt(const Piece& piece, std::size_t i) {
  const Point& before = piece[i - std::min<std::size_t>(i, 1)];
  const Point& after = piece[std::min(i + 1, piece.size() - 1)];
  return (after.position_m - before.position_m) / (after.t_s - before.t_s);
}

/// Length of the cubic Hermite curve from point i to the next, by three-point Gauss-Legendre quadrature.
double curveLength(const Piece& piece, std::size_t i) {
  const double dt_s = piece[i + 1].t_s - piece[i].t_s;
  const Vector3 chord = piece[i + 1].position_m - piece[i].position_m;
  const Vector3 from = slopeAt(piece, i) * dt_s;
  const Vector3 to = slopeAt(piece, i + 1) * dt_s;
  const double offset = 0.5 * std::sqrt(0.6);
  const std::array<std::array<double, 2>, 3> nodes_and_weights = {
      {{0.5 - offset, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + offset, 5.0 / 18.0}}};
  double length_m = 0.0;
  for (const auto& [u, weight] : nodes_and_weights) {
    const Vector3 derivative =
        6.0 * u * (1.0 - u) * chord + (1.0 - u) * (1.0 - 3.0 * u) * from + u * (3.0 * u - 2.0) * to;
    length_m += weight * derivative.norm();
  }
  return length_m;
}

/// Length through points too sparse to average: they are used as they are.
double interpolatedLength(const Piece& piece, double standstill_speed_mps) {
  double length_m = 0.0;
  for (std::size_t i = 0; i + 1 < piece.size(); ++i) {
    // noise may move one pair of points but not their neighbors with them
    const Window pair{i, i + 2};
    const Window neighbors{i - std::min<std::size_t>(i, 1), std::min(i + 3, piece.size())};
    const double slower_mps = std::min(meanVelocity(piece, pair).norm(), meanVelocity(piece, neighbors).norm());
    if (slower_mps > standstill_speed_mps) {
      length_m += curveLength(piece, i);
    }
  }
  return length_m;
}

/// Whether the fit finds, on average, as many samples within its window as it needs.
bool isDense(const Piece& piece, double half_window_s) {
  const double intervals = static_cast<double>(piece.size()) - 1.0;
  return piece.size() >= kMinWindow && intervals * 2.0 * half_window_s >=
                                           static_cast<double>(kMinWindow - 1) * (piece.back().t_s - piece.front().t_s);
}

double pieceLength(const Piece& piece, const DistanceOptions& options) {
  if (!isDense(piece, options.half_window_s)) {
    return interpolatedLength(piece, options.standstill_speed_mps);
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
    // motion too short to end a stop is also too short to precede or follow one
    if (std::min({toSeconds(stop.end - stop.begin), since_first_s, until_last_s}) >= min_duration_s) {
      stops.push_back(stop);
    }
  }
  return stops;
}

}  // namespace slipnav
