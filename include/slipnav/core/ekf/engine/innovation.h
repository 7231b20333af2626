#pragma once
/// What a measurement was against its prediction: the stuff that the likelihood of a configuration is made of.

#include <functional>

#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// One measurement as it was predicted, before the gate and before anything was learned from it.
struct Innovation {
  Nanoseconds stamp = 0;  ///< of the wheel sample
  Component component = kForwardSpeed;
  InnovationSize size;
};

/// Who is to have every innovation, also of measurements that are rejected afterwards.
using InnovationSink = std::function<void(const Innovation&)>;

}  // namespace slipnav
