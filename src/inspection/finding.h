#pragma once
/// What there is to say about a recording, each with what to do about it.

#include <string>
#include <vector>

namespace slipnav {

/// How bad it is. kUnusable: an estimate from these data is worthless. kDoubtful: it is worse than it could be, or may
/// be. kRemark: good to know; nothing has to be done.
enum class Severity { kUnusable, kDoubtful, kRemark };

/// One line and its remedy.
struct Finding {
  Severity severity = Severity::kRemark;
  std::string subject;  ///< topic, joint or file
  std::string text;     ///< what was seen, with figures and units
  std::string remedy;   ///< what to do
};

using Findings = std::vector<Finding>;

/// The worst first; among equals the order stays.
void sortWorstFirst(Findings& findings);

/// What is said of several subjects alike becomes one finding.
void mergeAlike(Findings& findings);

/// Exit status: 0 usable, 1 doubtful, 2 not usable.
int statusOf(const Findings& findings);

/// Two lines for each, and one with the verdict.
std::string toText(const Findings& findings);

/// A number with so many decimals, whatever the locale.
std::string decimal(double value, int decimals);

/// "1 message", "3 messages".
std::string counted(std::size_t count, const std::string& what);

}  // namespace slipnav
