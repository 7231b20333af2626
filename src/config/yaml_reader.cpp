#include "config/yaml_reader.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/yaml_document.h"
#include "core/base/text.h"
#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

std::string quote(const std::string& key) { return "'" + key + "'"; }

/// Name after the last dot.
std::string leafOf(const std::string& key) { return key.substr(key.rfind('.') + 1); }

/// The node in words, for an error message.
std::string describeNode(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      return quote(node.Scalar());
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a block";
    default:
      return "nothing";
  }
}

/// An absent node. yaml-cpp allocates several pieces of memory for such a node, and most keys are absent.
const YAML::Node& absentNode() {
  static const YAML::Node absent(YAML::NodeType::Undefined);
  return absent;
}

}  // namespace

YamlReader::YamlReader(const YAML::Node& root, std::string source) : source_(std::move(source)) { openBlock(root); }

void YamlReader::number(const char* name, double& value, Range range, const char* /*meaning*/) {
  if (const YAML::Node node = child(name)) {
    value = readNumber(node, path_.key(name), range);
  }
}

void YamlReader::integer(const char* name, int& value, Range range, const char* /*meaning*/) {
  const YAML::Node node = child(name);
  if (!node) {
    return;
  }
  const std::optional<int> read = node.IsScalar() ? parseInteger(node.Scalar()) : std::nullopt;
  if (!read) {
    fail(node.Mark(), quote(path_.key(name)) + " must be a whole number, not " + describeNode(node));
  }
  readNumber(node, path_.key(name), range);
  value = *read;
}

void YamlReader::flag(const char* name, bool& value, const char* /*meaning*/) {
  const YAML::Node node = child(name);
  if (!node) {
    return;
  }
  bool read = false;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, read)) {
    fail(node.Mark(), quote(path_.key(name)) + " must be true or false, not " + describeNode(node));
  }
  value = read;
}

void YamlReader::text(const char* name, std::string& value, const char* /*meaning*/) {
  if (const YAML::Node node = child(name)) {
    value = readWord(node, path_.key(name), {});
  }
}

void YamlReader::choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                        const char* /*meaning*/) {
  if (const YAML::Node node = child(name)) {
    value = readWord(node, path_.key(name), {options.begin(), options.end()});
  }
}

void YamlReader::numbers(const char* name, std::vector<double>& value, Range range, const char* /*meaning*/) {
  const YAML::Node node = child(name);
  if (!node) {
    return;
  }
  const std::string key = path_.key(name);
  requireList(node, key);
  if (!value.empty() && node.size() != value.size()) {
    fail(node.Mark(),
         quote(key) + " must have " + std::to_string(value.size()) + " numbers, not " + std::to_string(node.size()));
  }
  std::vector<double> read;
  for (std::size_t i = 0; i < node.size(); ++i) {
    read.push_back(readNumber(node[i], key + "[" + std::to_string(i) + "]", range));
  }
  value = std::move(read);
}

void YamlReader::words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
                       const char* /*meaning*/) {
  const YAML::Node node = child(name);
  if (!node) {
    return;
  }
  const std::string key = path_.key(name);
  requireList(node, key);
  std::vector<std::string> read;
  for (std::size_t i = 0; i < node.size(); ++i) {
    read.push_back(readWord(node[i], key + "[" + std::to_string(i) + "]", {options.begin(), options.end()}));
  }
  value = std::move(read);
}

void YamlReader::refuseUnknownKeys() {
  closeBlock();
  if (!unknown_keys_.empty()) {
    const UnknownKey& first = unknown_keys_.front();
    const std::string nearest = nearestKey(first.key);
    fail(first.mark,
         "unknown key " + quote(first.key) + (nearest.empty() ? "" : ", did you mean " + quote(nearest) + "?"));
  }
}

bool YamlReader::enterGroup(const char* name, const char* /*meaning*/) {
  const YAML::Node node = child(name);
  path_.enter(name);
  openBlock(node);
  return true;
}

