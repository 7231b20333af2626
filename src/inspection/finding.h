#pragma once
/// Findings about a recording, each with what to do about it.

#include <string>
#include <vector>

namespace slipnav {

/// How bad it is. kUnusable: an estimate from these data is worthless. kDoubtful: it is, or may be, worse than it
/// could be. kRemark: good to know; nothing has to be done.
enum class Severity { kUnusable, kDoubtful, kRemark };

/// One line and its remedy.
struct Finding {
  Severity severity = Severity::kRemark;
  std::string subject;  ///< topic, joint or file
  std::string text;     ///< the observation, with figures and units
  std::string remedy;   ///< what to do
};

using Findings = std::vector<Finding>;

/// Worst first; the order of equals is kept.
void sortWorstFirst(Findings& findings);

/// Merges the same finding about several subjects into one.
void mergeAlike(Findings& findings);

/// Exit status: 0 usable, 1 doubtful, 2 not usable.
int statusOf(const Findings& findings);

/// Two lines for each, and one with the verdict.
std::string toText(const Findings& findings);

/// A number with this many decimals, whatever the locale.
std::string decimal(double value, int decimals);

/// "1 message", "3 messages".
std::string counted(std::size_t count, const std::string& what);

}  // namespace slipnav
