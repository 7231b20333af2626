#pragma once
/// A measurement against its prediction: the terms of a configuration's likelihood.

#include <functional>

#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// One measurement as predicted, before the gate and before anything was learned from it.
struct Innovation {
  Nanoseconds stamp = 0;  ///< of the wheel sample
  Component component = kForwardSpeed;
  InnovationSize size;
};

/// Receives every innovation, including those of measurements that are rejected afterwards.
using InnovationSink = std::function<void(const Innovation&)>;

}  // namespace slipnav
