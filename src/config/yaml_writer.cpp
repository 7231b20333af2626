#include "config/yaml_writer.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "core/base/text.h"
#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

constexpr std::size_t kCommentWidth = 110;

std::string bracketed(const std::vector<std::string>& items) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "" : ", ") + items[i];
  }
  return text + "]";
}

/// The meaning, followed by the allowed values.
std::string annotated(const std::string& meaning, const std::string& allowed) {
  return allowed.empty() ? meaning : meaning + " (" + allowed + ")";
}

bool isPlainWord(const std::string& text) {
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '.' || c == '-';
  };
  const auto starts_well = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '/'; };
  return !text.empty() && starts_well(text.front()) && std::all_of(text.begin(), text.end(), allowed);
}

/// Words that YAML 1.1 parsers (including roslaunch's) read as a boolean or null.
bool isReservedWord(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::initializer_list<const char*> kReserved = {"true", "false", "yes", "no", "on",
                                                               "off",  "null",  "y",   "n"};
  return std::find(kReserved.begin(), kReserved.end(), text) != kReserved.end();
}

}  // namespace

std::string yamlScalar(const std::string& text) {
  if (isPlainWord(text) && !isReservedWord(text)) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += c;
  }
  return quoted + '"';
}

void YamlWriter::number(const char* name, double& value, Range range, const char* meaning) {
  comment(annotated(meaning, describeRange(range)));
  entry(name, formatNumber(value));
}

void YamlWriter::integer(const char* name, int& value, Range range, const char* meaning) {
  comment(annotated(meaning, describeRange(range)));
  entry(name, std::to_string(value));
}

void YamlWriter::flag(const char* name, bool& value, const char* meaning) {
  comment(meaning);
  entry(name, value ? "true" : "false");
}

void YamlWriter::text(const char* name, std::string& value, const char* meaning) {
  comment(meaning);
  entry(name, yamlScalar(value));
}

void YamlWriter::choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                        const char* meaning) {
  comment(annotated(meaning, joinAlternatives({options.begin(), options.end()})));
  entry(name, yamlScalar(value));
}

void YamlWriter::numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) {
  std::vector<std::string> items;
  std::transform(value.begin(), value.end(), std::back_inserter(items), formatNumber);
  comment(annotated(meaning, describeRange(range)));
  entry(name, bracketed(items));
}

void YamlWriter::words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
                       const char* meaning) {
  std::vector<std::string> items;
  std::transform(value.begin(), value.end(), std::back_inserter(items), yamlScalar);
  const std::string any_of = options.size() == 0 ? "" : "any of ";
  comment(annotated(meaning, any_of + joinAlternatives({options.begin(), options.end()})));
  entry(name, bracketed(items));
}

bool YamlWriter::enterGroup(const char* name, const char* meaning) {
  if (depth_ == 0 && !yaml_.empty()) {
    yaml_ += '\n';
  }
  comment(meaning);
  entry(name, "");
  ++depth_;
  return true;
}

void YamlWriter::leaveGroup() { --depth_; }

std::optional<std::size_t> YamlWriter::enterList(const char* name, std::size_t current_size, const char* meaning) {
  if (depth_ == 0 && !yaml_.empty()) {
    yaml_ += '\n';
  }
  comment(meaning);
  entry(name, current_size == 0 ? "[]" : "");
  depth_ += 2;  // one for the dash, one for the keys after it
  return std::nullopt;
}

void YamlWriter::enterItem(std::size_t index) {
  item_begins_ = true;
  comments_wanted_ = index == 0;
}

void YamlWriter::leaveItem() { comments_wanted_ = true; }

void YamlWriter::leaveList() { depth_ -= 2; }

void YamlWriter::comment(const std::string& text) {
  if (!comments_wanted_) {
    return;
  }
  const std::string start = std::string(2 * (item_begins_ ? depth_ - 1 : depth_), ' ') + "#";
  std::istringstream words(text);
  std::string line = start;
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kCommentWidth) {
      yaml_ += line + '\n';
      line = start;
    }
    line += ' ' + word;
  }
  yaml_ += line + '\n';
}

void YamlWriter::entry(const std::string& name, const std::string& value) {
  std::string indent(2 * depth_, ' ');
  if (item_begins_) {
    indent[indent.size() - 2] = '-';
    item_begins_ = false;
  }
  yaml_ += indent + name + (value.empty() ? ":" : ": " + value) + '\n';
}

}  // namespace slipnav
