#include "ros/bag/bag_file.h"

#include <rosbag/chunked_file.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace slipnav {
namespace {

constexpr char kFirstLine[] = "#ROSBAG V2.0\n";

/// A chunk is not unpacked if it claims to become larger than its method allows: LZ4 spends a byte on 255, BZ2
/// at least 32 bytes on a block of 900 kB.
constexpr std::uint64_t kLargestGrowthLz4 = 256;
constexpr std::uint64_t kLargestGrowthBz2 = 28200;

std::vector<std::uint8_t> unpack(rosbag::CompressionType method, std::uint64_t largest_growth,
                                 std::vector<std::uint8_t> packed, std::uint32_t size) {
  if (size > largest_growth * packed.size()) {
    throw BagDamage("a chunk of " + std::to_string(packed.size()) + " bytes claims to hold " + std::to_string(size));
  }
  std::vector<std::uint8_t> bytes(size);
  rosbag::ChunkedFile().decompress(method, bytes.data(), size, packed.data(), static_cast<unsigned int>(packed.size()));
  return bytes;
}

std::vector<std::uint8_t> unpack(const std::string& method, std::vector<std::uint8_t> packed, std::uint32_t size) {
  if (method == "none") {
    return packed;
  }
  if (method == "lz4") {
    return unpack(rosbag::compression::LZ4, kLargestGrowthLz4, std::move(packed), size);
  }
  if (method == "bz2") {
    return unpack(rosbag::compression::BZ2, kLargestGrowthBz2, std::move(packed), size);
  }
  throw BagDamage("a chunk is packed in an unknown way");
}

/// How ROS 2 recordings are stored.
struct Ros2Format {
  std::string magic;  ///< first bytes of the file
  std::string name;
  std::string types;  ///< option that names its message types; formats before MCAP do not contain them
};

const std::array<Ros2Format, 2> kFormatsOfRos2 = {
    {{"\x89MCAP", "MCAP", ""}, {"SQLite format", "SQLite3", " --src-typestore ros2_humble"}}};

/// Names the format and the command that converts it to ROS 1. @param path of the file or its folder
std::string toConvert(const std::string& path, const Ros2Format& format) {
  const std::filesystem::path source = std::filesystem::path(path + "/.").lexically_normal().parent_path();
  return "is a recording of ROS 2 (" + format.name + "); convert it: pip install rosbags && rosbags-convert --src " +
         path + format.types + " --dst " + source.stem().string() + ".bag --dst-typestore ros1_noetic";
}

/// Complaint about a folder given in place of a file.
std::string complaintOfFolder(const std::string& path) {
  std::ifstream file(path + "/metadata.yaml");
  if (!file) {
    return "is a folder; name the recordings in it";
  }
  const std::string metadata((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const bool is_mcap = metadata.find("storage_identifier: mcap") != std::string::npos;
  return toConvert(path, kFormatsOfRos2[is_mcap ? 0 : 1]);
}

bool startsWith(const std::vector<std::uint8_t>& bytes, const std::string& magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

BagFields takeFields(ByteReader& bytes) { return BagFields(bytes.part(bytes.number<std::uint32_t>())); }

}  // namespace

BagFile::BagFile(const std::string& path) : path_(path), file_(path) {
  if (std::filesystem::is_directory(path)) {
    fail(complaintOfFolder(path));
  }
  if (!file_.isOpen()) {
    fail("cannot be read");
  }
  try {
    readAll();
  } catch (const BagDamage& damage) {
    fail(std::string("is not a complete bag: ") + damage.what());
  }
}

void BagFile::readAll() {
  const std::string first_line = kFirstLine;
  const std::vector<std::uint8_t> beginning = file_.take(first_line.size());
  for (const Ros2Format& format : kFormatsOfRos2) {
    if (startsWith(beginning, format.magic)) {
      fail(toConvert(path_, format));
    }
  }
  if (!std::equal(beginning.begin(), beginning.end(), first_line.begin())) {
    throw BagDamage("its format is not 2.0");
  }
  const BagFields header = file_.takeFields();
  header.require(BagOp::kFileHeader);
  const auto index_place = header.number<std::uint64_t>("index_pos");
  if (index_place == 0) {
    fail("has no index, the recording was cut off; rosbag reindex may repair it");
  }
  if (!header.text("encryptor").empty()) {
    fail("is encrypted; rosbag decrypt makes a copy that can be read");
  }
  file_.seek(index_place);
  for (auto left = header.number<std::uint32_t>("conn_count"); left > 0; --left) {
    readConnection();
  }
  std::map<std::uint64_t, std::uint32_t> chunks;  // topics of each, by its position
  for (auto left = header.number<std::uint32_t>("chunk_count"); left > 0; --left) {
    chunks.insert(readChunkPlace());
  }
  for (const auto& [chunk, topics] : chunks) {
    readIndex(chunk, topics);
  }
  std::sort(entries_.begin(), entries_.end(), [](const BagEntry& a, const BagEntry& b) {
    return std::tie(a.time, a.chunk, a.offset) < std::tie(b.time, b.chunk, b.offset);
  });
}

void BagFile::readConnection() {
  const BagFields record = file_.takeFields();
  record.require(BagOp::kConnection);
  const BagFields content = file_.takeFields();
  connections_.insert(
      {record.number<std::uint32_t>("conn"), {record.text("topic"), content.text("type"), content.text("md5sum")}});
}

std::pair<std::uint64_t, std::uint32_t> BagFile::readChunkPlace() {
  const BagFields record = file_.takeFields();
  record.require(BagOp::kChunkInfo);
  file_.take(file_.takeLength());  // how many messages of each topic
  return {record.number<std::uint64_t>("chunk_pos"), record.number<std::uint32_t>("count")};
}

void BagFile::readIndex(std::uint64_t chunk, std::uint32_t topics) {
  file_.seek(chunk);
  file_.takeFields().require(BagOp::kChunk);
  file_.skip(file_.takeLength());
  for (; topics > 0; --topics) {
    const BagFields record = file_.takeFields();
    record.require(BagOp::kIndex);
    const auto connection_id = record.number<std::uint32_t>("conn");
    if (connections_.count(connection_id) == 0) {
      throw BagDamage("its index names a topic that it does not have");
    }
    const std::vector<std::uint8_t> content = file_.take(file_.takeLength());
    ByteReader bytes(content);
    for (auto left = record.number<std::uint32_t>("count"); left > 0; --left) {
      addEntry(bytes, chunk, connection_id);
    }
  }
}

void BagFile::addEntry(ByteReader& bytes, std::uint64_t chunk, std::uint32_t connection_id) {
  const Nanoseconds seconds = bytes.number<std::uint32_t>();
  const Nanoseconds time = seconds * kSecond + bytes.number<std::uint32_t>();
  const auto offset = bytes.number<std::uint32_t>();
  if (time > 0) {  // rosbag skips the others, too
    entries_.push_back({time, chunk, offset, connection_id, 0});
  }
}

void BagFile::load(std::uint64_t chunk) {
  if (loaded_chunk_ == chunk) {
    return;
  }
  loaded_chunk_ = 0;
  file_.seek(chunk);
  const BagFields record = file_.takeFields();
  record.require(BagOp::kChunk);
  chunk_ = unpack(record.text("compression"), file_.take(file_.takeLength()), record.number<std::uint32_t>("size"));
  loaded_chunk_ = chunk;
}

ByteReader BagFile::content(const BagEntry& entry) {
  load(entry.chunk);
  ByteReader bytes(chunk_);
  bytes.take(entry.offset);
  BagFields record = takeFields(bytes);
  while (record.op() == BagOp::kConnection) {  // precedes the first message of its topic
    bytes.take(bytes.number<std::uint32_t>());
    record = takeFields(bytes);
  }
  record.require(BagOp::kMessage);
  return bytes.part(bytes.number<std::uint32_t>());
}

void BagFile::fail(const std::string& what) const { throw std::invalid_argument(path_ + ": " + what); }

BagParts::BagParts(const std::vector<std::string>& paths) {
  parts_.reserve(paths.size());
  for (const std::string& path : paths) {
    parts_.emplace_back(path);
    entries_.reserve(entries_.size() + parts_.back().entries().size());
    for (BagEntry entry : parts_.back().entries()) {
      entry.part = parts_.size() - 1;
      entries_.push_back(entry);
    }
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const BagEntry& a, const BagEntry& b) { return a.time < b.time; });
}

std::vector<BagConnection> BagParts::connections() const {
  std::vector<BagConnection> all;
  for (const BagFile& part : parts_) {
    all.reserve(all.size() + part.connections().size());
    for (const auto& [id, connection] : part.connections()) {
      all.push_back(connection);
    }
  }
  return all;
}

}  // namespace slipnav
