#include "config/command_line.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "core/base/text.h"
#include "core/parameters/parameter_checker.h"

namespace slipnav {
namespace {

constexpr std::size_t kMeaningColumn = 32;

std::string quote(const std::string& text) { return "'" + text + "'"; }

/// Dashes make an option, except for a lone dash or a negative number.
bool looksLikeOption(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && !parseNumber(argument);
}

bool asksForHelp(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::any_of(arguments.begin(), end, [](const std::string& a) { return a == "--help" || a == "-h"; });
}

std::string helpLine(const std::string& left, const std::string& meaning) {
  std::string line = "  " + left;
  line += line.size() + 2 > kMeaningColumn ? "\n" + std::string(kMeaningColumn, ' ')
                                           : std::string(kMeaningColumn - line.size(), ' ');
  return line + meaning + "\n";
}

}  // namespace

bool Arguments::given(const std::string& name) const { return slot(name).given; }

const std::string& Arguments::text(const std::string& name) const {
  const Slot& found = slot(name);
  if (found.values.empty()) {
    throw std::logic_error("argument " + quote(name) + " has no single value");
  }
  return found.values.back();
}

double Arguments::number(const std::string& name, Range range) const {
  const std::optional<double> value = parseNumber(text(name));
  const std::string& shown = slot(name).shown;
  if (!value) {
    throw UsageError(shown + " must be a number, not " + quote(text(name)));
  }
  if (const std::string complaint = complaintAbout(*value, range); !complaint.empty()) {
    throw UsageError(shown + " " + complaint);
  }
  return *value;
}

int Arguments::integer(const std::string& name, Range range) const {
  const std::optional<int> value = parseInteger(text(name));
  if (!value) {
    throw UsageError(slot(name).shown + " must be a whole number, not " + quote(text(name)));
  }
  number(name, range);
  return *value;
}

const std::vector<std::string>& Arguments::all(const std::string& name) const { return slot(name).values; }

const Arguments::Slot& Arguments::slot(const std::string& name) const {
  const auto found = slots_.find(name);
  if (found == slots_.end()) {
    throw std::logic_error("argument " + quote(name) + " was never declared");
  }
  return found->second;
}

CommandLine::CommandLine(std::string program, std::string summary)
    : program_(std::move(program)), summary_(std::move(summary)) {}

CommandLine& CommandLine::flag(const std::string& name, const std::string& meaning) {
  declarations_.push_back({Kind::kFlag, name, "", meaning, "", {}});
  return *this;
}

CommandLine& CommandLine::option(const std::string& name, const std::string& value_name, const std::string& meaning,
                                 const std::string& default_value) {
  declarations_.push_back({Kind::kOption, name, value_name, meaning, default_value, {}});
  return *this;
}

CommandLine& CommandLine::choice(const std::string& name, const std::vector<std::string>& choices,
                                 const std::string& meaning, const std::string& default_value) {
  std::string value_name;
  for (const std::string& word : choices) {
    value_name += (value_name.empty() ? "" : "|") + word;
  }
  declarations_.push_back({Kind::kOption, name, value_name, meaning, default_value, choices});
  return *this;
}

CommandLine& CommandLine::repeated(const std::string& name, const std::string& value_name, const std::string& meaning) {
  declarations_.push_back({Kind::kRepeated, name, value_name, meaning, "", {}});
  return *this;
}

CommandLine& CommandLine::positional(const std::string& name, const std::string& meaning) {
  declarations_.push_back({Kind::kPositional, name, "", meaning, "", {}});
  return *this;
}

CommandLine& CommandLine::positionals(const std::string& name, const std::string& meaning) {
  declarations_.push_back({Kind::kPositionals, name, "", meaning, "", {}});
  return *this;
}

Arguments CommandLine::parse(int argc, const char* const* argv) const { return parse({argv + 1, argv + argc}); }

Arguments CommandLine::parse(const std::vector<std::string>& arguments) const {
  Arguments result = withDefaults();
  result.help_requested_ = asksForHelp(arguments);
  if (result.help_requested_) {
    return result;
  }
  const std::vector<const Declaration*> wanted = expected();
  std::size_t positional_count = 0;
  bool options_ended = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!options_ended && arguments[i] == "--") {
      options_ended = true;
    } else if (!options_ended && looksLikeOption(arguments[i])) {
      i = takeOption(arguments, i, result);
    } else if (positional_count < wanted.size()) {
      store(*wanted[positional_count++], arguments[i], result);
    } else if (!wanted.empty() && wanted.back()->kind == Kind::kPositionals) {
      store(*wanted.back(), arguments[i], result);
    } else {
      throw UsageError("unexpected argument " + quote(arguments[i]));
    }
  }
  if (positional_count < wanted.size()) {
    throw UsageError("missing argument " + wanted[positional_count]->name);
  }
  return result;
}

