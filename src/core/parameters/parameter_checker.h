#pragma once
/// Checks that every field of a parameter struct has a value its visit() allows.

#include <string>
#include <vector>

#include "core/parameters/parameter_path.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Throws std::invalid_argument that names the field (with its full dotted key) of the first value that is not finite,
/// out of range or not among its choices.
class ParameterChecker : public ParameterVisitor {
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

 protected:
  bool enterGroup(const char* name, const char* meaning) override;
  void leaveGroup() override;
  std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) override;
  void enterItem(std::size_t index) override;
  void leaveItem() override;
  void leaveList() override;

 private:
  ParameterPath path_;
};

/// "0 to 1", "at least 0", "at most 1", or "" for an unbounded range.
std::string describeRange(const Range& range);

/// What is wrong with a value ("must be 0 to 1, not 2"), otherwise "". Shared by the checker and the readers.
std::string complaintAbout(double value, const Range& range);
std::string complaintAbout(const std::string& value, const std::vector<std::string>& options);

/// Checks all fields of a struct with visit(). Throws std::invalid_argument, see ParameterChecker.
template <class Parameters>
void checkParameters(const Parameters& parameters) {
  Parameters copy = parameters;  // visit() takes references that readers write to
  ParameterChecker checker;
  copy.visit(checker);
}

}  // namespace slipnav
