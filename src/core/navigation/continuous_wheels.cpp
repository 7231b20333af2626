#include "core/navigation/continuous_wheels.h"

namespace slipnav {
namespace {

constexpr std::size_t kMaxWaiting = 100000;

}  // namespace

std::vector<WheelMotion> ContinuousWheels::push(const WheelMotion& wheels) {
  count_.add(wheels.stamp);
  if (count_.steps() == 0) {  // a clock that has restarted
    waiting_.clear();
  }
  waiting_.push_back({wheels, count_.steps()});
  if (waiting_.size() > kMaxWaiting) {
    waiting_.pop_front();
  }
  return takeKnown();
}

std::vector<WheelMotion> ContinuousWheels::learn(const ContinuousTime& time) {
  time_ = time;
  return takeKnown();
}

void ContinuousWheels::recount() {
  count_.setSteps(time_.steps().size());
  waiting_.clear();
}

std::vector<WheelMotion> ContinuousWheels::takeKnown() {
  std::vector<WheelMotion> known;
  while (!waiting_.empty() && waiting_.front().steps <= time_.steps().size()) {
    known.push_back(waiting_.front().wheels);
    known.back().stamp = time_.toContinuous(known.back().stamp, waiting_.front().steps);
    waiting_.pop_front();
  }
  return known;
}

}  // namespace slipnav
