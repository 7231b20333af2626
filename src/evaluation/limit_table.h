#pragma once
/// Measured figures next to their limits.

#include <string>

namespace slipnav {

/// One line per figure, as text.
class LimitTable {
 public:
  void add(const std::string& figure, double measured);
  void addAtMost(const std::string& figure, double measured, double limit);
  void addAtLeast(const std::string& figure, double measured, double limit);

  /// A figure beyond its limit, or missing, has the word MISSED.
  const std::string& text() const { return text_; }

 private:
  void row(const std::string& figure, double measured, const std::string& limit);

  std::string text_;
};

}  // namespace slipnav
