#include "core/forecast/gp/gaussian_process.h"

#include <stdexcept>

namespace slipnav {

void checkSamples(const Eigen::VectorXd& times, const Eigen::VectorXd& values) {
  if (times.size() == 0 || times.size() != values.size()) {
    throw std::invalid_argument("gaussian process: times and values must have the same length, at least one");
  }
  if (!times.allFinite() || !values.allFinite()) {
    throw std::invalid_argument("gaussian process: a time or a value is not finite");
  }
  if (times(0) < 0.0) {
    throw std::invalid_argument("gaussian process: the first time lies before the origin");
  }
  const Eigen::Index steps = times.size() - 1;
  if ((times.tail(steps).array() <= times.head(steps).array()).any()) {
    throw std::invalid_argument("gaussian process: times must be strictly increasing");
  }
}

}  // namespace slipnav
