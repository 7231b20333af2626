#pragma once
/// Messages off the bytes of a fuzz input.

#include <ros/serialization.h>

#include <cstdint>
#include <exception>
#include <optional>

namespace slipnav::fuzz {

/// Reads one message after another, each as ROS sends it, with a byte before it that says of which type it is.
class MessageReader {
 public:
  MessageReader(const std::uint8_t* data, std::size_t size)
      : stream_(const_cast<std::uint8_t*>(data), static_cast<std::uint32_t>(size)) {}

  /// The type of the next message, in 0 … types − 1; nothing at the end.
  std::optional<int> nextType(int types) {
    if (stream_.getLength() == 0) {
      return std::nullopt;
    }
    return *stream_.advance(1) % types;
  }

  /// Nothing when the bytes are not such a message, and ROS throws; then there is nothing beyond it either.
  template <class Message>
  std::optional<Message> take() {
    Message message;
    try {
      ros::serialization::deserialize(stream_, message);
    } catch (const std::exception&) {
      stream_ = {nullptr, 0};  // the one that threw stands beyond its end
      return std::nullopt;
    }
    return message;
  }

 private:
  ros::serialization::IStream stream_;
};

}  // namespace slipnav::fuzz
