#pragma once
/// Pieces of a recording (https://wiki.ros.org/Bags/Format/2.0), read without trusting any length in it.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace slipnav {

/// What is wrong with a recording, in one line.
class BagDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Type of a record.
enum class BagOp : std::uint8_t {
  kMessage = 0x02,
  kFileHeader = 0x03,
  kIndex = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07
};

/// Reads bytes from front to back. Throws BagDamage if they end too early.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : next_(data), left_(size) {}
  explicit ByteReader(const std::vector<std::uint8_t>& bytes) : ByteReader(bytes.data(), bytes.size()) {}

  std::size_t left() const { return left_; }
  const std::uint8_t* take(std::size_t size);
  /// The next `size` bytes.
  ByteReader part(std::size_t size) { return {take(size), size}; }

  /// Numbers are stored in the byte order of the machines that ROS runs on.
  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }

 private:
  const std::uint8_t* next_;
  std::size_t left_;
};

/// The named fields at the start of a record. Throws BagDamage for anything that is not such a list.
class BagFields {
 public:
  explicit BagFields(ByteReader bytes);

  BagOp op() const { return static_cast<BagOp>(number<std::uint8_t>("op")); }
  /// Throws BagDamage unless the record is one of these.
  void require(BagOp wanted) const;

  /// "" if there is no such field.
  std::string text(const std::string& name) const;

  /// Throws BagDamage if there is no such field, or one of another size.
  template <class Number>
  Number number(const std::string& name) const {
    const std::string value = text(name);
    if (value.size() != sizeof(Number)) {
      throw BagDamage("a record has no proper field '" + name + "'");
    }
    return ByteReader(reinterpret_cast<const std::uint8_t*>(value.data()), value.size()).number<Number>();
  }

 private:
  std::map<std::string, std::string> values_;
};

/// A file that is never read beyond its end.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path);

  bool isOpen() const { return file_.is_open(); }
  void seek(std::uint64_t position);
  void skip(std::uint64_t size) { seek(position_ + size); }
  /// Throws BagDamage that says what was requested, if the file ends before.
  std::vector<std::uint8_t> take(std::uint64_t size);
  std::uint32_t takeLength() { return ByteReader(take(sizeof(std::uint32_t))).number<std::uint32_t>(); }
  /// A list of fields preceded by its length.
  BagFields takeFields() { return BagFields(ByteReader(take(takeLength()))); }

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
};

}  // namespace slipnav
