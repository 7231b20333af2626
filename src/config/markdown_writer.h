#pragma once
/// Writes any parameter struct as Markdown tables, one per block: the configuration reference.

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/parameters/parameter_path.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// The visitor behind toMarkdown().
class MarkdownWriter : public ParameterVisitor {
 public:
  /// @param tunable keys marked as changeable while the nodelets run
  explicit MarkdownWriter(std::set<std::string> tunable = {});

  void number(const char* name, double& value, Range range, const char* meaning) override;
  void integer(const char* name, int& value, Range range, const char* meaning) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void choice(const char* name, std::string& value, std::initializer_list<const char*> options,
              const char* meaning) override;
  void numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) override;
  void words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
             const char* meaning) override;

  /// The tables so far, those of outer blocks before those of inner ones.
  std::string markdown() const;

 protected:
  bool enterGroup(const char* name, const char* meaning) override;
  void leaveGroup() override;
  std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) override;
  void enterItem(std::size_t index) override;
  void leaveItem() override;
  void leaveList() override;

 private:
  struct Section {
    std::string key;
    std::string meaning;
    std::string rows;
  };

  void openSection(const std::string& name, const std::string& meaning);
  void closeSection();
  void row(const std::string& name, const std::string& value, const std::string& allowed, const std::string& meaning);

  std::set<std::string> tunable_;
  ParameterPath path_;
  std::vector<Section> sections_;
  std::vector<std::size_t> open_;  ///< indices of the enclosing sections
  bool rows_wanted_ = true;        ///< off after the first item of a list: the others have the same keys
};

/// All fields of a struct with visit(): key, default, allowed values, meaning; those in `tunable` with a mark.
template <class Parameters>
std::string toMarkdown(Parameters parameters, std::set<std::string> tunable = {}) {
  MarkdownWriter writer(std::move(tunable));
  parameters.visit(writer);
  return writer.markdown();
}

}  // namespace slipnav
