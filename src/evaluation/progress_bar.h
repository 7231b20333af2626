#pragma once
/// Progress of a campaign of many runs.

#include <cstddef>
#include <ostream>
#include <string>

namespace slipnav {

/// A bar that moves on a terminal, a line every ten percent elsewhere. Used by one thread at a time.
class ProgressBar {
 public:
  /// @param program begins each line; @param out where it is shown; @param is_terminal whether a line can be
  /// overwritten
  ProgressBar(std::string program, std::ostream& out, bool is_terminal);

  /// @param note additional text, for example "12 runs"
  void show(std::size_t done, std::size_t expected, const std::string& note);
  /// Ends the line.
  void finish();

 private:
  std::string program_;
  std::ostream& out_;
  bool is_terminal_;
  std::size_t shown_pct_ = 0;
};

}  // namespace slipnav
