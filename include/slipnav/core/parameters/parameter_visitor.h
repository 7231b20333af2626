#pragma once
/// How a parameter struct describes its fields: one list per struct serves YAML, ROS parameters, checks and docs.
///
/// A struct `P` has a member `void visit(ParameterVisitor& v)` that calls one function below per field. Readers write
/// into the reference, writers and checkers read it. Names carry the unit as a suffix; values stay in that unit.

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace slipnav {

/// Closed interval that a value must lie in.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// What a struct calls in its visit(): one function per kind of field.
class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;

  /// One field of each kind: its key in YAML, the value, what is allowed, and a phrase that says what it means.
  virtual void number(const char* name, double& value, Range range, const char* meaning) = 0;
  virtual void integer(const char* name, int& value, Range range, const char* meaning) = 0;
  virtual void flag(const char* name, bool& value, const char* meaning) = 0;
  virtual void text(const char* name, std::string& value, const char* meaning) = 0;
  virtual void choice(const char* name, std::string& value, std::initializer_list<const char*> options,
                      const char* meaning) = 0;
  /// A list of numbers of fixed length (the length of `value` on entry); an empty one may take any length.
  virtual void numbers(const char* name, std::vector<double>& value, Range range, const char* meaning) = 0;
  /// A list of words, each one of `options` (any word if `options` is empty).
  virtual void words(const char* name, std::vector<std::string>& value, std::initializer_list<const char*> options,
                     const char* meaning) = 0;

  /// A nested block; its own visit() is called with this visitor inside the block.
  template <class Parameters>
  void group(const char* name, Parameters& parameters, const char* meaning) {
    if (enterGroup(name, meaning)) {
      parameters.visit(*this);
      leaveGroup();
    }
  }

  /// A list of blocks of one kind. A reader that finds one replaces the whole list; no item keeps an old value.
  template <class Parameters>
  void list(const char* name, std::vector<Parameters>& items, const char* meaning) {
    const std::optional<std::size_t> new_size = enterList(name, items.size(), meaning);
    if (new_size) {
      items = std::vector<Parameters>(*new_size);
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      enterItem(i);
      items[i].visit(*this);
      leaveItem();
    }
    leaveList();
  }

 protected:
  /// @return whether the fields of the block are to be visited; leaveGroup() is called only then
  virtual bool enterGroup(const char* name, const char* meaning) = 0;
  virtual void leaveGroup() = 0;
  /// @return the length of the list that replaces the present one; nothing to keep that
  virtual std::optional<std::size_t> enterList(const char* name, std::size_t current_size, const char* meaning) = 0;
  virtual void enterItem(std::size_t index) = 0;
  virtual void leaveItem() = 0;
  virtual void leaveList() = 0;
};

}  // namespace slipnav
