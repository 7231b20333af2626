#include "core/forecast/gp/markov_shape.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace slipnav {
namespace {

// Order of the expansion of the RBF's spectral density; even, so that all poles come in conjugate pairs. No shape has
// more states.
constexpr int kRbfOrder = 6;

// P with F P + P Fᵀ + L Lᵀ = 0, scaled to hᵀ P h = 1; before that its sign does not matter.
Eigen::MatrixXd normalizedStationaryCovariance(const Eigen::MatrixXd& drift, const Eigen::VectorXd& input,
                                               const Eigen::VectorXd& output) {
  const Eigen::Index n = drift.rows();
  Eigen::MatrixXd lyapunov = Eigen::MatrixXd::Zero(n * n, n * n);
  for (Eigen::Index block = 0; block < n; ++block) {  // I ⊗ F + F ⊗ I
    lyapunov.block(block * n, block * n, n, n) += drift;
    for (Eigen::Index other = 0; other < n; ++other) {
      lyapunov.block(block * n, other * n, n, n).diagonal().array() += drift(block, other);
    }
  }
  const Eigen::MatrixXd diffusion = input * input.transpose();
  const Eigen::VectorXd stacked =
      lyapunov.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(diffusion.data(), n * n));
  const Eigen::MatrixXd covariance = Eigen::Map<const Eigen::MatrixXd>(stacked.data(), n, n);
  const Eigen::MatrixXd symmetric = 0.5 * (covariance + covariance.transpose());
  return symmetric / output.dot(symmetric * output);
}

// Roots of Σ_{j≤n} x^j/j!, the truncated series of e^x: eigenvalues of the companion matrix.
Eigen::VectorXcd truncatedExponentialRoots(int n) {
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  double coefficient = -1.0;  // −n!/j! of the monic polynomial
  for (int j = n - 1; j >= 0; --j) {
    coefficient *= j + 1;
    companion(j, n - 1) = coefficient;
  }
  return companion.eigenvalues();
}

// The stable poles s of 1/Σ x^j/j! at x = −s²/2 with positive imaginary part.
std::vector<std::complex<double>> stableUpperPoles() {
  std::vector<std::complex<double>> poles;
  for (const std::complex<double>& x : truncatedExponentialRoots(kRbfOrder)) {
    const std::complex<double> root = std::sqrt(-2.0 * x);
    const std::complex<double> stable = root.real() > 0.0 ? -root : root;
    if (stable.imag() > 0.0) {
      poles.push_back(stable);
    }
  }
  return poles;
}

// Residue at `pole` of Π 1/((s − p)(s − p*)).
std::complex<double> residue(const std::vector<std::complex<double>>& poles, const std::complex<double>& pole) {
  std::complex<double> product = pole - std::conj(pole);
  for (const std::complex<double>& other : poles) {
    if (other != pole) {
      product *= (pole - other) * (pole - std::conj(other));
    }
  }
  return 1.0 / product;
}

}  // namespace

MarkovShape::MarkovShape(Correlation correlation) : correlation_(correlation) {
  switch (correlation) {
    case Correlation::kConstant:
      buildConstant();
      break;
    case Correlation::kRbf:
      buildRbf();
      break;
    case Correlation::kMatern12:
      buildMatern(MaternOrder::kHalf);
      break;
    case Correlation::kMatern32:
      buildMatern(MaternOrder::kThreeHalves);
      break;
    case Correlation::kMatern52:
      buildMatern(MaternOrder::kFiveHalves);
      break;
    case Correlation::kMatern72:
      buildMatern(MaternOrder::kSevenHalves);
      break;
  }
  stationary_gain_ = stationary_covariance_ * output_;
}

void MarkovShape::buildConstant() {
  drift_ = Eigen::MatrixXd::Zero(1, 1);
  stationary_covariance_ = Eigen::MatrixXd::Ones(1, 1);
  output_ = Eigen::VectorXd::Ones(1);
}

// States: f and its derivatives, each divided by one more power of the rate, so that (s + 1)^n is what F/rate solves.
void MarkovShape::buildMatern(MaternOrder order) {
  const Eigen::Index n = static_cast<Eigen::Index>(order) + 1;
  rate_ = maternRate(order);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(1).setOnes();
  double binomial = 1.0;  // n over k
  for (Eigen::Index k = 0; k < n; ++k) {
    companion(n - 1, k) = -binomial;
    binomial *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  drift_ = rate_ * companion;
  output_ = Eigen::VectorXd::Unit(n, 0);
  stationary_covariance_ = normalizedStationaryCovariance(companion, Eigen::VectorXd::Unit(n, n - 1), output_);
  const Eigen::MatrixXd nilpotent = drift_ + rate_ * Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = 1; k <= n; ++k) {
    nilpotent_powers_.push_back(power);
    power = power * nilpotent / static_cast<double>(k);
  }
}

// One rotating and decaying pair of states per conjugate pair of poles.
void MarkovShape::buildRbf() {
  poles_ = stableUpperPoles();
  const auto n = static_cast<Eigen::Index>(2 * poles_.size());
  drift_ = Eigen::MatrixXd::Zero(n, n);
  output_ = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd input(n);
  Eigen::Index row = 0;
  for (const std::complex<double>& pole : poles_) {
    const std::complex<double> gain = 2.0 * residue(poles_, pole);
    drift_.block<2, 2>(row, row) << pole.real(), pole.imag(), -pole.imag(), pole.real();
    output_(row) = 1.0;
    input.segment<2>(row) << gain.real(), -gain.imag();
    row += 2;
  }
  stationary_covariance_ = normalizedStationaryCovariance(drift_, input, output_);
}

void MarkovShape::transition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const {
  switch (correlation_) {
    case Correlation::kConstant:
      phi.setOnes();
      break;
    case Correlation::kRbf:
      modalTransition(tau, phi);
      break;
    default:
      maternTransition(tau, phi);
      break;
  }
}

double MarkovShape::correlation(double tau) const {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kRbfOrder, kRbfOrder>;
  Matrix phi = Matrix::Zero(dimension(), dimension());
  transition(tau, phi);
  return output_.dot(phi.lazyProduct(stationary_gain_));
}

void MarkovShape::maternTransition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const {
  double factor = std::exp(-rate_ * tau);
  for (const Eigen::MatrixXd& power : nilpotent_powers_) {
    phi += factor * power;
    factor *= tau;
  }
}

void MarkovShape::modalTransition(double tau, Eigen::Ref<Eigen::MatrixXd> phi) const {
  Eigen::Index row = 0;
  for (const std::complex<double>& pole : poles_) {
    const double decay = std::exp(pole.real() * tau);
    const double cosine = decay * std::cos(pole.imag() * tau);
    const double sine = decay * std::sin(pole.imag() * tau);
    phi.block<2, 2>(row, row) << cosine, sine, -sine, cosine;
    row += 2;
  }
}

}  // namespace slipnav
