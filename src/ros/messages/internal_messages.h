#pragma once
/// Between the core's own structs and the messages that Ins, Filter and Initializer exchange. Lossless.

#include <slipnav/FilterCorrection.h>
#include <slipnav/InertialState.h>
#include <slipnav/InsInterval.h>
#include <slipnav/InsSteps.h>
#include <slipnav/StartState.h>

#include <algorithm>

#include "core/navigation/exchange.h"
#include "core/ordering/continuous_time.h"

namespace slipnav {

/// The order of a covariance in messages.
using RowMajorCovariance = Eigen::Matrix<double, kErrorStates, kErrorStates, Eigen::RowMajor>;

template <class Array>
void copyVector(const Vector3& v, Array& array) {
  std::copy(v.data(), v.data() + 3, array.begin());
}

template <class Array>
Vector3 vectorOf(const Array& array) {
  return {array[0], array[1], array[2]};
}

InertialState toMessage(const NavigationState& state);
NavigationState fromMessage(const InertialState& message);

InsInterval toMessage(const InsStep& step);
/// @param epoch of the batch that the interval came in
InsStep fromMessage(const InsInterval& message, std::uint32_t epoch);

/// How the clock was set back; the rest of the message is unchanged.
void fill(const ContinuousTime& time, InsSteps& message);
ContinuousTime timeOf(const InsSteps& message);

void fill(const Start& start, StartState& message);
Start fromMessage(const StartState& message);

void fill(const Reply& reply, FilterCorrection& message);
Reply fromMessage(const FilterCorrection& message);

}  // namespace slipnav
