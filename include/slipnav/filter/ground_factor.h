#pragma once
/// How much better the ground is than the worst that the parameters allow for.
///
/// The slip parameters are those of difficult ground. On a road the wheels slip less, in every respect; then the
/// innovations of the wheel speed are smaller than the filter expects. The factor follows them: it scales the variances
/// of slip until the mean normalised innovation squared is what it should be (covariance matching, Mehra 1972). It
/// grows within a second where the ground gets worse, and never beyond the parameters.

#include "slipnav/config/parameter_visitor.h"

namespace slipnav {

/// Block `filter.ground`.
struct GroundFactorParams {
  double gain = 0.02;         ///< per sample
  double least_std = 0.1;     ///< smallest factor on standard deviations; 1: the factor is off
  double expected_nis = 0.9;  ///< aim, a little below one: to the safe side
  void visit(ParameterVisitor& v);
};

/// One factor, of one measurement.
class GroundFactor {
 public:
  explicit GroundFactor(const GroundFactorParams& params) : params_(params) {}

  /// On the variances of the parameters, at most one.
  double variance() const { return variance_; }

  /// @param nis normalised innovation squared per degree of freedom, of a measurement whose expected variance the
  /// factor is part of, accepted or not
  void learn(double nis);

 private:
  GroundFactorParams params_;
  double variance_ = 1.0;
};

}  // namespace slipnav
