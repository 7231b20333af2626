#pragma once
/// Publishing without a copy.

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <string>

namespace slipnav {

/// Messages that each publisher and subscriber holds: minutes of recordings at high speed.
inline constexpr std::uint32_t kQueueSize = 10000;

/// Takes a message only as a shared pointer: subscribers in the same process get the very object, and it is not even
/// serialized unless somebody outside listens. A message by value, which roscpp would copy, does not compile.
template <class Message>
class SharedPublisher {
 public:
  /// Without a topic; assign another before publishing.
  SharedPublisher() = default;
  /// @param latch late subscribers get the newest message
  SharedPublisher(ros::NodeHandle& node, const std::string& topic, bool latch = false)
      : publisher_(node.advertise<Message>(topic, kQueueSize, latch)) {}

  /// The message must not be changed afterwards.
  void publish(const boost::shared_ptr<const Message>& message) const { publisher_.publish(message); }

  bool hasSubscribers() const { return publisher_.getNumSubscribers() > 0; }

 private:
  ros::Publisher publisher_;
};

}  // namespace slipnav
