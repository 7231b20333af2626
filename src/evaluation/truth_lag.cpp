#include "evaluation/truth_lag.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

#include "core/base/square.h"

namespace slipnav {
namespace {

using Complex = std::complex<double>;

constexpr double kLargestLag_s = 60.0;
constexpr double kStep_s = 0.5;
constexpr double kFineStep_s = 0.05;
/// Smaller ones are delays of a receiver.
constexpr double kSmallestLag_s = 0.3;
/// A lag has to explain this much of the distance between drive and truth.
constexpr double kExplained = 0.5;
/// And must not do it by leaving this much of the truth aside.
constexpr double kLeastShare = 0.7;
constexpr double kLeastApart_m = 0.1;
constexpr std::size_t kMostPoints = 400;
constexpr std::size_t kLeastPoints = 20;
constexpr double kLongestGap_s = 2.0;
/// Scales that are wheels of another size, and not another track.
constexpr double kLargestScale = 2.0;
/// GPS time is ahead of UTC by this much, since 2017.
constexpr double kLeapSeconds = 18.0;

struct Point {
  double time_s = 0.0;
  Complex place_m;
};

using Points = std::vector<Point>;

Points pointsOf(const PlanarTrack& drive, Nanoseconds origin) {
  Points points;
  points.reserve(drive.size());
  for (const PlanarSample& sample : drive) {
    points.push_back({toSeconds(sample.stamp - origin), {sample.east_m, sample.north_m}});
  }
  return points;
}

Points pointsOf(const TruthTrack& truth, Nanoseconds origin) {
  Points points;
  const std::vector<TruthSample>& samples = truth.samples();
  const std::size_t step = samples.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    points.push_back(
        {toSeconds(samples[i].stamp - origin), {samples[i].position_enu_m.x(), samples[i].position_enu_m.y()}});
  }
  return points;
}

std::optional<Complex> placeAt(const Points& drive, double time_s) {
  const auto after = std::upper_bound(drive.begin(), drive.end(), time_s,
                                      [](double t, const Point& point) { return t < point.time_s; });
  if (after == drive.begin() || after == drive.end()) {
    return std::nullopt;
  }
  const Point& before = *std::prev(after);
  const double interval_s = after->time_s - before.time_s;
  if (interval_s > kLongestGap_s || interval_s <= 0.0) {
    return std::nullopt;
  }
  return before.place_m + (after->place_m - before.place_m) * ((time_s - before.time_s) / interval_s);
}

struct Fit {
  double rms_m = std::numeric_limits<double>::infinity();
  std::size_t points = 0;
};

/// truth = shift + turn · drive by least squares.
Fit fitAt(const Points& drive, const Points& truth, double late_s) {
  std::vector<std::pair<Complex, Complex>> pairs;  // drive, truth
  Complex drive_mean = 0.0;
  Complex truth_mean = 0.0;
  for (const Point& point : truth) {
    if (const auto place = placeAt(drive, point.time_s - late_s)) {
      pairs.emplace_back(*place, point.place_m);
      drive_mean += *place;
      truth_mean += point.place_m;
    }
  }
  Fit fit;
  fit.points = pairs.size();
  const auto count = static_cast<double>(pairs.size());
  Complex product = 0.0;
  double drive_square = 0.0;
  double truth_square = 0.0;
  for (const auto& [place, there] : pairs) {
    const Complex from_mean = place - drive_mean / count;
    const Complex truth_from_mean = there - truth_mean / count;
    product += std::conj(from_mean) * truth_from_mean;
    drive_square += std::norm(from_mean);
    truth_square += std::norm(truth_from_mean);
  }
  const double scale = drive_square > 0.0 ? std::abs(product) / drive_square : 0.0;
  if (pairs.size() >= kLeastPoints && scale < kLargestScale && scale > 1.0 / kLargestScale) {
    fit.rms_m = std::sqrt(std::max(truth_square - std::norm(product) / drive_square, 0.0) / count);
  }
  return fit;
}

struct Best {
  double late_s = 0.0;
  Fit fit;
};

Best bestOf(const Points& drive, const Points& truth, double from_s, double to_s, double step_s, std::size_t least) {
  Best best;
  const int steps = static_cast<int>(std::lround((to_s - from_s) / step_s));
  for (int i = 0; i <= steps; ++i) {
    const double late_s = from_s + i * step_s;
    const Fit fit = fitAt(drive, truth, late_s);
    if (fit.points >= least && fit.rms_m < best.fit.rms_m) {
      best = {late_s, fit};
    }
  }
  return best;
}

}  // namespace

std::optional<TruthLag> truthLag(const PlanarTrack& drive, const TruthTrack& truth) {
  if (drive.empty() || truth.empty()) {
    return std::nullopt;
  }
  const Nanoseconds origin = drive.front().stamp;
  const Points places = pointsOf(drive, origin);
  const Points there = pointsOf(truth, origin);
  const Fit as_stamped = fitAt(places, there, 0.0);
  if (as_stamped.points < kLeastPoints || as_stamped.rms_m < kLeastApart_m) {
    return std::nullopt;
  }
  const auto least = static_cast<std::size_t>(kLeastShare * static_cast<double>(as_stamped.points));
  const Best rough = bestOf(places, there, -kLargestLag_s, kLargestLag_s, kStep_s, least);
  const Best best = bestOf(places, there, rough.late_s - kStep_s, rough.late_s + kStep_s, kFineStep_s, least);
  if (!(best.fit.rms_m < kExplained * as_stamped.rms_m) || std::abs(best.late_s) < kSmallestLag_s) {
    return std::nullopt;
  }
  return TruthLag{best.late_s, as_stamped.rms_m, best.fit.rms_m};
}

std::string describe(const TruthLag& lag) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << "stamped " << std::abs(lag.late_s) << " s too "
       << (lag.late_s > 0.0 ? "late" : "early") << " relative to the drive";
  if (std::abs(std::abs(lag.late_s) - kLeapSeconds) < 2.0 * kSmallestLag_s) {
    text << " (18 s: GPS time instead of UTC?)";
  }
  text << std::setprecision(2) << ": its track fits to " << lag.apart_m << " m at that lag, to " << lag.rms_m
       << " m as it is stamped";
  return text.str();
}

}  // namespace slipnav
