#include "ros/messages/hand_over.h"

#include <boost/make_shared.hpp>

#include "ros/messages/internal_messages.h"
#include "ros/runtime/internal_topics.h"

namespace slipnav {
namespace {

constexpr Nanoseconds kInterval = kSecond;  // in sensor time

}  // namespace

HandOver::HandOver(ros::NodeHandle& node) : publisher_(SharedPublisher<StartState>(node, kHandOverTopic, true)) {}

void HandOver::start(const StartState& message, const Geodetic& origin) {
  start_ = message.start;
  session_ = message.session;
  origin_ = origin;
  last_ = 0;
}

void HandOver::offer(const FilterEngine& filter) {
  const Nanoseconds stamp = filter.state().stamp;
  if (stamp - last_ < kInterval) {
    return;
  }
  last_ = stamp;
  InitialState state = filter.snapshot();
  state.origin = origin_;
  const auto message = boost::make_shared<StartState>();
  fill(state, *message);
  publish(message);
}

void HandOver::end(std::uint32_t start) {
  start_ = start;
  publish(boost::make_shared<StartState>());
}

void HandOver::publish(const boost::shared_ptr<StartState>& message) const {
  message->start = start_;
  message->session = session_;
  publisher_.publish(message);
}

}  // namespace slipnav
