#pragma once
/// The figures that the paper reports (Kilic et al., IEEE RA-L 6(3), 2021), to compare with.

#include <array>

namespace slipnav {

/// A row of Table I: autonomous stopping on rough terrain.
struct PaperAccuracyRow {
  const char* name;
  double distance_m;
  double threshold_m;
  int stop_count;
  double duration_s;
  double enu_error_pct;
  double median_error_pct;
  double horizontal_median_m;
  double horizontal_std_m;
  double horizontal_max_m;
  double rms_east_m;
  double rms_north_m;
  double rms_up_m;
};

inline constexpr std::array<PaperAccuracyRow, 5> kPaperAccuracy = {{
    {"Test1", 671, 5, 8, 879, 3.07, 1.73, 11.60, 12.01, 34.48, 17.84, 7.26, 7.25},
    {"Test2", 663, 3, 19, 924, 1.78, 1.04, 6.89, 5.68, 18.78, 9.49, 3.08, 6.24},
    {"Test3", 652, 3, 20, 915, 1.14, 1.05, 6.84, 2.88, 11.10, 5.67, 4.44, 1.75},
    {"Test4", 339, 2, 9, 469, 0.91, 0.58, 1.96, 1.27, 5.86, 1.74, 1.83, 1.78},
    {"Test5", 152, 2, 5, 215, 0.94, 0.82, 1.24, 0.80, 2.72, 1.34, 0.47, 0.13},
}};

/// A row of Table II: periodic and autonomous stopping compared.
struct PaperComparisonRow {
  const char* name;
  bool autonomous;
  double distance_m;
  double duration_s;
  double enu_error_pct;
  double stop_rate_pct;
  int stop_count;
};

inline constexpr std::array<PaperComparisonRow, 6> kPaperComparison = {{
    {"Rough_A", false, 151, 504, 0.85, 25.02, 42},
    {"Unpaved_A", false, 87, 133, 1.53, 18.08, 8},
    {"Unpaved_B", false, 128, 181, 1.02, 11.60, 7},
    {"Rough_B", true, 152, 215, 0.94, 7.32, 5},
    {"Unpaved_C", true, 183, 244, 1.17, 6.15, 5},
    {"Unpaved_D", true, 161, 210, 1.56, 4.28, 3},
}};

}  // namespace slipnav
