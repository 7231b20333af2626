#include "slipnav/core/navigation/drive_fit.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// Degrees of freedom of the fix errors: 4 is usual where a few in a hundred are far off.
constexpr double kStudentFreedom = 4.0;
constexpr int kReweightings = 10;
constexpr std::size_t kLeastFixes = 2;
/// A shorter distance says nothing about a heading.
constexpr double kLeastWay_m = 0.5;
/// Lags searched for: receivers in GPS time are 18 s ahead, buffers hold a few seconds.
constexpr double kLargestLag_s = 40.0;
constexpr double kLagStep_s = 0.5;
/// Fixes with old stamps arrive before the wheel and gyro samples they must wait for: the newest ones are not used.
constexpr Nanoseconds kNewest = 2 * kSecond;
constexpr double kSmallestLag_s = 0.75;
/// Residuals within this many of the fixes' σ, and this share of the distance for slip and bends, do not count.
constexpr double kUsualResidual = 1.5;
constexpr double kUsualSlip = 0.05;
/// A lag has to explain this much of the residuals.
constexpr double kExplained = 0.5;
/// GPS time is ahead of UTC by this much, since 2017.
constexpr double kLeapSeconds = 18.0;

/// A fix and where wheels and gyro put the antenna.
struct Pair {
  Vector2 fix_m;  ///< north, east
  Vector2 track_m;
  double variance_m2;  ///< of the horizontal, mean of both axes
  double weight;
};

std::vector<Pair> pairsOf(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                          const Geodetic& reference, Nanoseconds begin, Nanoseconds end, Nanoseconds lag) {
  std::vector<Pair> pairs;
  for (const PositionFix& fix : fixes) {
    const std::optional<Vector2> antenna = track.antennaAt(fix.stamp + lag);
    const double variance = fix.variance_ned_m2.head<2>().mean();
    if (fix.stamp >= begin && fix.stamp <= end && antenna && variance > 0.0) {
      pairs.push_back(
          {positionDifference(planet, fix.position, reference).head<2>(), *antenna, variance, 1.0 / variance});
    }
  }
  return pairs;
}

DriveFit fitOnce(const std::vector<Pair>& pairs) {
  double sum = 0.0;
  Vector2 fix_mean = Vector2::Zero();
  Vector2 track_mean = Vector2::Zero();
  for (const Pair& pair : pairs) {
    sum += pair.weight;
    fix_mean += pair.weight * pair.fix_m;
    track_mean += pair.weight * pair.track_m;
  }
  fix_mean /= sum;
  track_mean /= sum;
  double cosine = 0.0;
  double sine = 0.0;
  double way_square = 0.0;
  for (const Pair& pair : pairs) {
    const Vector2 p = pair.fix_m - fix_mean;
    const Vector2 q = pair.track_m - track_mean;
    cosine += pair.weight * p.dot(q);
    sine += pair.weight * (q.x() * p.y() - q.y() * p.x());
    way_square += pair.weight * q.squaredNorm();
  }
  DriveFit fit;
  fit.heading_rad = std::atan2(sine, cosine);
  fit.heading_std_rad = 1.0 / std::sqrt(std::max(way_square, std::numeric_limits<double>::min()));
  fit.scale = way_square > 0.0 ? std::hypot(sine, cosine) / way_square : 0.0;
  fit.start_ne_m = fix_mean - fit.scale * (Eigen::Rotation2Dd(fit.heading_rad) * track_mean);
  return fit;
}

double residualSquare(const Pair& pair, const DriveFit& fit) {
  const Vector2 expected = fit.start_ne_m + fit.scale * (Eigen::Rotation2Dd(fit.heading_rad) * pair.track_m);
  return (pair.fix_m - expected).squaredNorm();
}

/// By the fixes' own covariances only: what a robust fit ignores is what reveals another clock.
void describe(const std::vector<Pair>& pairs, DriveFit& fit) {
  double weights = 0.0;
  double residuals = 0.0;
  double variances = 0.0;
  for (const Pair& pair : pairs) {
    weights += 1.0 / pair.variance_m2;
    residuals += residualSquare(pair, fit) / pair.variance_m2;
    variances += 2.0;
    fit.distance_m = std::max(fit.distance_m, (pair.track_m - pairs.front().track_m).norm());
  }
  fit.residual_m = std::sqrt(residuals / weights);
  fit.fix_std_m = std::sqrt(variances / weights);
}

}  // namespace

