#include "reference_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>

namespace slipnav::test {
namespace {

/// Relative. Compilers differ in the last digits.
constexpr double kTolerance = 1e-6;

std::optional<double> numberOf(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end == word.c_str() + word.size() && !word.empty() ? std::optional<double>(value) : std::nullopt;
}

bool sameWord(const std::string& found, const std::string& expected) {
  const std::optional<double> a = numberOf(found);
  const std::optional<double> b = numberOf(expected);
  if (found == expected || !a || !b) {
    return found == expected;
  }
  return std::abs(*a - *b) <= kTolerance * (std::abs(*b) + kTolerance);
}

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

bool sameLine(const std::string& found, const std::string& expected) {
  const std::vector<std::string> a = wordsOf(found);
  const std::vector<std::string> b = wordsOf(expected);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), sameWord);
}

}  // namespace

void ReferenceTrace::compare() const {
  const std::string path = std::string(SLIPNAV_SOURCE_DIR "/test/golden/traces/") + name_ + ".txt";
  if (std::getenv("SLIPNAV_WRITE_REFERENCE") != nullptr) {
    std::ofstream file(path);
    for (const std::string& line : lines_) {
      file << line << '\n';
    }
  }
  std::ifstream file(path);
  std::size_t number = 0;
  for (std::string expected; std::getline(file, expected); ++number) {
    ASSERT_LT(number, lines_.size()) << path << " has more";
    ASSERT_TRUE(sameLine(lines_[number], expected))
        << path << ':' << number + 1 << "\n  was: " << expected << "\n  is:  " << lines_[number];
  }
  EXPECT_GT(number, 0U) << path;
  EXPECT_EQ(number, lines_.size()) << path << " has fewer";
}

double Dice::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) {
    sum += static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
  }
  return sum;
}

}  // namespace slipnav::test
