#include "tuning/selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// In standard deviations of the prior: a factor of 1.7.
constexpr double kStep = 0.5;
/// The parabola through three positions is not trusted farther away, in steps.
constexpr double kLongestMove = 2.0;
/// Of a dozen knobs, one gains two standard deviations by luck.
constexpr double kSure = 2.5;
constexpr std::size_t kMostKnobs = 6;

/// Gain of a move, by half and stretch.
using HalfGains = std::array<std::vector<double>, 2>;

double sumOf(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

HalfGains gainsByHalf(const std::vector<DriveLikelihood>& base, const std::vector<DriveLikelihood>& other,
                      const std::array<DriveParts, 2>& halves) {
  HalfGains gains;
  for (std::size_t half = 0; half < halves.size(); ++half) {
    for (const DrivePart& part : halves[half]) {
      const std::vector<double> more = gainsOver(base[part.drive], other[part.drive], part);
      gains[half].insert(gains[half].end(), more.begin(), more.end());
    }
  }
  return gains;
}

/// One knob moved up and down.
struct Trial {
  double up_step = 0.0;  ///< as far as the bounds allow
  double down_step = 0.0;
  HalfGains up;
  HalfGains down;

  /// The direction that one half prefers, judged on the other; none if it prefers to stay.
  Gain crossed() const {
    Gain gain;
    for (std::size_t half = 0; half < 2; ++half) {
      const double up_gain = sumOf(up[half]);
      const double down_gain = sumOf(down[half]);
      if (std::max(up_gain, down_gain) > 0.0) {
        gain.add((up_gain > down_gain ? up : down)[1 - half]);
      }
    }
    return gain;
  }

  /// Where a parabola through the three gains has its maximum.
  double move() const {
    const double up_gain = sumOf(up[0]) + sumOf(up[1]);
    const double down_gain = sumOf(down[0]) + sumOf(down[1]);
    const double best_step = up_gain > down_gain ? up_step : down_step;
    const double bend = up_gain + down_gain;
    if (up_step != -down_step || bend >= 0.0) {
      return best_step;
    }
    return std::clamp(0.5 * up_step * (down_gain - up_gain) / bend, -kLongestMove * up_step, kLongestMove * up_step);
  }
};

std::vector<Trial> tryAll(GainMeter& meter, const Eigen::VectorXd& position, const std::array<DriveParts, 2>& halves) {
  const std::size_t count = meter.knobs().size();
  std::vector<Trial> trials(count);
  std::vector<std::vector<DriveLikelihood>> runs(2 * count + 1);
  parallelFor(runs.size(), meter.slots(), [&](std::size_t i) {
    Eigen::VectorXd moved = position;
    if (i < 2 * count) {
      const Knob& knob = meter.knobs()[i / 2];
      const auto k = static_cast<Eigen::Index>(i / 2);
      const double step = (i % 2 == 0 ? kStep : -kStep) * knob.prior_std;
      moved(k) = std::clamp(position(k) + step, knob.lower, knob.upper);
      (i % 2 == 0 ? trials[i / 2].up_step : trials[i / 2].down_step) = moved(k) - position(k);
    }
    runs[i] = meter.run(moved, meter.everything());
  });
  for (std::size_t k = 0; k < count; ++k) {
    trials[k].up = gainsByHalf(runs.back(), runs[2 * k], halves);
    trials[k].down = gainsByHalf(runs.back(), runs[2 * k + 1], halves);
  }
  return trials;
}

}  // namespace

void Gain::add(const std::vector<double>& stretches) {
  const double sum = sumOf(stretches);
  const double mean = stretches.empty() ? 0.0 : sum / static_cast<double>(stretches.size());
  double variance = square(std);
  for (const double gain : stretches) {
    variance += square(gain - mean);
  }
  value += sum;
  std = std::sqrt(variance);
}

Selection selectKnobs(GainMeter& meter, const std::array<DriveParts, 2>& halves) {
  Selection selection;
  selection.position = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(meter.knobs().size()));
  while (selection.free.size() < std::min(kMostKnobs, meter.knobs().size())) {
    const std::vector<Trial> trials = tryAll(meter, selection.position, halves);
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < trials.size(); ++k) {
      const bool is_taken = std::find(selection.free.begin(), selection.free.end(), k) != selection.free.end();
      const Gain gain = trials[k].crossed();
      if (!is_taken && gain.isBeyond(kSure) && (!best || gain.value > trials[*best].crossed().value)) {
        best = k;
      }
    }
    if (!best) {
      break;
    }
    const Knob& knob = meter.knobs()[*best];
    double& where = selection.position(static_cast<Eigen::Index>(*best));
    where = std::clamp(where + trials[*best].move(), knob.lower, knob.upper);
    selection.free.push_back(*best);
  }
  return selection;
}

std::size_t runsOfSelection(std::size_t knobs, std::size_t taken) {
  return (2 * knobs + 1) * (std::min({taken, kMostKnobs - 1, knobs - 1}) + 1);
}

}  // namespace slipnav
