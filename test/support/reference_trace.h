#pragma once
/// What a part of the core says to a long sequence of events, compared with what it said when that was written down.
///
/// Where it is meant to change, the differences say what the change does, and a run of the unit tests with
/// SLIPNAV_WRITE_REFERENCE=1 writes the new lines to test/golden/traces, as for the reference drives.

#include <cstdint>
#include <locale>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace slipnav::test {

/// Lines of words and numbers.
class ReferenceTrace {
 public:
  /// @param name of the file
  explicit ReferenceTrace(std::string name) : name_(std::move(name)) {}

  /// Adds a line, its parts separated by a space.
  template <class First, class... Others>
  void note(const First& first, const Others&... others) {
    std::ostringstream line;
    line.imbue(std::locale::classic());
    line.precision(kDigits);
    line << first;
    ((line << ' ' << others), ...);
    lines_.push_back(line.str());
  }

  /// Fails at the first line that differs: words by a letter, numbers in the sixth digit.
  void compare() const;

 private:
  static constexpr int kDigits = 10;

  std::string name_;
  std::vector<std::string> lines_;
};

/// Draws whole numbers, the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  /// From 0 to `sides` - 1.
  int roll(int sides) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(sides)); }
  bool oneIn(int sides) { return roll(sides) == 0; }
  template <class Value>
  const Value& from(const std::vector<Value>& values) {
    return values[static_cast<std::size_t>(roll(static_cast<int>(values.size())))];
  }
  /// Normally distributed, nearly: the sum of twelve uniform numbers.
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace slipnav::test
