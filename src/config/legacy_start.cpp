#include "config/legacy_start.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "config/yaml_document.h"
#include "slipnav/core/base/types.h"

namespace slipnav {
namespace {

using Triple = std::array<double, 3>;

/// The first block of this name, at the top or deeper. Parameter blocks have no cycles.
YAML::Node find(const YAML::Node& node, const std::string& name) {
  if (!node.IsMap()) {
    return YAML::Node(YAML::NodeType::Undefined);
  }
  if (const YAML::Node found = node[name]) {
    return found;
  }
  for (const auto& entry : node) {
    if (const YAML::Node found = find(entry.second, name)) {
      return found;
    }
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

double component(const YAML::Node& block, const std::string& axis, const std::string& what) {
  double value = 0.0;
  const bool there = block.IsMap() && block[axis] && block[axis].IsScalar();
  if (!there || !(std::istringstream(block[axis].Scalar()) >> value) || !std::isfinite(value)) {
    throw std::invalid_argument(what + "/" + axis + " must be a number");
  }
  return value;
}

/// From the first of the names that the file contains.
std::optional<Triple> tripleOf(const YAML::Node& document, const std::string& file,
                               std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const YAML::Node block = find(document, name)) {
      const std::string what = file + ": " + name;
      return Triple{component(block, "x", what), component(block, "y", what), component(block, "z", what)};
    }
  }
  return std::nullopt;
}

std::string exact(double value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

std::string list(const Triple& values, double unit) {
  return "[" + exact(values[0] / unit) + ", " + exact(values[1] / unit) + ", " + exact(values[2] / unit) + "]";
}

}  // namespace

std::vector<Override> legacyStart(const std::string& file) {
  const YAML::Node document = loadYamlFile(file);
  const std::optional<Triple> place = tripleOf(document, file, {"init_llh"});
  const std::optional<Triple> attitude = tripleOf(document, file, {"init_att"});
  if (!place || !attitude) {
    throw std::invalid_argument(file + ": there is no " + (place ? "init_att" : "init_llh"));
  }
  std::vector<Override> start;
  const auto set = [&start, &file](const char* key, const std::string& value) {
    start.push_back({{"initialization", key}, value, file});
  };
  set("source", "given");
  set("latitude_deg", exact(radToDeg((*place)[0])));
  set("longitude_deg", exact(radToDeg((*place)[1])));
  set("height_m", exact((*place)[2]));
  set("heading_deg", exact(std::remainder(radToDeg((*attitude)[2]), 360.0)));
  if (const std::optional<Triple> bias = tripleOf(document, file, {"init_bias_a", "mean_bias_a"})) {
    set("accel_bias_ug", list(*bias, kMicroG));
  }
  if (const std::optional<Triple> bias = tripleOf(document, file, {"init_bias_g", "mean_bias_g"})) {
    set("gyro_bias_deg_per_h", list(*bias, degPerHourToRadps(1.0)));
  }
  return start;
}

}  // namespace slipnav
