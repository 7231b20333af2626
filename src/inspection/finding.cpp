#include "inspection/finding.h"

#include <algorithm>
#include <cmath>
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
  return static_cast<std::size_t>(std::count_if(
      findings.begin(), findings.end(), [severity](const Finding& finding) { return finding.severity == severity; }));
}

}  // namespace

void sortWorstFirst(Findings& findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
}

void mergeAlike(Findings& findings) {
  Findings merged;
  for (const Finding& finding : findings) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&finding](const Finding& other) {
      return other.severity == finding.severity && other.text == finding.text && other.remedy == finding.remedy;
    });
    if (same == merged.end()) {
      merged.push_back(finding);
    } else if (same->subject != finding.subject) {
      same->subject += ", " + finding.subject;
    }
  }
  findings = std::move(merged);
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
        << std::setw(9) << ""
        << "-> " << finding.remedy << "\n";
  }
  const std::size_t unusable = countOf(findings, Severity::kUnusable);
  const std::size_t doubtful = countOf(findings, Severity::kDoubtful);
  out << (unusable > 0   ? "not usable as it is: "
          : doubtful > 0 ? "usable with doubt: "
                         : "usable: ")
      << counted(unusable, "reason") << " against it, " << counted(doubtful, "doubt") << "\n";
  return out.str();
}

std::string decimal(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const double least = 0.5 * std::pow(10.0, -decimals);
  out << std::fixed << std::setprecision(decimals) << (std::abs(value) < least ? 0.0 : value);  // no "-0.0"
  return out.str();
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace slipnav
