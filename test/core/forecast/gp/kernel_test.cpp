#include "core/forecast/gp/kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "core/forecast/gp/latent_model.h"

namespace slipnav {
namespace {

Eigen::MatrixXd covariance(const Kernel& kernel, const Eigen::VectorXd& times) {
  Eigen::MatrixXd result(times.size(), times.size());
  for (Eigen::Index j = 0; j < times.size(); ++j) {
    kernel.column(times, times(j), result.col(j));
  }
  return result;
}

Eigen::VectorXd unevenTimes(Eigen::Index count) {
  Eigen::VectorXd times(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    times(i) = 0.05 + 0.1 * k + 0.04 * std::sin(2.0 * k);
  }
  return times;
}

double valueAt(const Kernel& kernel, double t, double reference) {
  Eigen::VectorXd value(1);
  kernel.column(Eigen::VectorXd::Constant(1, t), reference, value);
  return value(0);
}

TEST(Kernel, ShapesHaveTheirClosedForm) {
  EXPECT_DOUBLE_EQ(valueAt(BrownianKernel(), 2.0, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(valueAt(BrownianKernel(), 3.0, 2.0), 2.0);
  EXPECT_NEAR(valueAt(RbfKernel(2.0), 1.0, 4.0), std::exp(-9.0 / 8.0), 1e-15);
  EXPECT_NEAR(valueAt(MaternKernel(MaternOrder::kHalf, 2.0), 1.0, 4.0), std::exp(-1.5), 1e-15);
  const double x = std::sqrt(3.0) * 1.5;
  EXPECT_NEAR(valueAt(MaternKernel(MaternOrder::kThreeHalves, 2.0), 1.0, 4.0), (1.0 + x) * std::exp(-x), 1e-15);
  const double y = std::sqrt(5.0) * 1.5;
  EXPECT_NEAR(valueAt(MaternKernel(MaternOrder::kFiveHalves, 2.0), 1.0, 4.0), (1.0 + y + y * y / 3.0) * std::exp(-y),
              1e-15);
  const double z = std::sqrt(7.0) * 1.5;
  EXPECT_NEAR(valueAt(MaternKernel(MaternOrder::kSevenHalves, 2.0), 1.0, 4.0),
              (1.0 + z + 0.4 * z * z + z * z * z / 15.0) * std::exp(-z), 1e-15);
  EXPECT_DOUBLE_EQ(valueAt(ConstantKernel(0.7), 1.0, 5.0), 0.7);
}

TEST(Kernel, SumsAndProductsComposePointwise) {
  const KernelPtr rbf = std::make_shared<RbfKernel>(0.8);
  const KernelPtr matern = std::make_shared<MaternKernel>(MaternOrder::kThreeHalves, 1.7);
  const KernelPtr brownian = std::make_shared<BrownianKernel>();
  const KernelPtr composed = brownian * rbf + matern;
  const Eigen::VectorXd times = unevenTimes(300);  // longer than one chunk of the product
  const Eigen::MatrixXd expected =
      covariance(*brownian, times).cwiseProduct(covariance(*rbf, times)) + covariance(*matern, times);
  EXPECT_LT((covariance(*composed, times) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Kernel, CovariancesArePositiveSemidefinite) {
  for (const std::string& name : latentModelNames()) {
    const KernelPtr kernel = makeKernel(latentModelByName(name));
    const Eigen::MatrixXd matrix = covariance(*kernel, unevenTimes(60));
    EXPECT_LT((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-15) << name;
    const Eigen::VectorXd eigenvalues = matrix.selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff()) << name;
    EXPECT_GT(eigenvalues.maxCoeff(), 1.0) << name;
  }
}

TEST(Kernel, DerivativesEqualCentralDifferences) {
  const Eigen::VectorXd times = unevenTimes(300);
  const double reference = times(100);
  for (const std::string& name : latentModelNames()) {
    const KernelPtr kernel = makeKernel(latentModelByName(name));
    const Eigen::VectorXd theta = Eigen::VectorXd::LinSpaced(kernel->parameterCount(), -0.4, 0.9);
    Eigen::VectorXd column(times.size());
    Eigen::MatrixXd derivatives(times.size(), theta.size());
    kernel->setLogParameters(theta);
    kernel->columnWithDerivatives(times, reference, column, derivatives);
    const auto columnAt = [&](const Eigen::VectorXd& log_parameters) {
      Eigen::VectorXd values(times.size());
      kernel->setLogParameters(log_parameters);
      kernel->column(times, reference, values);
      return values;
    };
    EXPECT_EQ(column, columnAt(theta)) << name;
    for (Eigen::Index p = 0; p < theta.size(); ++p) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(theta.size(), p);
      const Eigen::VectorXd numeric = (columnAt(theta + step) - columnAt(theta - step)) / 2e-5;
      EXPECT_LT((derivatives.col(p) - numeric).cwiseAbs().maxCoeff(), 1e-7) << name << " " << p;
      EXPECT_GT(derivatives.col(p).cwiseAbs().maxCoeff(), 0.1) << name << " " << p;
    }
  }
}

TEST(Kernel, FarApartIsNothingButNoDenormal) {
  const double far = valueAt(RbfKernel(0.01), 0.0, 100.0);
  EXPECT_LT(far, 1e-200);
  EXPECT_GT(far * 1e-40, 2.3e-308);
}

TEST(Kernel, UnknownModelIsNamed) {
  try {
    latentModelByName("papper");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("papper"), std::string::npos);
  }
}

TEST(Kernel, NamesFitTheParameters) {
  for (const std::string& name : latentModelNames()) {
    const LatentModel model = latentModelByName(name);
    const std::size_t kernel_parameters = static_cast<std::size_t>(makeKernel(model)->parameterCount());
    EXPECT_EQ(hyperparameterNames(model).size(), kernel_parameters + 1) << name;
  }
  const std::vector<std::string> expected = {"variance", "length_scale_s", "noise_variance"};
  EXPECT_EQ(hyperparameterNames(latentModelByName("paper")), expected);
}

}  // namespace
}  // namespace slipnav
