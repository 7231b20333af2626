#pragma once
/// Recordings as stored on disk: messages by time.
///
/// rosbag trusts the lengths and offsets in a file: where one is corrupted, it requests up to 4 GB or reads
/// beyond its memory, and ends the program. Here everything is checked against the file's contents.

#include <ros/serialization.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros/bag/bag_records.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

/// A topic as one node published it.
struct BagConnection {
  std::string topic;
  std::string type;
  std::string md5sum;  ///< of the definition of its messages
};

/// Location of a message.
struct BagEntry {
  Nanoseconds time = 0;             ///< of its recording
  std::uint64_t chunk = 0;          ///< position of its chunk in the file
  std::uint32_t offset = 0;         ///< of its record in the chunk
  std::uint32_t connection_id = 0;  ///< of the topic
  std::size_t part = 0;             ///< of a recording in several files, see BagParts
};

/// A complete, unencrypted recording of format 2.0, plain or compressed by LZ4 or BZ2. Errors are
/// std::invalid_argument with one line that names the file.
class BagFile {
 public:
  explicit BagFile(const std::string& path);

  /// All messages in recording order.
  const std::vector<BagEntry>& entries() const { return entries_; }
  const std::map<std::uint32_t, BagConnection>& connections() const { return connections_; }
  const BagConnection& connection(const BagEntry& entry) const { return connections_.at(entry.connection_id); }

  /// Whether the message has this type, as known to this package.
  template <class Message>
  bool holds(const BagEntry& entry) const {
    return connection(entry).md5sum == ros::message_traits::md5sum<Message>();
  }

  /// The message, which must have this type.
  template <class Message>
  Message read(const BagEntry& entry) {
    if (!holds<Message>(entry)) {
      fail("topic '" + connection(entry).topic + "' is not of the " +
           std::string(ros::message_traits::datatype<Message>()) + " known here");
    }
    Message message;
    try {
      ByteReader bytes = content(entry);
      const auto size = static_cast<std::uint32_t>(bytes.left());
      ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes.take(size)), size);
      ros::serialization::deserialize(stream, message);
    } catch (const std::exception& error) {  // also std::bad_alloc, for a list that claims to be longer than memory
      fail("is damaged: a message of topic '" + connection(entry).topic + "': " + error.what());
    }
    return message;
  }

 private:
  void readAll();
  void readConnection();
  std::pair<std::uint64_t, std::uint32_t> readChunkPlace();
  void readIndex(std::uint64_t chunk, std::uint32_t topics);
  void addEntry(ByteReader& bytes, std::uint64_t chunk, std::uint32_t connection_id);
  void load(std::uint64_t chunk);
  ByteReader content(const BagEntry& entry);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  RecordFile file_;
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<BagEntry> entries_;
  std::uint64_t loaded_chunk_ = 0;  ///< position in the file; 0 for none
  std::vector<std::uint8_t> chunk_;
};

/// One recording in several files, as `rosbag record --split` leaves it. Each may number its topics differently.
class BagParts {
 public:
  explicit BagParts(const std::vector<std::string>& paths);

  /// All messages of all parts in recording order.
  const std::vector<BagEntry>& entries() const { return entries_; }
  /// Of all parts.
  std::vector<BagConnection> connections() const;
  const BagConnection& connection(const BagEntry& entry) const { return parts_[entry.part].connection(entry); }

  template <class Message>
  bool holds(const BagEntry& entry) const {
    return parts_[entry.part].holds<Message>(entry);
  }

  template <class Message>
  Message read(const BagEntry& entry) {
    return parts_[entry.part].read<Message>(entry);
  }

 private:
  std::vector<BagFile> parts_;
  std::vector<BagEntry> entries_;
};

}  // namespace slipnav
