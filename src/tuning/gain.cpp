#include "tuning/gain.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace slipnav {
namespace {

constexpr double kLossOfMissing = 10.0;

}  // namespace

ComponentSums sumsOf(const DriveLikelihood& likelihood, const DrivePart& part) {
  ComponentSums sums;
  for (std::size_t stretch = part.begin; stretch < part.end; ++stretch) {
    for (std::size_t kind = 0; kind < sums.size(); ++kind) {
      sums[kind] += likelihood[stretch][kind];
    }
  }
  return sums;
}

std::vector<double> gainsOver(const DriveLikelihood& base, const DriveLikelihood& other, const DrivePart& part) {
  const ComponentSums before = sumsOf(base, part);
  const ComponentSums after = sumsOf(other, part);
  std::vector<double> gains(part.end - part.begin, 0.0);
  for (std::size_t kind = 0; kind < before.size(); ++kind) {
    const double times = after[kind].measurements > 0.0 ? before[kind].measurements / after[kind].measurements : 0.0;
    for (std::size_t i = 0; i < gains.size(); ++i) {
      const InnovationSums& was = base[part.begin + i][kind];
      gains[i] += times > 0.0 ? times * other[part.begin + i][kind].log_likelihood - was.log_likelihood
                              : -kLossOfMissing * was.measurements;
    }
  }
  return gains;
}

GainMeter::GainMeter(std::vector<Knob> knobs, std::vector<TuningDrive> drives, TuningRuns runs,
                     std::function<void()> on_run)
    : knobs_(std::move(knobs)),
      drives_(std::move(drives)),
      runs_(std::move(runs)),
      on_run_(std::move(on_run)),
      cores_(runs_.slots) {
  base_ = run(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs_.size())), everything());
}

DriveParts GainMeter::everything() const {
  DriveParts parts;
  for (std::size_t drive = 0; drive < drives_.size(); ++drive) {
    parts.push_back({drive, 0, stretchCount(drives_[drive])});
  }
  return parts;
}

DriveLikelihood GainMeter::runDrive(const Eigen::VectorXd& position, std::size_t drive, std::size_t stretches) {
  DriveLikelihood likelihood;
  cores_.run([&] {
    likelihood = runs_.elsewhere
                     ? runs_.elsewhere({drive, stretches, position})
                     : likelihoodOf(drives_[drive], withKnobs(drives_[drive].config, knobs_, position), stretches);
  });
  on_run_();
  return likelihood;
}

std::vector<DriveLikelihood> GainMeter::run(const Eigen::VectorXd& position, const DriveParts& parts) {
  std::vector<std::size_t> stretches(drives_.size(), 0);
  for (const DrivePart& part : parts) {
    stretches[part.drive] = std::max(stretches[part.drive], part.end);
  }
  std::vector<DriveLikelihood> likelihoods(drives_.size());
  parallelFor(drives_.size(), slots(), [&](std::size_t drive) {
    if (stretches[drive] > 0) {
      likelihoods[drive] = runDrive(position, drive, stretches[drive]);
    }
  });
  return likelihoods;
}

double GainMeter::gain(const Eigen::VectorXd& position, const DriveParts& parts) {
  const std::vector<DriveLikelihood> likelihoods = run(position, parts);
  double sum = 0.0;
  for (const DrivePart& part : parts) {
    const std::vector<double> gains = gainsOver(base_[part.drive], likelihoods[part.drive], part);
    sum = std::accumulate(gains.begin(), gains.end(), sum);
  }
  return sum;
}

std::vector<double> GainMeter::gains(const std::vector<Eigen::VectorXd>& positions, const DriveParts& parts) {
  std::vector<double> gains(positions.size());
  parallelFor(positions.size(), slots(), [&](std::size_t i) { gains[i] = gain(positions[i], parts); });
  return gains;
}

}  // namespace slipnav