DriveTrack::DriveTrack(const StartRecording& recording, Nanoseconds begin, double gyro_bias_radps,
                       const Vector3& lever_m)
    : lever_m_(lever_m.head<2>()) {
  const std::vector<WheelMotion>& wheels = recording.wheels();
  std::size_t next = 0;
  Pose pose{0, Vector2::Zero(), 0.0};
  for (const ImuSample& sample : recording.imu()) {
    if (sample.stamp < begin) {
      continue;
    }
    const double dt_s = pose.stamp == 0 ? 0.0 : toSeconds(sample.stamp - pose.stamp);
    while (next < wheels.size() && wheels[next].stamp < sample.stamp) {
      ++next;
    }
    const double speed = wheels.empty() ? 0.0 : wheels[std::min(next, wheels.size() - 1)].motion.forward_mps;
    pose.stamp = sample.stamp;
    pose.heading_rad += dt_s * (sample.omega_ib_b.z() - gyro_bias_radps);
    pose.position_m += dt_s * speed * Vector2(std::cos(pose.heading_rad), std::sin(pose.heading_rad));
    reach_m_ = std::max(reach_m_, pose.position_m.norm());
    poses_.push_back(pose);
  }
}

std::optional<Vector2> DriveTrack::antennaAt(Nanoseconds stamp) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const Pose& pose, Nanoseconds t) { return pose.stamp < t; });
  if (after == poses_.end() || (after == poses_.begin() && after->stamp != stamp)) {
    return std::nullopt;
  }
  return Vector2(after->position_m + Eigen::Rotation2Dd(after->heading_rad) * lever_m_);
}

std::optional<DriveFit> fitDrive(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end, Nanoseconds lag) {
  std::vector<Pair> pairs = pairsOf(planet, fixes, track, reference, begin, end, lag);
  if (pairs.size() < kLeastFixes || (pairs.back().track_m - pairs.front().track_m).norm() < kLeastWay_m) {
    return std::nullopt;
  }
  DriveFit fit = fitOnce(pairs);
  for (int i = 0; i < kReweightings; ++i) {
    for (Pair& pair : pairs) {
      const double square = residualSquare(pair, fit) / pair.variance_m2;
      pair.weight = (kStudentFreedom + 2.0) / (kStudentFreedom + square) / pair.variance_m2;
    }
    fit = fitOnce(pairs);
  }
  describe(pairs, fit);
  return fit;
}

double meanHeight(const std::vector<PositionFix>& fixes, Nanoseconds begin, Nanoseconds end) {
  double height_m = fixes.front().position.height_m;
  for (int i = 0; i < kReweightings; ++i) {
    double weights = 0.0;
    double sum = 0.0;
    for (const PositionFix& fix : fixes) {
      const double variance = fix.variance_ned_m2.z();
      if (fix.stamp >= begin && fix.stamp <= end && variance > 0.0) {
        const double square = (fix.position.height_m - height_m) * (fix.position.height_m - height_m) / variance;
        const double weight = i == 0 ? 1.0 / variance : (kStudentFreedom + 1.0) / (kStudentFreedom + square) / variance;
        weights += weight;
        sum += weight * fix.position.height_m;
      }
    }
    height_m = weights > 0.0 ? sum / weights : height_m;
  }
  return height_m;
}

std::optional<double> lagOfFixes(const Planet& planet, const std::vector<PositionFix>& fixes, const DriveTrack& track,
                                 const Geodetic& reference, Nanoseconds begin, Nanoseconds end) {
  const Nanoseconds first = begin - fromSeconds(kLargestLag_s);  // of the rest, by another clock
  const Nanoseconds last = end - kNewest;
  const std::optional<DriveFit> at_once = fitDrive(planet, fixes, track, reference, begin, last);
  if (at_once && at_once->residual_m < kUsualResidual * at_once->fix_std_m + kUsualSlip * at_once->distance_m) {
    return std::nullopt;
  }
  double best_s = 0.0;
  double best_m = at_once ? at_once->residual_m : std::numeric_limits<double>::infinity();
  const double limit_m = kExplained * best_m;
  for (double lag_s = -kLargestLag_s; lag_s <= kLargestLag_s; lag_s += kLagStep_s) {
    const Nanoseconds lag = fromSeconds(lag_s);
    if (!track.antennaAt(last + lag)) {
      continue;  // the newest fixes say most; a lag that excludes them fits anything
    }
    const std::optional<DriveFit> fit = fitDrive(planet, fixes, track, reference, first, last, lag);
    const bool possible = fit && std::abs(fit->scale - 1.0) < 0.5;
    if (possible && fit->residual_m < best_m) {
      best_m = fit->residual_m;
      best_s = lag_s;
    }
  }
  return best_m < limit_m && std::abs(best_s) >= kSmallestLag_s ? std::optional<double>(best_s) : std::nullopt;
}

std::string describeLag(double lag_s) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << "gps/fix is stamped " << std::abs(lag_s) << " s too "
       << (lag_s > 0.0 ? "early" : "late") << " relative to wheels and gyro";
  if (std::abs(std::abs(lag_s) - kLeapSeconds) < 1.0) {
    text << " (18 s: GPS time instead of UTC?)";
  }
  text << ": fix the clock of the receiver's driver, or set initialization.fix_stamp_offset_s";
  return text.str();
}

}  // namespace slipnav
