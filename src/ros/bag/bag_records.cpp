#include "ros/bag/bag_records.h"

#include <algorithm>

namespace slipnav {

const std::uint8_t* ByteReader::take(std::size_t size) {
  if (size > left_) {
    throw BagDamage("a record claims to have " + std::to_string(size) + " bytes more where there are " +
                    std::to_string(left_));
  }
  const std::uint8_t* taken = next_;
  next_ += size;
  left_ -= size;
  return taken;
}

BagFields::BagFields(ByteReader bytes) {
  while (bytes.left() > 0) {
    const auto length = bytes.number<std::uint32_t>();
    const std::string field(reinterpret_cast<const char*>(bytes.take(length)), length);
    const std::size_t equals = field.find('=');
    if (equals == std::string::npos) {
      throw BagDamage("a record has a field without a name");
    }
    values_[field.substr(0, equals)] = field.substr(equals + 1);
  }
}

void BagFields::require(BagOp wanted) const {
  if (op() != wanted) {
    throw BagDamage("a record is of another kind than its place says");
  }
}

std::string BagFields::text(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? "" : found->second;
}

RecordFile::RecordFile(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
  if (isOpen()) {
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(file_.tellg(), 0));
    seek(0);
  }
}

void RecordFile::seek(std::uint64_t position) {
  position_ = std::min(position, size_);
  file_.seekg(static_cast<std::streamoff>(position_));
}

std::vector<std::uint8_t> RecordFile::take(std::uint64_t size) {
  if (size > size_ - position_) {
    throw BagDamage("a record at byte " + std::to_string(position_) + " claims to have " + std::to_string(size) +
                    " bytes, the file has " + std::to_string(size_));
  }
  std::vector<std::uint8_t> bytes(size);
  file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file_) {
    throw BagDamage("it cannot be read at byte " + std::to_string(position_));
  }
  position_ += size;
  return bytes;
}

}  // namespace slipnav
