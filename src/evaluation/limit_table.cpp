#include "evaluation/limit_table.h"

#include <iomanip>
#include <sstream>

#include "core/base/text.h"

namespace slipnav {

void LimitTable::row(const std::string& figure, double measured, const std::string& limit) {
  std::ostringstream line;
  line << std::left << std::setw(52) << figure << std::right << std::fixed << std::setprecision(2) << std::setw(9)
       << measured << "  " << limit << '\n';
  text_ += line.str();
}

void LimitTable::add(const std::string& figure, double measured) { row(figure, measured, ""); }

void LimitTable::addAtMost(const std::string& figure, double measured, double limit) {
  row(figure, measured, "at most " + formatNumber(limit) + (measured <= limit ? "" : "  MISSED"));
}

void LimitTable::addAtLeast(const std::string& figure, double measured, double limit) {
  row(figure, measured, "at least " + formatNumber(limit) + (measured >= limit ? "" : "  MISSED"));
}

}  // namespace slipnav
