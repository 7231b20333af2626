#pragma once
/// Writes any parameter struct as commented YAML: every key with its meaning and allowed values.

#include <string>
#include <vector>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// The visitor behind toYaml().
class YamlWriter : public ParameterVisitor {
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

  /// The document so far.
  const std::string& yaml() const { return yaml_; }

 protected:
  bool enterGroup(const char* name, const char* meaning) override;
  void leaveGroup() override;
  std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) override;
  void enterItem(std::size_t index) override;
  void leaveItem() override;
  void leaveList() override;

 private:
  void comment(const std::string& text);
  void entry(const std::string& name, const std::string& value);

  std::string yaml_;
  std::size_t depth_ = 0;
  bool item_begins_ = false;     ///< the next entry carries the dash of its list item
  bool comments_wanted_ = true;  ///< off after the first item of a list: the others have the same keys
};

/// `text` as a YAML scalar, quoted where a YAML parser would read the bare word as something else.
std::string yamlScalar(const std::string& text);

/// All fields of a struct with visit(), as a YAML document that readParameters() reads back without loss.
template <class Parameters>
std::string toYaml(Parameters parameters) {
  YamlWriter writer;
  parameters.visit(writer);
  return writer.yaml();
}

}  // namespace slipnav
