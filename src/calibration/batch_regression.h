#pragma once
/// Linear regression with errors that decorrelate slowly, and with outliers.
///
/// Huber's loss by iterated reweighting; the covariance comes from the sums of the scores over batches (batch means,
/// cluster-robust sandwich: Liang and Zeger 1986), which accounts for any correlation of the errors inside a batch.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace slipnav {

/// y = X β + error; rows of one batch share correlated errors.
struct RegressionProblem {
  explicit RegressionProblem(int parameters) : parameters_(parameters) {}

  void add(const Eigen::VectorXd& row, double y, std::size_t batch);

  Eigen::MatrixXd X() const;
  Eigen::VectorXd y() const;
  const std::vector<std::size_t>& batches() const { return batches_; }
  std::size_t rows() const { return y_.size(); }
  int parameters() const { return parameters_; }

 private:
  int parameters_;
  std::vector<double> X_;  ///< row after row
  std::vector<double> y_;
  std::vector<std::size_t> batches_;
};

/// Parameters with the covariance from their batches.
struct RegressionResult {
  Eigen::VectorXd estimate;
  Eigen::MatrixXd covariance;
  /// How many batches of equal weight determine each parameter: (Σh)²/Σh², h the information of a batch on it.
  Eigen::VectorXd effective_batches;
  double residual_std = 0.0;  ///< robust
};

/// The variance of a parameter determined by fewer batches cannot be trusted.
inline constexpr double kLeastBatches = 3.0;

/// With n effective batches an error over the standard deviation from scores follows a Student distribution with n − 1
/// degrees of freedom. The covariance is scaled so that three standard deviations cover 99.73 % of it.
/// Throws std::invalid_argument if the rows do not determine the parameters.
RegressionResult regress(const RegressionProblem& problem);

}  // namespace slipnav
