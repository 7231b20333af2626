#include "config/renamed_keys.h"

#include <array>
#include <stdexcept>

#include "config/yaml_document.h"

namespace slipnav {
namespace {

struct RenamedKey {
  const char* block;
  const char* former;
  const char* present;
};

/// Removed one release after the renaming.
constexpr std::array<RenamedKey, 3> kRenamedKeys = {{
    {"initialization", "levelling_window_s", "leveling_window_s"},
    {"zero_motion", "least_velocity_std_mps", "min_velocity_std_mps"},
    {"zero_motion", "largest_velocity_std_mps", "max_velocity_std_mps"},
}};

std::string quote(const RenamedKey& key, const char* name) { return std::string("'") + key.block + "." + name + "'"; }

}  // namespace

std::vector<std::string> renameFormerKeys(YAML::Node& document, const std::string& source) {
  std::vector<std::string> warnings;
  for (const RenamedKey& key : kRenamedKeys) {
    YAML::Node block = document.IsMap() ? document[key.block] : YAML::Node();
    if (!block.IsDefined() || !block.IsMap() || !block[key.former]) {
      continue;
    }
    const std::string where = yamlLocation(source, block[key.former].Mark());
    const std::string former = quote(key, key.former);
    const std::string present = quote(key, key.present);
    if (block[key.present]) {
      throw std::invalid_argument(where + former + " is the former name of " + present + ", which is given as well");
    }
    block[key.present] = block[key.former];
    block.remove(key.former);
    warnings.push_back(where + former + " is now " + present + "; the former name works in this release only");
  }
  return warnings;
}

}  // namespace slipnav
