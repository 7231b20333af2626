#pragma once
/// A parameter struct with one field of each kind, and a helper to look at error messages.

#include <string>
#include <vector>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav::test {

struct SampleItem {
  std::string name = "unnamed";
  double radius_m = 0.1;

  void visit(ParameterVisitor& v) {
    v.text("name", name, "what the item is called");
    v.number("radius_m", radius_m, {0.01, 1.0}, "radius [m]");
  }
};

struct SampleBlock {
  double gate = 3.0;
  std::vector<std::string> updates = {"wheel"};
  std::vector<double> lever_m = {1.0, 2.0, 3.0};

  void visit(ParameterVisitor& v) {
    v.number("gate", gate, {0.0}, "innovation gate [sigma]");
    v.words("updates", updates, {"wheel", "zupt"}, "which measurements are used");
    v.numbers("lever_m", lever_m, {-10.0, 10.0}, "lever arm [m]");
  }
};

struct SampleParameters {
  int seed = 1;
  bool enabled = true;
  std::string mode = "off";
  std::string label = "a b";
  SampleBlock filter;
  std::vector<SampleItem> wheels = {{"left", 0.2}, {"right", 0.3}};

  void visit(ParameterVisitor& v) {
    v.integer("seed", seed, {0.0, 100.0}, "random seed");
    v.flag("enabled", enabled, "whether anything happens");
    v.choice("mode", mode, {"off", "advise", "active"}, "what happens");
    v.text("label", label, "free text");
    v.group("filter", filter, "the filter");
    v.list("wheels", wheels, "the wheels");
  }
};

/// The message of the Exception that `action` throws; "nothing was thrown" if it throws none.
template <class Exception, class Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace slipnav::test
