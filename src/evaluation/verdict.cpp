#include "evaluation/verdict.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace slipnav {
namespace {

/// Position errors of one drive are strongly correlated: its mean NEES scatters by a factor of a few about 1.
constexpr double kLargestNees = 4.0;
constexpr double kSmallestNees = 0.2;
/// Innovations that are this far from their predictions on average say so without any truth.
constexpr double kLargestNis = 2.0;
constexpr double kLeastCoverage_pct = 95.0;
/// Wheels and gyro alone may win by luck on one drive.
constexpr double kWorseFactor = 1.2;
constexpr double kWorseSpare_pct = 0.3;

class Text {
 public:
  Text() {
    out_.imbue(std::locale::classic());
    out_ << std::setprecision(3);
  }
  template <class Value>
  Text& operator<<(const Value& value) {
    out_ << value;
    return *this;
  }
  std::string str() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

/// For a drive without truth that is known to return.
std::string closureOf(const Metrics& metrics) {
  const double bound_m = metrics.closure_3sigma_m.value_or(0.0);
  const bool is_within = *metrics.closure_m <= bound_m;
  Text text;
  text << (is_within ? "consistent" : "over-confident") << ": returns to its start within " << *metrics.closure_m
       << " m";
  if (metrics.closure_pct) {
    text << ", " << *metrics.closure_pct << " % of the distance";
  }
  text << ", 3 sigma there " << bound_m << " m";
  return text.str();
}

/// "NIS of forward speed 40".
std::string nisOf(const Metrics& metrics) {
  std::string kind = metrics.largest_nis_of;
  std::replace(kind.begin(), kind.end(), '_', ' ');
  return (Text() << "NIS of " << kind << " " << *metrics.largest_nis).str();
}

bool contradicts(const Metrics& metrics) { return metrics.largest_nis.value_or(0.0) > kLargestNis; }

std::string withoutTruth(const Metrics& metrics) {
  if (metrics.closure_m) {
    return closureOf(metrics);
  }
  return contradicts(metrics) ? "over-confident: " + nisOf(metrics) + "; no truth to judge the position by"
                              : "not judged: no truth";
}

std::string consistencyOf(const Metrics& metrics) {
  if (!metrics.coverage_3sigma_pct) {
    return withoutTruth(metrics);
  }
  const double nees = metrics.position_nees_mean.value_or(1.0);
  if (nees > kLargestNees || *metrics.coverage_3sigma_pct < kLeastCoverage_pct) {
    return (Text() << "over-confident: 3 sigma covers " << *metrics.coverage_3sigma_pct << " % of the errors, NEES "
                   << nees << (contradicts(metrics) ? ", " + nisOf(metrics) : ""))
        .str();
  }
  return nees < kSmallestNees ? "cautious" : "consistent";
}

}  // namespace

std::string verdictOf(const Metrics& metrics, bool uses_stops) {
  Text verdict;
  verdict << consistencyOf(metrics);
  if (metrics.final_pct && metrics.wheel_only_error_pct &&
      *metrics.final_pct > kWorseFactor * *metrics.wheel_only_error_pct + kWorseSpare_pct) {
    verdict << "; worse than wheels and gyro alone: " << *metrics.final_pct << " % of the distance at the end, not "
            << *metrics.wheel_only_error_pct << " %";
  }
  if (uses_stops && metrics.stops_used < metrics.stops_seen) {
    verdict << "; stops seen but not used: " << metrics.stops_seen - metrics.stops_used << " of " << metrics.stops_seen;
  }
  return verdict.str();
}

}  // namespace slipnav
