#pragma once
/// Covariance functions of time, as small types that add and multiply.
///
/// The shapes (Brownian, RBF, Matérn) have no variance of their own: a product has one variance, that of the
/// ConstantKernel in it, so that every parameter of an expression is identifiable. For example the kernel
/// of the paper, σ² min(t,t') exp(−(t−t')²/2ℓ²), is ConstantKernel · BrownianKernel · RbfKernel.
///
/// Times are seconds since the origin of the process. Parameters are natural logarithms, in the order of the
/// kernels in the expression. Kernels work on part of a column of the covariance matrix at a time: a symmetric matrix
/// needs no more, and it stays in cache. A column and its derivatives share the same exponentials.
///
/// Source: C. E. Rasmussen, C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press 2006, chapter 4.

#include <Eigen/Core>
#include <memory>

namespace slipnav {

/// One covariance function, or an expression of several.
class Kernel {
 public:
  using In = const Eigen::Ref<const Eigen::VectorXd>&;
  using Out = Eigen::Ref<Eigen::VectorXd>;
  using Derivatives = Eigen::Ref<Eigen::MatrixXd>;

  virtual ~Kernel() = default;

  virtual Eigen::Index parameterCount() const = 0;

  /// `log_parameters` has parameterCount() entries.
  virtual void setLogParameters(In log_parameters) = 0;

  /// out(i) = k(times(i), reference_time).
  virtual void column(In times, double reference_time, Out out) const = 0;

  /// The same, to the last bit, and derivatives(i, p) = ∂k(times(i), reference_time)/∂log_parameter(p).
  virtual void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const = 0;

  /// k(time, time).
  double variance(double time) const;
};

using KernelPtr = std::shared_ptr<Kernel>;

/// k = σ²; parameter log σ². Alone it is an unknown constant (bias), in a product the variance of that product.
class ConstantKernel : public Kernel {
 public:
  explicit ConstantKernel(double variance) : variance_(variance) {}
  Eigen::Index parameterCount() const override { return 1; }
  void setLogParameters(In log_parameters) override;
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const override;

 private:
  double variance_;
};

/// k = min(t, t') for t, t' ≥ 0, in seconds; no parameter. Its scale depends on the unit and the origin of time.
class BrownianKernel : public Kernel {
 public:
  Eigen::Index parameterCount() const override { return 0; }
  void setLogParameters(In) override {}
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives) const override {
    column(times, reference_time, out);
  }
};

/// k = exp(−(t−t')²/2ℓ²); parameter log ℓ, ℓ in seconds.
class RbfKernel : public Kernel {
 public:
  explicit RbfKernel(double length_scale_s) : length_scale_s_(length_scale_s) {}
  Eigen::Index parameterCount() const override { return 1; }
  void setLogParameters(In log_parameters) override;
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const override;

 private:
  double length_scale_s_;
};

/// The half-integer ν of a Matérn covariance; the value is ν − 1/2, the degree of its polynomial.
enum class MaternOrder { kHalf = 0, kThreeHalves = 1, kFiveHalves = 2, kSevenHalves = 3 };

/// Factor √(2ν) between distance over length scale and the argument of the Matérn polynomial.
double maternRate(MaternOrder order);

/// k = p_ν(x) e^{−x}, x = √(2ν)|t−t'|/ℓ (Rasmussen & Williams 4.16); parameter log ℓ, ℓ in seconds.
class MaternKernel : public Kernel {
 public:
  MaternKernel(MaternOrder order, double length_scale_s) : order_(order), length_scale_s_(length_scale_s) {}
  Eigen::Index parameterCount() const override { return 1; }
  void setLogParameters(In log_parameters) override;
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const override;

 private:
  MaternOrder order_;
  double length_scale_s_;
};

/// k = k₁ + k₂; the parameters of k₁ come first.
class SumKernel : public Kernel {
 public:
  SumKernel(KernelPtr first, KernelPtr second) : first_(std::move(first)), second_(std::move(second)) {}
  Eigen::Index parameterCount() const override { return first_->parameterCount() + second_->parameterCount(); }
  void setLogParameters(In log_parameters) override;
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const override;

 private:
  KernelPtr first_;
  KernelPtr second_;
};

/// k = k₁ k₂; the parameters of k₁ come first.
class ProductKernel : public Kernel {
 public:
  ProductKernel(KernelPtr first, KernelPtr second) : first_(std::move(first)), second_(std::move(second)) {}
  Eigen::Index parameterCount() const override { return first_->parameterCount() + second_->parameterCount(); }
  void setLogParameters(In log_parameters) override;
  void column(In times, double reference_time, Out out) const override;
  void columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const override;

 private:
  KernelPtr first_;
  KernelPtr second_;
};

inline KernelPtr operator+(KernelPtr first, KernelPtr second) {
  return std::make_shared<SumKernel>(std::move(first), std::move(second));
}

inline KernelPtr operator*(KernelPtr first, KernelPtr second) {
  return std::make_shared<ProductKernel>(std::move(first), std::move(second));
}

}  // namespace slipnav
