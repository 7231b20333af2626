#pragma once
/// Everything a user can configure, and where it is read.

#include <string>
#include <vector>

#include "slipnav/config/override.h"
#include "slipnav/config/parameter_visitor.h"
#include "slipnav/config/topics.h"

namespace slipnav {

struct Config {
  std::string planet = "earth";
  TopicNames topics;

  void visit(ParameterVisitor& v);

  /// Reads YAML files over the defaults: blocks are merged, of a value or list given twice the later one wins; then the
  /// overrides in their order. Throws std::invalid_argument of one line that names the file or override, the key and
  /// what is wrong.
  static Config load(const std::vector<std::string>& yaml_files, const std::vector<Override>& overrides = {});
};

}  // namespace slipnav
