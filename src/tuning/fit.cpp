#include "tuning/fit.h"

#include <Eigen/Eigenvalues>
#include <limits>
#include <nlopt.hpp>

#include "core/base/square.h"

namespace slipnav {
namespace {

/// In standard deviations of the prior: the first steps, and steps not worth another run.
constexpr double kFirstStep = 0.25;
constexpr double kLastStep = 0.05;
constexpr double kDifference = 0.25;
constexpr int kLongestFit = 15;  // runs per knob
constexpr std::size_t kUsualFit = 10;

/// The optimizer's objective, in standard deviations of the prior.
class Objective {
 public:
  Objective(GainMeter& meter, const DriveParts& parts, const Selection& selection)
      : meter_(meter), parts_(parts), free_(selection.free), best_(selection.position) {}

  static double evaluate(unsigned count, const double* x, double* /*gradient*/, void* self) {
    return static_cast<Objective*>(self)->evaluate(std::vector<double>(x, x + count));
  }

  std::vector<double> bounds(double Knob::*bound) const {
    std::vector<double> x;
    for (const std::size_t i : free_) {
      x.push_back(meter_.knobs()[i].*bound / meter_.knobs()[i].prior_std);
    }
    return x;
  }

  std::vector<double> start() const {
    std::vector<double> x;
    for (const std::size_t i : free_) {
      x.push_back(best_(static_cast<Eigen::Index>(i)) / meter_.knobs()[i].prior_std);
    }
    return x;
  }

  const Eigen::VectorXd& best() const { return best_; }

 private:
  Eigen::VectorXd position(const std::vector<double>& x) const {
    Eigen::VectorXd position = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(meter_.knobs().size()));
    for (std::size_t k = 0; k < free_.size(); ++k) {
      position(static_cast<Eigen::Index>(free_[k])) = x[k] * meter_.knobs()[free_[k]].prior_std;
    }
    return position;
  }

  double evaluate(const std::vector<double>& x) {
    const Eigen::VectorXd where = position(x);
    const double value = meter_.gain(where, parts_) + logPrior(meter_.knobs(), where);
    if (value > best_value_) {
      best_value_ = value;
      best_ = where;
    }
    return value;
  }

  GainMeter& meter_;
  const DriveParts& parts_;
  const std::vector<std::size_t>& free_;
  Eigen::VectorXd best_;
  double best_value_ = -std::numeric_limits<double>::infinity();
};

/// Neighboring positions: steps up and down on one axis, up on two.
Eigen::VectorXd stepped(const GainMeter& meter, Eigen::VectorXd position, std::size_t knob, double sign) {
  position(static_cast<Eigen::Index>(knob)) += sign * kDifference * meter.knobs()[knob].prior_std;
  return position;
}

std::vector<Eigen::VectorXd> positionsAround(const GainMeter& meter, const Eigen::VectorXd& center,
                                             const std::vector<std::size_t>& free) {
  std::vector<Eigen::VectorXd> positions = {center};
  for (const std::size_t i : free) {
    positions.push_back(stepped(meter, center, i, 1.0));
    positions.push_back(stepped(meter, center, i, -1.0));
  }
  for (std::size_t a = 0; a < free.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      positions.push_back(stepped(meter, stepped(meter, center, free[a], 1.0), free[b], 1.0));
    }
  }
  return positions;
}

/// Second derivatives of −log likelihood in units of the prior, from the gains at positionsAround().
Eigen::MatrixXd curvatureFrom(const std::vector<double>& gains, Eigen::Index count) {
  Eigen::MatrixXd curvature(count, count);
  const auto up = [&](Eigen::Index i) { return gains[static_cast<std::size_t>(1 + 2 * i)]; };
  const auto down = [&](Eigen::Index i) { return gains[static_cast<std::size_t>(2 + 2 * i)]; };
  auto pair = gains.begin() + 1 + 2 * count;
  for (Eigen::Index a = 0; a < count; ++a) {
    curvature(a, a) = -(up(a) + down(a) - 2.0 * gains[0]) / square(kDifference);
    for (Eigen::Index b = 0; b < a; ++b) {
      const double mixed = *pair++ - up(a) - up(b) + gains[0];
      curvature(a, b) = curvature(b, a) = -mixed / square(kDifference);
    }
  }
  return curvature;
}

}  // namespace

double logPrior(const std::vector<Knob>& knobs, const Eigen::VectorXd& position) {
  double sum = 0.0;
  for (std::size_t i = 0; i < knobs.size(); ++i) {
    sum -= 0.5 * square(position(static_cast<Eigen::Index>(i)) / knobs[i].prior_std);
  }
  return sum;
}

Eigen::VectorXd fitKnobs(GainMeter& meter, const DriveParts& parts, const Selection& selection) {
  Objective objective(meter, parts, selection);
  const std::size_t free = selection.free.size();
  if (free == 0) {
    return objective.best();
  }
  nlopt::opt optimizer(nlopt::LN_BOBYQA, static_cast<unsigned>(free));
  optimizer.set_max_objective(&Objective::evaluate, &objective);
  optimizer.set_lower_bounds(objective.bounds(&Knob::lower));
  optimizer.set_upper_bounds(objective.bounds(&Knob::upper));
  optimizer.set_initial_step(kFirstStep);
  optimizer.set_xtol_abs(kLastStep);
  optimizer.set_maxeval(kLongestFit * static_cast<int>(free));
  std::vector<double> x = objective.start();
  double value = 0.0;
  try {
    optimizer.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
    // no further step gains anything
  }
  return objective.best();
}

std::size_t runsOfFit(std::size_t free) { return kUsualFit * free; }

std::size_t runsOfCovariance(std::size_t free) { return 1 + 2 * free + free * (free - 1) / 2; }

Eigen::MatrixXd covarianceAt(GainMeter& meter, const DriveParts& parts, const Eigen::VectorXd& position,
                             const std::vector<std::size_t>& free) {
  const auto count = static_cast<Eigen::Index>(free.size());
  const std::vector<double> gains = meter.gains(positionsAround(meter, position, free), parts);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(curvatureFrom(gains, count));
  const Eigen::VectorXd variances = (1.0 + axes.eigenvalues().array().max(0.0)).inverse();
  Eigen::VectorXd unit(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    unit(i) = meter.knobs()[free[static_cast<std::size_t>(i)]].prior_std;
  }
  return unit.asDiagonal() * axes.eigenvectors() * variances.asDiagonal() * axes.eigenvectors().transpose() *
         unit.asDiagonal();
}

}  // namespace slipnav
