#pragma once
/// Order statistics and moments of small samples.

#include <vector>

namespace slipnav {

/// The p-th percentile, p in [0, 100], linear between order statistics (numpy's default). Throws
/// std::invalid_argument for an empty sample or a p outside the range.
double percentile(std::vector<double> values, double p);

double median(std::vector<double> values);

/// Arithmetic mean; throws std::invalid_argument for an empty sample, as do the two below.
double mean(const std::vector<double>& values);

/// Standard deviation about the mean, divisor n.
double standardDeviation(const std::vector<double>& values);

double rootMeanSquare(const std::vector<double>& values);

}  // namespace slipnav
