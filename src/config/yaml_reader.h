#pragma once
/// Fills any parameter struct from YAML and rejects unknown keys.
///
/// Every error is a std::invalid_argument with one line: source and line (if known), dotted key, what is wrong.

#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <vector>

#include "core/parameters/parameter_path.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// The visitor behind readParameters(). Absent keys leave their field unchanged.
class YamlReader : public ParameterVisitor {
 public:
  YamlReader(const YAML::Node& root, std::string source);

  void number(const char* name, double& value, Range range, const char* meaning) override;
  void integer(const char* name, int& value, Range range, const char* meaning) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void choice(const char* name, std::string& value, std::initializer_list<const char*> options,
              const char* meaning) override;
  void numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) override;
  void words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
             const char* meaning) override;

  /// Call once, after the visit: throws if the document has a key that no field has asked for, and names the nearest.
  void refuseUnknownKeys();

 protected:
  bool enterGroup(const char* name, const char* meaning) override;
  void leaveGroup() override;
  std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) override;
  void enterItem(std::size_t index) override;
  void leaveItem() override;
  void leaveList() override;

 private:
  struct Block {
    YAML::Node node;               ///< map, or list of maps; undefined if the document has no such block
    std::set<std::string> unread;  ///< keys of the map that no field has asked for
  };
  struct UnknownKey {
    std::string key;
    YAML::Mark mark;
  };

  YAML::Node child(const std::string& name);
  void openBlock(const YAML::Node& node);
  void closeBlock();
  std::string nearestKey(const std::string& unknown) const;
  double readNumber(const YAML::Node& node, const std::string& key, const Range& range) const;
  std::string readWord(const YAML::Node& node, const std::string& key, const std::vector<std::string>& options) const;
  void requireList(const YAML::Node& node, const std::string& key) const;
  /// Throws if one is given twice.
  std::set<std::string> keysOf(const YAML::Node& map) const;
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const;

  std::string source_;
  ParameterPath path_;
  std::vector<Block> blocks_;
  std::vector<std::string> known_keys_;
  std::vector<UnknownKey> unknown_keys_;
};

/// Fills a struct with visit() from a YAML map. `source` is the document's name in error messages ("" to omit it).
template <class Parameters>
void readParameters(const YAML::Node& root, Parameters& parameters, const std::string& source = "") {
  YamlReader reader(root, source);
  parameters.visit(reader);
  reader.refuseUnknownKeys();
}

}  // namespace slipnav
