#include "slipnav/forecast/kernel.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

// Products need the values of one factor beside those of the other: they work on pieces of this length, on the stack.
constexpr Eigen::Index kChunk = 128;
using Chunk = Eigen::Matrix<double, kChunk, 1>;
using ChunkArray = Eigen::Array<double, kChunk, 1>;

// Exponents stop here: e^−600 is nothing beside one, and what it is multiplied with stays clear of denormal numbers,
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

void ConstantKernel::addColumnGradient(In, double, In weights, Out gradient) const {
  gradient(0) += variance_ * weights.sum();
}

void WhiteKernel::setLogParameters(In log_parameters) { variance_ = std::exp(log_parameters(0)); }

void WhiteKernel::column(In times, double reference_time, Out out) const {
  out = (times.array() == reference_time).cast<double>() * variance_;
}

void WhiteKernel::addColumnGradient(In times, double reference_time, In weights, Out gradient) const {
  gradient(0) += variance_ * (times.array() == reference_time).select(weights.array(), 0.0).sum();
}

void BrownianKernel::column(In times, double reference_time, Out out) const { out = times.array().min(reference_time); }

void RbfKernel::setLogParameters(In log_parameters) { length_scale_s_ = std::exp(log_parameters(0)); }

void RbfKernel::column(In times, double reference_time, Out out) const {
  const double scale = -0.5 / (length_scale_s_ * length_scale_s_);
  out = (scale * (times.array() - reference_time).square()).max(kMinExponent).exp();
}

void RbfKernel::addColumnGradient(In times, double reference_time, In weights, Out gradient) const {
  const double inverse_s = 1.0 / length_scale_s_;
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    ChunkArray buffer;
    Eigen::Map<Eigen::ArrayXd> z(buffer.data(), length);
    z = (inverse_s * (times.segment(start, length).array() - reference_time)).square();
    gradient(0) += (weights.segment(start, length).array() * z * (-0.5 * z).max(kMinExponent).exp()).sum();
  });
}

double maternRate(MaternOrder order) { return std::sqrt(2.0 * static_cast<double>(order) + 1.0); }

void MaternKernel::setLogParameters(In log_parameters) { length_scale_s_ = std::exp(log_parameters(0)); }

void MaternKernel::column(In times, double reference_time, Out out) const {
  Eigen::Map<Eigen::ArrayXd> x(out.data(), out.size());
  x = maternRate(order_) / length_scale_s_ * (times.array() - reference_time).abs();
  switch (order_) {
    case MaternOrder::kHalf:
      x = (-x).max(kMinExponent).exp();
      break;
    case MaternOrder::kThreeHalves:
      x = (1.0 + x) * (-x).max(kMinExponent).exp();
      break;
    case MaternOrder::kFiveHalves:
      x = (1.0 + x * (1.0 + x / 3.0)) * (-x).max(kMinExponent).exp();
      break;
    case MaternOrder::kSevenHalves:
      x = (1.0 + x * (1.0 + x * (0.4 + x / 15.0))) * (-x).max(kMinExponent).exp();
      break;
  }
}

void MaternKernel::addColumnGradient(In times, double reference_time, In weights, Out gradient) const {
  const double rate = maternRate(order_) / length_scale_s_;
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    ChunkArray buffer;
    Eigen::Map<Eigen::ArrayXd> x(buffer.data(), length);
    x = rate * (times.segment(start, length).array() - reference_time).abs();
    switch (order_) {  // −x d/dx of the covariance
      case MaternOrder::kHalf:
        x = x * (-x).max(kMinExponent).exp();
        break;
      case MaternOrder::kThreeHalves:
        x = x.square() * (-x).max(kMinExponent).exp();
        break;
      case MaternOrder::kFiveHalves:
        x = x.square() * (1.0 + x) / 3.0 * (-x).max(kMinExponent).exp();
        break;
      case MaternOrder::kSevenHalves:
        x = x.square() * (3.0 + x * (3.0 + x)) / 15.0 * (-x).max(kMinExponent).exp();
        break;
    }
    gradient(0) += (weights.segment(start, length).array() * x).sum();
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

void SumKernel::addColumnGradient(In times, double reference_time, In weights, Out gradient) const {
  first_->addColumnGradient(times, reference_time, weights, gradient.head(first_->parameterCount()));
  second_->addColumnGradient(times, reference_time, weights, gradient.tail(second_->parameterCount()));
}

void ProductKernel::setLogParameters(In log_parameters) {
  first_->setLogParameters(log_parameters.head(first_->parameterCount()));
  second_->setLogParameters(log_parameters.tail(second_->parameterCount()));
}

void ProductKernel::column(In times, double reference_time, Out out) const {
  first_->column(times, reference_time, out);
  forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
    Chunk buffer;
    second_->column(times.segment(start, length), reference_time, buffer.head(length));
    out.segment(start, length).array() *= buffer.head(length).array();
  });
}

void ProductKernel::addColumnGradient(In times, double reference_time, In weights, Out gradient) const {
  // A factor without parameters needs no weights, so the values of the other one are not computed for it.
  const auto addFactor = [&](const Kernel& factor, const Kernel& other, Out factor_gradient) {
    if (factor.parameterCount() == 0) {
      return;
    }
    forEachChunk(times.size(), [&](Eigen::Index start, Eigen::Index length) {
      Chunk buffer;
      other.column(times.segment(start, length), reference_time, buffer.head(length));
      buffer.head(length).array() *= weights.segment(start, length).array();
      factor.addColumnGradient(times.segment(start, length), reference_time, buffer.head(length), factor_gradient);
    });
  };
  addFactor(*first_, *second_, gradient.head(first_->parameterCount()));
  addFactor(*second_, *first_, gradient.tail(second_->parameterCount()));
}

}  // namespace slipnav
