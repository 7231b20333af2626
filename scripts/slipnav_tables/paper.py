"""What the paper reports: C. Kilic, N. Ohi, Y. Gu, J. N. Gross, IEEE RA-L 6(3), 2021."""

from dataclasses import dataclass
from typing import Optional

AUTONOMOUS = "autonomous"
PERIODIC = "periodic:12:3"  # of its predecessor (Kilic et al., IROS 2019): 3 s every 12 s


@dataclass(frozen=True)
class AccuracyRow:
    """A row of Table I: autonomous stops on rough ground. Fields after `name` as in metrics.json, but the threshold."""

    name: str
    distance_m: float
    threshold_m: float
    stop_count: int
    duration_s: float
    enu_error_pct: float
    median_error_pct: float
    horizontal_median_m: float
    horizontal_std_m: float
    horizontal_max_m: float
    rms_east_m: float
    rms_north_m: float
    rms_up_m: float


TABLE_1 = (
    AccuracyRow("Test1", 671, 5, 8, 879, 3.07, 1.73, 11.60, 12.01, 34.48, 17.84, 7.26, 7.25),
    AccuracyRow("Test2", 663, 3, 19, 924, 1.78, 1.04, 6.89, 5.68, 18.78, 9.49, 3.08, 6.24),
    AccuracyRow("Test3", 652, 3, 20, 915, 1.14, 1.05, 6.84, 2.88, 11.10, 5.67, 4.44, 1.75),
    AccuracyRow("Test4", 339, 2, 9, 469, 0.91, 0.58, 1.96, 1.27, 5.86, 1.74, 1.83, 1.78),
    AccuracyRow("Test5", 152, 2, 5, 215, 0.94, 0.82, 1.24, 0.80, 2.72, 1.34, 0.47, 0.13),
)


@dataclass(frozen=True)
class ComparisonRow:
    """A row of Table II: periodic and autonomous stops compared."""

    name: str
    terrain: str
    policy: str
    threshold_m: Optional[float]  # where the paper says it: Rough_B is Test5
    distance_m: float
    duration_s: float
    enu_error_pct: float
    stop_rate_pct: float
    stop_count: int


TABLE_2 = (
    ComparisonRow("Rough_A", "rough", PERIODIC, None, 151, 504, 0.85, 25.02, 42),
    ComparisonRow("Unpaved_A", "unpaved", PERIODIC, None, 87, 133, 1.53, 18.08, 8),
    ComparisonRow("Unpaved_B", "unpaved", PERIODIC, None, 128, 181, 1.02, 11.60, 7),
    ComparisonRow("Rough_B", "rough", AUTONOMOUS, 2, 152, 215, 0.94, 7.32, 5),
    ComparisonRow("Unpaved_C", "unpaved", AUTONOMOUS, None, 183, 244, 1.17, 6.15, 5),
    ComparisonRow("Unpaved_D", "unpaved", AUTONOMOUS, None, 161, 210, 1.56, 4.28, 3),
)
HOLD_S = 3.0  # of each stop, by the stop rates of Table II

# The figure of stop intervals: grounds from the longest interval to the shortest, tests on each, and Tukey's p values.
TERRAINS = ("paved", "unpaved", "gravel", "rough")
TESTS_PER_TERRAIN = 20
COLLECTION_S = 15.0  # after which the remaining time to the stop is read
TUKEY_P = {
    ("paved", "unpaved"): "0.0049",
    ("paved", "gravel"): "< 0.0001",
    ("paved", "rough"): "< 0.0001",
    ("unpaved", "gravel"): "< 0.0001",
    ("unpaved", "rough"): "< 0.0001",
    ("gravel", "rough"): "0.5028",
}
