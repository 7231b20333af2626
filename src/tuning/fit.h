#pragma once
/// Maximum of log likelihood plus log prior over the knobs, and its curvature there.

#include "tuning/selection.h"

namespace slipnav {

/// Log-normal (of a factor) or normal prior about the configured values, relative to these.
double logPrior(const std::vector<Knob>& knobs, const Eigen::VectorXd& position);

/// Moves the selected knobs from their current values, the others stay at zero. BOBYQA (M. J. D. Powell, report DAMTP
/// 2009/NA06) of NLopt, which needs no derivatives: gates and the order of events make the likelihood rough on a
/// small scale.
Eigen::VectorXd fitKnobs(GainMeter& meter, const DriveParts& parts, const Selection& selection);

/// Approximate number of runs of each drive, for this many selected knobs.
std::size_t runsOfFit(std::size_t free);
std::size_t runsOfCovariance(std::size_t free);

/// Covariance of the selected knobs: the inverse of the negative second derivatives of log likelihood plus log prior,
/// by differences over a quarter of the prior's deviation. The prior's own if the likelihood is not concave.
Eigen::MatrixXd covarianceAt(GainMeter& meter, const DriveParts& parts, const Eigen::VectorXd& position,
                             const std::vector<std::size_t>& free);

}  // namespace slipnav
