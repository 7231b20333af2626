#pragma once
/// Position of a visitor in nested parameter blocks, as the dotted key that a user would write.

#include <string>
#include <vector>

namespace slipnav {

/// A stack of block names; blocks are left in the reverse order of entry.
class ParameterPath {
 public:
  void enter(const std::string& name) { prefixes_.push_back(key(name)); }
  void enterItem(std::size_t index) { prefixes_.push_back(current() + "[" + std::to_string(index) + "]"); }
  void leave() { prefixes_.pop_back(); }

  /// Dotted key of the block itself, for example "wheels[2]"; "" at the top.
  std::string current() const { return prefixes_.empty() ? "" : prefixes_.back(); }
  /// Dotted key of a field of the block, for example "wheels[2].radius_m".
  std::string key(const std::string& name) const { return prefixes_.empty() ? name : prefixes_.back() + "." + name; }

 private:
  std::vector<std::string> prefixes_;
};

}  // namespace slipnav
