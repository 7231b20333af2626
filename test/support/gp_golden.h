#pragma once
/// Reads the tables of test/golden/make_gp_oracle.py.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/forecast/slip_window.h"

namespace slipnav {

/// One case of gp_oracle.csv: the values of each kind in order of their index.
struct GpOracleCase {
  std::string name;
  std::string model;
  std::map<std::string, std::vector<double>> values;

  Eigen::VectorXd vector(const std::string& kind) const;
  double scalar(const std::string& kind) const { return vector(kind)(0); }
};

/// One row of gp_optima.csv.
struct GpOptimum {
  double origin_s;
  double log_marginal_likelihood;
  double variance;
  double length_scale_s;
  double noise_variance;
  double stddev_10s;  ///< of latent slip, 10 s after the last sample
};

std::vector<GpOracleCase> readGpOracle();
std::vector<GpOptimum> readGpOptima();

/// gp_slip.csv: 150 samples of recorded slip at 10 Hz.
SlipSamples readGpSlip();

/// Times 1..count in steps of `unit`, what the oracle's cases use.
Eigen::VectorXd evenTimes(Eigen::Index count, double unit);

}  // namespace slipnav
