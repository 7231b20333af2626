#pragma once
/// Declares and parses the command line of an executable. Does not print or exit by itself.

#include <functional>
#include <iosfwd>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// A wrong command line; the message is one line that names the argument. Executables end with status 2.
class UsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A parsed command line, with defaults filled in. Asking for a name that was not declared throws std::logic_error.
class Arguments {
 public:
  /// The user asked for --help; nothing else has been checked.
  bool helpRequested() const { return help_requested_; }
  /// Whether a flag or an option was given.
  bool given(const std::string& name) const;
  /// The value of an option or positional argument: the last one given, or its default.
  const std::string& text(const std::string& name) const;
  /// The same as a number. Throws UsageError if it is not one or out of range.
  double number(const std::string& name, Range range = {}) const;
  int integer(const std::string& name, Range range = {}) const;
  /// Every value of a repeated option, in order.
  const std::vector<std::string>& all(const std::string& name) const;

 private:
  friend class CommandLine;

  struct Slot {
    std::string shown;                ///< name in error messages, for example "--seed"
    std::vector<std::string> values;  ///< the default until something is given
    bool given = false;
  };

  const Slot& slot(const std::string& name) const;

  bool help_requested_ = false;
  std::map<std::string, Slot> slots_;
};

/// Declared options and positional arguments of one executable. Option names are without the leading dashes.
class CommandLine {
 public:
  CommandLine(std::string program, std::string summary);

  /// A switch without a value.
  CommandLine& flag(const std::string& name, const std::string& meaning);
  /// An option with a value. `value_name` is its placeholder in the help text.
  CommandLine& option(const std::string& name, const std::string& value_name, const std::string& meaning,
                      const std::string& default_value = "");
  /// An option whose value is one of a few words.
  CommandLine& choice(const std::string& name, const std::vector<std::string>& choices, const std::string& meaning,
                      const std::string& default_value);
  /// An option that may be given any number of times.
  CommandLine& repeated(const std::string& name, const std::string& value_name, const std::string& meaning);
  /// A required argument without dashes; the order of the calls is that on the command line.
  CommandLine& positional(const std::string& name, const std::string& meaning);
  /// Like positional(), but takes one or more; must be declared last.
  CommandLine& positionals(const std::string& name, const std::string& meaning);

  /// @param arguments without the program's own name; both `--name value` and `--name=value` are understood, and
  ///     everything after a bare `--` is positional. Throws UsageError that names the first wrong argument.
  Arguments parse(const std::vector<std::string>& arguments) const;
  Arguments parse(int argc, const char* const* argv) const;

  /// The text for --help.
  std::string help() const;

 private:
  enum class Kind { kFlag, kOption, kRepeated, kPositional, kPositionals };
  struct Declaration {
    Kind kind;
    std::string name;
    std::string value_name;
    std::string meaning;
    std::string default_value;
    std::vector<std::string> choices;
  };

  static bool isPositional(const Declaration& item);
  Arguments withDefaults() const;
  const Declaration& findOption(const std::string& shown) const;
  std::vector<const Declaration*> expected() const;
  /// Takes the option at `index` with its value; @return the index of the last argument taken.
  std::size_t takeOption(const std::vector<std::string>& arguments, std::size_t index, Arguments& result) const;
  static void store(const Declaration& declaration, const std::string& value, Arguments& result);

  std::string program_;
  std::string summary_;
  std::vector<Declaration> declarations_;
};

/// Runs the body of an executable. An exception becomes one line on `errors`, "program: what is wrong", and the exit
/// status: 2 for std::invalid_argument (a wrong argument, configuration or input), 1 for anything else.
int runGuarded(const std::string& program, std::ostream& errors, const std::function<int()>& body);

}  // namespace slipnav
