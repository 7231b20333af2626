#include "support/gp_golden.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "evaluation/slip_forecast.h"

namespace slipnav {
namespace {

std::string goldenPath(const std::string& name) { return std::string(SLIPNAV_SOURCE_DIR) + "/test/golden/" + name; }

std::vector<std::vector<std::string>> readRows(const std::string& name) {
  std::ifstream file(goldenPath(name));
  std::string line;
  if (!std::getline(file, line)) {
    throw std::runtime_error(goldenPath(name) + ": cannot be read");
  }
  std::vector<std::vector<std::string>> rows;
  while (std::getline(file, line)) {
    std::istringstream stream(line);
    rows.emplace_back();
    for (std::string field; std::getline(stream, field, ',');) {
      rows.back().push_back(field);
    }
  }
  return rows;
}

}  // namespace

Eigen::VectorXd GpOracleCase::vector(const std::string& kind) const {
  const std::vector<double>& entries = values.at(kind);
  return Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

std::vector<GpOracleCase> readGpOracle() {
  std::vector<GpOracleCase> cases;
  for (const std::vector<std::string>& row : readRows("gp_oracle.csv")) {
    if (cases.empty() || cases.back().name != row.at(0)) {
      cases.push_back({row.at(0), row.at(1), {}});
    }
    cases.back().values[row.at(2)].push_back(std::stod(row.at(4)));
  }
  return cases;
}

std::vector<GpOptimum> readGpOptima() {
  std::vector<GpOptimum> optima;
  for (const std::vector<std::string>& row : readRows("gp_optima.csv")) {
    optima.push_back({std::stod(row.at(0)), std::stod(row.at(1)), std::stod(row.at(2)), std::stod(row.at(3)),
                      std::stod(row.at(4)), std::stod(row.at(5))});
  }
  return optima;
}

SlipSamples readGpSlip() { return readSlipCsv(goldenPath("gp_slip.csv")); }

Eigen::VectorXd evenTimes(Eigen::Index count, double unit) {
  return unit * Eigen::VectorXd::LinSpaced(count, 1.0, static_cast<double>(count));
}

}  // namespace slipnav
