#pragma once
/// The single values of a parameter struct as a list, with everything its visit() says about them.

#include <string>
#include <variant>
#include <vector>

#include "core/parameters/parameter_path.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Possible values of a field with a single value.
using ParameterValue = std::variant<bool, int, double, std::string>;

/// One field.
struct ParameterInfo {
  std::string key;  ///< full dotted key
  ParameterValue value;
  Range range;                       ///< of a number
  std::vector<std::string> options;  ///< of a choice
  std::string meaning;
};

/// The visitor behind listParameters(). Lists of numbers, of words and of blocks are skipped.
class ParameterLister : public ParameterVisitor {
 public:
  void number(const char* name, double& value, Range range, const char* meaning) override;
  void integer(const char* name, int& value, Range range, const char* meaning) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void choice(const char* name, std::string& value, std::initializer_list<const char*> options,
              const char* meaning) override;
  void numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) override;
  void words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
             const char* meaning) override;

  /// The fields so far.
  const std::vector<ParameterInfo>& parameters() const { return parameters_; }

 protected:
  bool enterGroup(const char* name, const char* meaning) override;
  void leaveGroup() override;
  std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) override;
  void enterItem(std::size_t index) override;
  void leaveItem() override;
  void leaveList() override;

 private:
  void add(const char* name, ParameterValue value, Range range, std::vector<std::string> options, const char* meaning);

  ParameterPath path_;
  int lists_ = 0;  ///< nesting depth in lists
  std::vector<ParameterInfo> parameters_;
};

/// All fields with a single value of a struct with visit(), in the order of its visit().
template <class Parameters>
std::vector<ParameterInfo> listParameters(Parameters parameters) {
  ParameterLister lister;
  parameters.visit(lister);
  return lister.parameters();
}

/// As written in YAML.
std::string toText(const ParameterValue& value);

}  // namespace slipnav
