#include "core/forecast/gp/kernel.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

// Sums and products need the values of both kernels side by side: they work on pieces of this length, on the
// stack. Both ways to a column split it alike, since the remainder of packets of two may be rounded differently.
constexpr Eigen::Index kChunk = 128;
using Chunk = Eigen::Matrix<double, kChunk, 1>;
using Array = Eigen::Map<Eigen::ArrayXd>;

// Exponents stop here: e^−600 is negligible beside one, and its products stay clear of denormal numbers,
// on which the arithmetic is many times slower.
constexpr double kMinExponent = -600.0;

/// Calls body(start, length) for consecutive pieces of a column of `size` entries.
template <class Body>
void forEachChunk(Eigen::Index size, Body body) {
  for (Eigen::Index start = 0; start < size; start += kChunk) {
    body(start, std::min(kChunk, size - start));
  }
}

}  // namespace

double Kernel::variance(double time) const {
  const Eigen::Matrix<double, 1, 1> times(time);
  Eigen::Matrix<double, 1, 1> value;
  column(times, time, value);
  return value(0);
}

void ConstantKernel::setLogParameters(In log_parameters) { variance_ = std::exp(log_parameters(0)); }

void ConstantKernel::column(In, double, Out out) const { out.setConstant(variance_); }

void ConstantKernel::columnWithDerivatives(In, double, Out out, Derivatives derivatives) const {
  out.setConstant(variance_);
  derivatives.setConstant(variance_);
}

void BrownianKernel::column(In times, double reference_time, Out out) const { out = times.array().min(reference_time); }

void RbfKernel::setLogParameters(In log_parameters) { length_scale_s_ = std::exp(log_parameters(0)); }

void RbfKernel::column(In times, double reference_time, Out out) const {
  const double rate = 1.0 / length_scale_s_;
  out = (-0.5 * (rate * (times.array() - reference_time)).square()).max(kMinExponent).exp();
}

void RbfKernel::columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const {
  const double rate = 1.0 / length_scale_s_;
  Array z(derivatives.col(0).data(), times.size());
  z = (rate * (times.array() - reference_time)).square();
  out = (-0.5 * z).max(kMinExponent).exp();
  z *= out.array();
}

double maternRate(MaternOrder order) { return std::sqrt(2.0 * static_cast<double>(order) + 1.0); }

void MaternKernel::setLogParameters(In log_parameters) { length_scale_s_ = std::exp(log_parameters(0)); }

void MaternKernel::column(In times, double reference_time, Out out) const {
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk unused;
    columnWithDerivatives(times.segment(start, length), reference_time, out.segment(start, length),
                          unused.head(length));
  });
}

void MaternKernel::columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const {
  const double rate = maternRate(order_) / length_scale_s_;
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    Array x(buffer.data(), length);
    Array value(out.data() + start, length);
    Array derivative(derivatives.col(0).data() + start, length);
    x = rate * (times.segment(start, length).array() - reference_time).abs();
    value = (-x).max(kMinExponent).exp();
    switch (order_) {  // the derivative by log ℓ is −x d/dx of the covariance
      case MaternOrder::kHalf:
        derivative = x * value;
        break;
      case MaternOrder::kThreeHalves:
        derivative = x.square() * value;
        value *= 1.0 + x;
        break;
      case MaternOrder::kFiveHalves:
        derivative = x.square() * (1.0 + x) / 3.0 * value;
        value *= 1.0 + x * (1.0 + x / 3.0);
        break;
      case MaternOrder::kSevenHalves:
        derivative = x.square() * (3.0 + x * (3.0 + x)) / 15.0 * value;
        value *= 1.0 + x * (1.0 + x * (0.4 + x / 15.0));
        break;
    }
  });
}

void SumKernel::setLogParameters(In log_parameters) {
  first_->setLogParameters(log_parameters.head(first_->parameterCount()));
  second_->setLogParameters(log_parameters.tail(second_->parameterCount()));
}

void SumKernel::column(In times, double reference_time, Out out) const {
  first_->column(times, reference_time, out);
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    second_->column(times.segment(start, length), reference_time, buffer.head(length));
    out.segment(start, length) += buffer.head(length);
  });
}

void SumKernel::columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const {
  first_->columnWithDerivatives(times, reference_time, out, derivatives.leftCols(first_->parameterCount()));
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    second_->columnWithDerivatives(
        times.segment(start, length), reference_time, buffer.head(length),
        derivatives.block(start, first_->parameterCount(), length, second_->parameterCount()));
    out.segment(start, length) += buffer.head(length);
  });
}

void ProductKernel::setLogParameters(In log_parameters) {
  first_->setLogParameters(log_parameters.head(first_->parameterCount()));
  second_->setLogParameters(log_parameters.tail(second_->parameterCount()));
}

void ProductKernel::column(In times, double reference_time, Out out) const {
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    first_->column(times.segment(start, length), reference_time, out.segment(start, length));
    second_->column(times.segment(start, length), reference_time, buffer.head(length));
    out.segment(start, length).array() *= buffer.head(length).array();
  });
}

void ProductKernel::columnWithDerivatives(In times, double reference_time, Out out, Derivatives derivatives) const {
  const Eigen::Index of_first = first_->parameterCount();
  const Eigen::Index of_second = second_->parameterCount();
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    Array first(out.data() + start, length);
    Array second(buffer.data(), length);
    first_->columnWithDerivatives(times.segment(start, length), reference_time, first.matrix(),
                                  derivatives.block(start, 0, length, of_first));
    second_->columnWithDerivatives(times.segment(start, length), reference_time, second.matrix(),
                                   derivatives.block(start, of_first, length, of_second));
    for (Eigen::Index p = 0; p < of_first + of_second; ++p) {
      derivatives.col(p).segment(start, length).array() *= p < of_first ? second : first;
    }
    first *= second;
  });
}

}  // namespace slipnav
