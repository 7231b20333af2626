#pragma once
/// Gain of another configuration in log likelihood over the configured one, on parts of one or several drives.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "evaluation/parallel_for.h"
#include "tuning/drive_likelihood.h"
#include "tuning/knob.h"
#include "tuning/tuning_runs.h"

namespace slipnav {

/// Successive stretches of one drive.
struct DrivePart {
  std::size_t drive = 0;
  std::size_t begin = 0;
  std::size_t end = 0;  ///< the first one that no longer belongs to it
};

using DriveParts = std::vector<DrivePart>;

/// Sums of a part by kind of measurement.
ComponentSums sumsOf(const DriveLikelihood& likelihood, const DrivePart& part);

/// ln p(other)/p(base) of each stretch of a part. A kind of measurement counts as often as in `base`: how often the
/// filter compares depends on its state, and an additional comparison is not a gain. If one kind is missing altogether
/// each of its measurements counts as a loss of ten.
std::vector<double> gainsOver(const DriveLikelihood& base, const DriveLikelihood& other, const DrivePart& part);

/// Drives, and the gain on them from moving knobs about their configuration.
class GainMeter {
 public:
  /// @param runs what runs the drives; @param on_run called after each run of a drive, from any thread
  GainMeter(std::vector<Knob> knobs, std::vector<TuningDrive> drives, TuningRuns runs, std::function<void()> on_run);

  const std::vector<Knob>& knobs() const { return knobs_; }
  const std::vector<TuningDrive>& drives() const { return drives_; }
  /// Under the configured values.
  const std::vector<DriveLikelihood>& base() const { return base_; }

  /// All drives from start to end.
  DriveParts everything() const;

  /// The drives of the parts with the knobs moved by `position`, each as far as the parts reach; the others are empty.
  std::vector<DriveLikelihood> run(const Eigen::VectorXd& position, const DriveParts& parts);

  /// The sum of gainsOver() of all parts.
  double gain(const Eigen::VectorXd& position, const DriveParts& parts);

  /// How many runs there may be at a time.
  std::size_t slots() const { return runs_.slots; }

  /// The same at several positions, as many at a time as there are slots.
  std::vector<double> gains(const std::vector<Eigen::VectorXd>& positions, const DriveParts& parts);

 private:
  DriveLikelihood runDrive(const Eigen::VectorXd& position, std::size_t drive, std::size_t stretches);

  std::vector<Knob> knobs_;
  std::vector<TuningDrive> drives_;
  TuningRuns runs_;
  std::function<void()> on_run_;
  Cores cores_;
  std::vector<DriveLikelihood> base_;
};

}  // namespace slipnav
