#include "calibration/batch_regression.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <stdexcept>

namespace slipnav {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kReweightings = 20;
constexpr double kHuber = 2.5;         // standard deviations beyond which an error counts linearly
constexpr double kMadToStd = 1.4826;   // of a normal distribution
constexpr double kLeastPivot = 1e-12;  // of the normalized information, below which parameters cannot be separated
constexpr double kSigmas = 3.0;        // to be kept as promised
constexpr double kConverged = 1e-10;

VectorXd weightsOf(const VectorXd& residual, double std) {
  return residual.unaryExpr([std](double e) { return std::min(1.0, kHuber * std / std::max(std::abs(e), 1e-300)); });
}

double robustStd(const VectorXd& residual) {
  std::vector<double> magnitude(residual.data(), residual.data() + residual.size());
  for (double& value : magnitude) {
    value = std::abs(value);
  }
  const auto middle = magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2);
  std::nth_element(magnitude.begin(), middle, magnitude.end());
  return kMadToStd * *middle;
}

/// Factor on standard deviations from `batches` independent scores: n/(n − 1) on the variance for the fitted parameter,
/// and what makes three standard deviations cover as much as for a normal distribution.
double smallSampleFactor(double batches) {
  const double freedom = std::max(batches, kLeastBatches) - 1.0;
  const double quantile = boost::math::quantile(
      boost::math::complement(boost::math::students_t(freedom), boost::math::cdf(boost::math::normal(), -kSigmas)));
  return quantile / kSigmas * std::sqrt((freedom + 1.0) / freedom);
}

/// Inverse of the information XᵀWX, scaled so that units do not matter.
MatrixXd invert(const MatrixXd& information) {
  const VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<MatrixXd> factors(scale.asDiagonal() * information * scale.asDiagonal());
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > kLeastPivot)) {
    throw std::invalid_argument("the samples do not separate the parameters");
  }
  const auto n = information.rows();
  return scale.asDiagonal() * factors.solve(MatrixXd::Identity(n, n)) * scale.asDiagonal();
}

/// Sums over each batch.
struct Batch {
  VectorXd score;
  MatrixXd information;
};

std::map<std::size_t, Batch> sumBatches(const RegressionProblem& problem, const MatrixXd& X, const VectorXd& score,
                                        const VectorXd& sensitivity) {
  const int n = problem.parameters();
  std::map<std::size_t, Batch> batches;
  for (std::size_t i = 0; i < problem.rows(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    Batch& batch =
        batches.try_emplace(problem.batches()[i], Batch{VectorXd::Zero(n), MatrixXd::Zero(n, n)}).first->second;
    const VectorXd x = X.row(row).transpose();
    batch.score += score(row) * x;
    batch.information += sensitivity(row) * x * x.transpose();
  }
  return batches;
}

/// Adds covariance and effective batches to an estimate.
void judge(const RegressionProblem& problem, const MatrixXd& X, const VectorXd& residual, RegressionResult& result) {
  const double limit = kHuber * result.residual_std;
  const VectorXd sensitivity = residual.unaryExpr([limit](double e) { return std::abs(e) <= limit ? 1.0 : 0.0; });
  const VectorXd score = residual.cwiseProduct(weightsOf(residual, result.residual_std));
  const MatrixXd inverse = invert(X.transpose() * sensitivity.asDiagonal() * X);
  const int n = problem.parameters();
  MatrixXd scores = MatrixXd::Zero(n, n);
  VectorXd sum = VectorXd::Zero(n);
  VectorXd sum_of_squares = VectorXd::Zero(n);
  for (const auto& [index, batch] : sumBatches(problem, X, score, sensitivity)) {
    scores += batch.score * batch.score.transpose();
    const VectorXd share = (inverse * batch.information * inverse).diagonal();
    sum += share;
    sum_of_squares += share.cwiseAbs2();
  }
  result.effective_batches = sum.cwiseAbs2().cwiseQuotient(sum_of_squares.cwiseMax(1e-300));
  const VectorXd small_sample = result.effective_batches.unaryExpr(&smallSampleFactor);
  result.covariance = small_sample.asDiagonal() * inverse * scores * inverse * small_sample.asDiagonal();
}

}  // namespace

void RegressionProblem::add(const VectorXd& row, double y, std::size_t batch) {
  if (row.size() != parameters_) {
    throw std::invalid_argument("a row of a regression must have one entry per parameter");
  }
  X_.insert(X_.end(), row.data(), row.data() + row.size());
  y_.push_back(y);
  batches_.push_back(batch);
}

MatrixXd RegressionProblem::X() const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(X_.data(), static_cast<Eigen::Index>(rows()), parameters_);
}

VectorXd RegressionProblem::y() const {
  return Eigen::Map<const VectorXd>(y_.data(), static_cast<Eigen::Index>(rows()));
}

RegressionResult regress(const RegressionProblem& problem) {
  if (problem.rows() < static_cast<std::size_t>(problem.parameters())) {
    throw std::invalid_argument("there are fewer samples than parameters");
  }
  const MatrixXd X = problem.X();
  const VectorXd y = problem.y();
  RegressionResult result;
  result.estimate = VectorXd::Zero(problem.parameters());
  VectorXd weights = VectorXd::Ones(y.size());
  VectorXd residual = y;
  for (int i = 0; i < kReweightings; ++i) {
    const MatrixXd information = X.transpose() * weights.asDiagonal() * X;
    const VectorXd before = result.estimate;
    result.estimate = invert(information) * (X.transpose() * weights.cwiseProduct(y));
    residual = y - X * result.estimate;
    result.residual_std = robustStd(residual);
    weights = weightsOf(residual, result.residual_std);
    if ((result.estimate - before).norm() <= kConverged * result.estimate.norm()) {
      break;
    }
  }
  judge(problem, X, residual, result);
  return result;
}

}  // namespace slipnav
