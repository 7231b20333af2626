#include "slipnav/inspection/finding.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace slipnav {
namespace {

const char* nameOf(Severity severity) {
  switch (severity) {
    case Severity::kUnusable:
      return "UNUSABLE";
    case Severity::kDoubtful:
      return "DOUBTFUL";
    case Severity::kRemark:
      break;
  }
  return "remark";
}

std::size_t countOf(const Findings& findings, Severity severity) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [severity](const Finding& finding) { return finding.severity == severity; }));
}

}  // namespace

void sortWorstFirst(Findings& findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
}

int statusOf(const Findings& findings) {
  if (countOf(findings, Severity::kUnusable) > 0) {
    return 2;
  }
  return countOf(findings, Severity::kDoubtful) > 0 ? 1 : 0;
}

std::string toText(const Findings& findings) {
  std::ostringstream out;
  for (const Finding& finding : findings) {
    out << std::left << std::setw(9) << nameOf(finding.severity) << finding.subject << ": " << finding.text << "\n"
        << std::setw(9) << "" << "-> " << finding.remedy << "\n";
  }
  const std::size_t unusable = countOf(findings, Severity::kUnusable);
  const std::size_t doubtful = countOf(findings, Severity::kDoubtful);
  out << (unusable > 0 ? "not usable as it is: " : doubtful > 0 ? "usable with doubt: " : "usable: ")
      << counted(unusable, "reason") << " against it, " << counted(doubtful, "doubt") << "\n";
  return out.str();
}

std::string decimal(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(decimals) << value;
  return out.str();
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace slipnav
