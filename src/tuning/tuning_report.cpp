#include "tuning/tuning_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <map>
#include <sstream>
#include <vector>

#include "config/override.h"
#include "config/parameter_list.h"
#include "config/yaml_document.h"

namespace slipnav {
namespace {

constexpr int kKeyWidth = 40;
constexpr int kNumberWidth = 12;
constexpr int kDigits = 3;

std::ostringstream plainStream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  return out;
}

std::string number(double value) {
  std::ostringstream out = plainStream();
  out << std::setprecision(kDigits) << value;
  return out.str();
}

std::string fixed(double value, int decimals, bool with_sign = false) {
  std::ostringstream out = plainStream();
  out << (with_sign ? std::showpos : std::noshowpos) << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

/// "×/÷ 1.2" for a factor, "± 0.004" for an amount.
std::string uncertainty(const TunedKnob& tuned) {
  return tuned.knob.is_factor ? "×/÷ " + number(std::exp(*tuned.std)) : "± " + number(*tuned.std);
}

/// Configured values of the single parameters by key.
std::map<std::string, double> valuesOf(const Config& config) {
  std::map<std::string, double> values;
  for (const ParameterInfo& info : listParameters(config)) {
    if (const double* value = std::get_if<double>(&info.value)) {
      values[info.key] = *value;
    }
  }
  return values;
}

/// Width in characters of a text whose × ÷ ± take two bytes each.
std::string padded(const std::string& text, int width) {
  int characters = 0;
  for (const char c : text) {
    characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  }
  return std::string(static_cast<std::size_t>(std::max(1, width - characters)), ' ') + text;
}

void writeRow(const std::string& key, const std::vector<std::string>& cells, std::ostream& out) {
  out << std::left << std::setw(kKeyWidth) << key;
  for (const std::string& cell : cells) {
    out << padded(cell, kNumberWidth);
  }
  out << "\n";
}

void writeKnobs(const Config& config, const TuningResult& result, std::ostream& out) {
  const std::map<std::string, double> values = valuesOf(config);
  writeRow("parameter", {"configured", "tuned", "1 sigma", "half A", "half B"}, out);
  std::string untold;
  for (const TunedKnob& tuned : result.knobs) {
    if (!tuned.told) {
      untold += (untold.empty() ? "" : ", ") + tuned.knob.name;
      continue;
    }
    for (const std::string& key : tuned.knob.keys) {
      const double value = values.at(key);
      writeRow(key,
               {number(value), number(moved(tuned.knob, value, tuned.position)), uncertainty(tuned),
                number(moved(tuned.knob, value, tuned.halves[0])), number(moved(tuned.knob, value, tuned.halves[1]))},
               out);
    }
  }
  if (!untold.empty()) {
    out << "not determined by these drives, left as configured: " << untold << "\n";
  }
}

void writeNis(const HeldOut& held_out, std::ostream& out) {
  writeRow("NIS, 1 is exact", {"before", "after", "rows"}, out);
  for (int kind = 0; kind < kComponents; ++kind) {
    const InnovationSums& before = held_out.before[static_cast<std::size_t>(kind)];
    const InnovationSums& after = held_out.after[static_cast<std::size_t>(kind)];
    if (before.rows > 0.0) {
      const std::string now = after.rows > 0.0 ? fixed(after.squared / after.rows, 2) : "-";
      writeRow(std::string("  ") + componentName(static_cast<Component>(kind)),
               {fixed(before.squared / before.rows, 2), now, fixed(before.rows, 0)}, out);
    }
  }
}

}  // namespace

std::string tuningTable(const Config& config, const TuningResult& result) {
  std::ostringstream out = plainStream();
  writeKnobs(config, result, out);
  const HeldOut& held_out = result.held_out;
  out << "held out, " << (result.drives > 1 ? "each half of the drives" : "each half of the drive")
      << " under the fit to the other half:\n  log likelihood " << fixed(held_out.log_likelihood, 1) << " before, "
      << fixed(held_out.log_likelihood + held_out.gain.value, 1) << " after: " << fixed(held_out.gain.value, 1, true)
      << ", 1 sigma " << fixed(held_out.gain.std, 1) << "\n";
  writeNis(held_out, out);
  out << (result.worthwhile ? "worth it: the held-out data are more likely under the tuned values\n"
                            : "not worth it: the held-out data are not clearly more likely, stay with the configured "
                              "values\n");
  return out.str();
}

std::string tuningYaml(const Config& config, const TuningResult& result) {
  const std::map<std::string, double> values = valuesOf(config);
  std::ostringstream out = plainStream();
  out << "# Tuned by maximum likelihood of the innovations; held out, the log likelihood gained "
      << fixed(result.held_out.gain.value, 1) << ", 1 sigma " << fixed(result.held_out.gain.std, 1) << ".\n";
  YAML::Node document;
  for (const TunedKnob& tuned : result.knobs) {
    for (const std::string& key : tuned.told ? tuned.knob.keys : std::vector<std::string>{}) {
      const double value = moved(tuned.knob, values.at(key), tuned.position);
      out << "# " << key << ": " << number(values.at(key)) << " before, 1 sigma " << uncertainty(tuned) << "\n";
      document = mergeYaml(document, toYamlNode(keyOverride(key + "=" + number(value))));
    }
  }
  out << document << "\n";
  return out.str();
}

}  // namespace slipnav
