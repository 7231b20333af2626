#include "tuning/tuner.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/base/square.h"
#include "tuning/fit.h"

namespace slipnav {
namespace {

/// A knob is undetermined if its 1σ after the drives is above this, in standard deviations of the prior.
constexpr double kLeastKnowledge = 0.7;
constexpr double kLeastMeasurements = 100.0;
/// The gain on held-out data must be beyond this many of its own standard deviations.
constexpr double kSure = 2.0;
/// Typical number worth fitting.
constexpr std::size_t kUsualKnobs = 2;

double measurementsOf(const ComponentSums& sums) {
  return std::accumulate(sums.begin(), sums.end(), 0.0,
                         [](double sum, const InnovationSums& kind) { return sum + kind.measurements; });
}

void add(const ComponentSums& more, ComponentSums& sums) {
  for (std::size_t kind = 0; kind < sums.size(); ++kind) {
    sums[kind] += more[kind];
  }
}

/// The stretch up to which a drive has half of its measurements.
std::size_t middleOf(const DriveLikelihood& likelihood) {
  const double all = measurementsOf(sumsOf(likelihood, {0, 0, likelihood.size()}));
  double so_far = 0.0;
  std::size_t stretch = 0;
  while (stretch < likelihood.size() && 2.0 * so_far < all) {
    so_far += measurementsOf(likelihood[stretch++]);
  }
  return stretch;
}

/// Counts runs, and reports progress.
class Counter {
 public:
  explicit Counter(const TuningWatcher& watcher) : watcher_(watcher) {}
  void expect(std::size_t runs) {
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_.expected = progress_.runs + runs;
  }
  void count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++progress_.runs;
    progress_.expected = std::max(progress_.expected, progress_.runs);
    watcher_(progress_);
  }

 private:
  const TuningWatcher& watcher_;
  std::mutex mutex_;
  TuningProgress progress_;
};

void requireNoTruth(const std::vector<TuningDrive>& drives) {
  for (const TuningDrive& drive : drives) {
    if (drive.config.initialization.source == "truth") {
      throw std::invalid_argument("initialization.source is truth: tuning uses none, choose another start");
    }
  }
}

void requireStarts(const GainMeter& meter) {
  for (std::size_t drive = 0; drive < meter.drives().size(); ++drive) {
    const DriveLikelihood& likelihood = meter.base()[drive];
    if (measurementsOf(sumsOf(likelihood, {drive, 0, likelihood.size()})) == 0.0) {
      throw std::invalid_argument(meter.drives()[drive].name +
                                  ": the navigation never starts; see what evaluate says about it");
    }
  }
}

/// Judges what was fitted to the other half.
void judge(GainMeter& meter, const Eigen::VectorXd& position, const DriveParts& parts, HeldOut& held_out) {
  const std::vector<DriveLikelihood> after = meter.run(position, parts);
  for (const DrivePart& part : parts) {
    const DriveLikelihood& base = meter.base()[part.drive];
    add(sumsOf(base, part), held_out.before);
    add(sumsOf(after[part.drive], part), held_out.after);
    held_out.gain.add(gainsOver(base, after[part.drive], part));
  }
}

HeldOut judgeHalves(GainMeter& meter, const std::array<DriveParts, 2>& halves,
                    const std::array<Eigen::VectorXd, 2>& fitted) {
  HeldOut held_out;
  judge(meter, fitted[0], halves[1], held_out);
  judge(meter, fitted[1], halves[0], held_out);
  for (const InnovationSums& kind : held_out.before) {
    held_out.log_likelihood += kind.log_likelihood;
  }
  return held_out;
}

/// Current values of the fitted knobs, and their uncertainty. One known hardly better than before goes
/// back to its configured value, also in the halves.
void settle(GainMeter& meter, const std::vector<std::size_t>& free, std::array<Eigen::VectorXd, 3>& fitted,
            TuningResult& result) {
  const Eigen::MatrixXd covariance = covarianceAt(meter, meter.everything(), fitted[2], free);
  for (std::size_t k = 0; k < free.size(); ++k) {
    TunedKnob& tuned = result.knobs[free[k]];
    const auto i = static_cast<Eigen::Index>(free[k]);
    const double by_curvature = covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k));
    const double std = std::sqrt(by_curvature + square(0.5 * (fitted[0](i) - fitted[1](i))));
    tuned.told = std < kLeastKnowledge * tuned.knob.prior_std;
    if (!tuned.told) {
      fitted[0](i) = fitted[1](i) = fitted[2](i) = 0.0;
      continue;
    }
    tuned.position = fitted[2](i);
    tuned.std = std;
    tuned.halves = {fitted[0](i), fitted[1](i)};
  }
}

}  // namespace

std::array<DriveParts, 2> halvesOf(const GainMeter& meter) {
  std::array<DriveParts, 2> halves;
  for (const DrivePart& drive : meter.everything()) {
    if (meter.drives().size() > 1) {
      halves[drive.drive % 2].push_back(drive);
    } else {
      const std::size_t middle = middleOf(meter.base()[drive.drive]);
      halves[0].push_back({drive.drive, 0, middle});
      halves[1].push_back({drive.drive, middle, drive.end});
    }
  }
  for (const DriveParts& half : halves) {
    double measurements = 0.0;
    for (const DrivePart& part : half) {
      measurements += measurementsOf(sumsOf(meter.base()[part.drive], part));
    }
    if (measurements < kLeastMeasurements) {
      throw std::invalid_argument("too short to tune anything: one half has only " +
                                  std::to_string(static_cast<int>(measurements)) + " measurements");
    }
  }
  return halves;
}

TuningResult tune(std::vector<Knob> knobs, std::vector<TuningDrive> drives, const TuningWatcher& watcher,
                  TuningRuns runs) {
  requireNoTruth(drives);
  Counter counter(watcher);
  const std::size_t count = drives.size();
  const std::size_t all = knobs.size();
  const auto runs_of_fits = [count](std::size_t free) {
    return count * ((count > 1 ? 2 : 3) * runsOfFit(free) + runsOfCovariance(free) + 2);
  };
  counter.expect(count * (1 + runsOfSelection(all, kUsualKnobs)) + runs_of_fits(kUsualKnobs));
  GainMeter meter(std::move(knobs), std::move(drives), std::move(runs), [&counter] { counter.count(); });
  requireStarts(meter);
  const std::array<DriveParts, 2> halves = halvesOf(meter);
  const Selection selection = selectKnobs(meter, halves);
  counter.expect(runs_of_fits(selection.free.size()));

  std::array<Eigen::VectorXd, 3> fitted;
  const std::array<DriveParts, 3> parts = {halves[0], halves[1], meter.everything()};
  parallelFor(fitted.size(), fitted.size(), [&](std::size_t i) { fitted[i] = fitKnobs(meter, parts[i], selection); });

  TuningResult result;
  result.drives = count;
  for (const Knob& knob : meter.knobs()) {
    result.knobs.emplace_back().knob = knob;
  }
  if (!selection.free.empty()) {
    settle(meter, selection.free, fitted, result);
  }
  result.held_out = judgeHalves(meter, halves, {fitted[0], fitted[1]});
  result.worthwhile = result.held_out.gain.isBeyond(kSure);
  return result;
}

}  // namespace slipnav