void YamlReader::leaveGroup() {
  closeBlock();
  path_.leave();
}

std::optional<std::size_t> YamlReader::enterList(const char* name, std::size_t /*current_size*/,
                                                 const char* /*meaning*/) {
  const YAML::Node node = child(name);
  path_.enter(name);
  blocks_.push_back({node, {}});
  if (!node) {
    return std::nullopt;
  }
  requireList(node, path_.current());
  return node.size();
}

void YamlReader::enterItem(std::size_t index) {
  const YAML::Node& list = blocks_.back().node;
  path_.enterItem(index);
  openBlock(list ? list[index] : absentNode());
}

void YamlReader::leaveItem() {
  closeBlock();
  path_.leave();
}

void YamlReader::leaveList() {
  blocks_.pop_back();
  path_.leave();
}

YAML::Node YamlReader::child(const std::string& name) {
  Block& block = blocks_.back();
  known_keys_.push_back(path_.key(name));
  block.unread.erase(name);
  const YAML::Node& node = block.node;
  return node && node.IsMap() ? node[name] : absentNode();
}

void YamlReader::openBlock(const YAML::Node& node) {
  if (node && !node.IsMap() && !node.IsNull()) {
    const std::string what = path_.current().empty() ? "the document" : quote(path_.current());
    fail(node.Mark(), what + " must be a block of keys, not " + describeNode(node));
  }
  blocks_.push_back({node, node ? keysOf(node) : std::set<std::string>()});
}

void YamlReader::closeBlock() {
  const Block& block = blocks_.back();
  if (block.node) {
    for (const auto& entry : block.node) {
      if (block.unread.count(entry.first.Scalar()) > 0) {
        unknown_keys_.push_back({path_.key(entry.first.Scalar()), entry.first.Mark()});
      }
    }
  }
  blocks_.pop_back();
}

std::string YamlReader::nearestKey(const std::string& unknown) const {
  // A right name in the wrong block is more likely than any misspelling.
  const auto displaced = std::find_if(known_keys_.begin(), known_keys_.end(),
                                      [&](const std::string& key) { return leafOf(key) == leafOf(unknown); });
  return displaced != known_keys_.end() ? *displaced : nearestName(unknown, known_keys_);
}

double YamlReader::readNumber(const YAML::Node& node, const std::string& key, const Range& range) const {
  const std::optional<double> value = node.IsScalar() ? parseNumber(node.Scalar()) : std::nullopt;
  if (!value) {
    fail(node.Mark(), quote(key) + " must be a finite number, not " + describeNode(node));
  }
  const std::string complaint = complaintAbout(*value, range);
  if (!complaint.empty()) {
    fail(node.Mark(), quote(key) + " " + complaint);
  }
  return *value;
}

std::string YamlReader::readWord(const YAML::Node& node, const std::string& key,
                                 const std::vector<std::string>& options) const {
  if (!node.IsScalar()) {
    fail(node.Mark(), quote(key) + " must be a text, not " + describeNode(node));
  }
  const std::string complaint = complaintAbout(node.Scalar(), options);
  if (!complaint.empty()) {
    fail(node.Mark(), quote(key) + " " + complaint);
  }
  return node.Scalar();
}

void YamlReader::requireList(const YAML::Node& node, const std::string& key) const {
  if (!node.IsSequence()) {
    fail(node.Mark(), quote(key) + " must be a list, not " + describeNode(node));
  }
}

std::set<std::string> YamlReader::keysOf(const YAML::Node& map) const {
  std::set<std::string> keys;
  for (const auto& entry : map) {
    if (!keys.insert(entry.first.Scalar()).second) {
      fail(entry.first.Mark(), "key " + quote(path_.key(entry.first.Scalar())) + " is given twice");
    }
  }
  return keys;
}

void YamlReader::fail(const YAML::Mark& mark, const std::string& message) const {
  throw std::invalid_argument(yamlLocation(source_, mark) + message);
}

}  // namespace slipnav