std::string CommandLine::help() const {
  std::string usage = "usage: " + program_;
  std::string details;
  for (const Declaration* argument : expected()) {
    usage += " " + argument->name + (argument->kind == Kind::kPositionals ? "..." : "");
    details += helpLine(argument->name, argument->meaning);
  }
  for (const Declaration& item : declarations_) {
    if (isPositional(item)) {
      continue;
    }
    std::string meaning = item.meaning;
    if (item.kind == Kind::kRepeated) {
      meaning += "; may be repeated";
    } else if (!item.default_value.empty()) {
      meaning += " [" + item.default_value + "]";
    }
    details += helpLine("--" + item.name + (item.value_name.empty() ? "" : " " + item.value_name), meaning);
  }
  return usage + " [options]\n\n" + summary_ + "\n\n" + details + helpLine("--help", "show this text");
}

Arguments CommandLine::withDefaults() const {
  Arguments result;
  for (const Declaration& item : declarations_) {
    Arguments::Slot slot;
    slot.shown = (isPositional(item) ? "" : "--") + item.name;
    if (item.kind == Kind::kOption) {
      slot.values = {item.default_value};
    }
    result.slots_[item.name] = slot;
  }
  return result;
}

const CommandLine::Declaration& CommandLine::findOption(const std::string& shown) const {
  std::vector<std::string> known = {"--help"};
  for (const Declaration& item : declarations_) {
    if (isPositional(item)) {
      continue;
    }
    if (shown == "--" + item.name) {
      return item;
    }
    known.push_back("--" + item.name);
  }
  throw UsageError("unknown option " + quote(shown) + ", did you mean " + quote(nearestName(shown, known)) + "?");
}

bool CommandLine::isPositional(const Declaration& item) {
  return item.kind == Kind::kPositional || item.kind == Kind::kPositionals;
}

std::vector<const CommandLine::Declaration*> CommandLine::expected() const {
  std::vector<const Declaration*> found;
  for (const Declaration& item : declarations_) {
    if (isPositional(item)) {
      found.push_back(&item);
    }
  }
  return found;
}

std::size_t CommandLine::takeOption(const std::vector<std::string>& arguments, std::size_t index,
                                    Arguments& result) const {
  const std::string& argument = arguments[index];
  const std::size_t equals = argument.find('=');
  const std::string shown = argument.substr(0, equals);
  const Declaration& declaration = findOption(shown);
  if (declaration.kind == Kind::kFlag) {
    if (equals != std::string::npos) {
      throw UsageError(shown + " takes no value");
    }
    result.slots_[declaration.name].given = true;
    return index;
  }
  if (equals != std::string::npos) {
    store(declaration, argument.substr(equals + 1), result);
    return index;
  }
  if (index + 1 == arguments.size() || looksLikeOption(arguments[index + 1])) {
    throw UsageError(shown + " needs a value: " + declaration.value_name);
  }
  store(declaration, arguments[index + 1], result);
  return index + 1;
}

void CommandLine::store(const Declaration& declaration, const std::string& value, Arguments& result) {
  Arguments::Slot& slot = result.slots_[declaration.name];
  if (const std::string complaint = complaintAbout(value, declaration.choices); !complaint.empty()) {
    throw UsageError(slot.shown + " " + complaint);
  }
  if (declaration.kind != Kind::kRepeated && declaration.kind != Kind::kPositionals) {
    slot.values.clear();
  }
  slot.values.push_back(value);
  slot.given = true;
}

int runGuarded(const std::string& program, std::ostream& errors, const std::function<int()>& body) {
  try {
    return body();
  } catch (const std::invalid_argument& error) {
    errors << program << ": " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    errors << program << ": " << error.what() << '\n';
    return 1;
  }
}

}  // namespace slipnav
