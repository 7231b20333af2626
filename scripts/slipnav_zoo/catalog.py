"""The third-party recordings: their configurations, and the results of a textbook filter.

A configuration contains what a user knows before the first drive: geometry, mounting, topics, the sensor's data sheet.
"""

from dataclasses import dataclass
from typing import Optional, Tuple

# Errors in % of the distance. Textbook: fifteen states, zero updates, constraints at 0.05 m/s, the better of two wheel
# noises; its ENU error. Wheels and gyro: final horizontal error of dead reckoning with the bias of a first rest.


@dataclass(frozen=True)
class ForeignDrive:
    bag: str
    configurations: Tuple[str, ...]  # files beside the bag, or in config/
    wheels_and_gyro_pct: Optional[float] = None
    textbook_pct: Optional[float] = None
    largest_final_m: Optional[float] = None  # where truth is too coarse for a percentage

    @property
    def simulated(self):
        return self.textbook_pct is not None


SIMULATED = (
    ForeignDrive("foreign_paved", ("foreign.yaml",), 0.19, 0.13),
    ForeignDrive("foreign_unpaved_120", ("foreign.yaml",), 0.17, 0.13),
    ForeignDrive("foreign_gravel_30", ("foreign.yaml",), 1.4, 0.08),
    ForeignDrive("foreign_rough_30", ("foreign.yaml",), 10.0, 0.08),
    ForeignDrive("foreign_rough_120", ("foreign.yaml",), 3.3, 0.33),
    ForeignDrive("foreign_shaken_gravel_60", ("foreign.yaml",), 0.7, 0.34),
    ForeignDrive("foreign_mems_unpaved_60", ("foreign.yaml", "foreign_mems.yaml"), 0.7, 0.75),
    ForeignDrive("foreign_slow_gravel_60", ("foreign.yaml",), 4.1, 0.48),
)

REAL = (
    ForeignDrive("husky_mocap_move6", ("husky_mocap_datasheet.yaml",), 2.1),
    ForeignDrive("husky_mocap_move15", ("husky_mocap_datasheet.yaml",), 0.9),
    ForeignDrive("husky_mocap_origin3", ("husky_mocap_datasheet.yaml",), 0.9),
    ForeignDrive("real_penn_20", ("real_penn_datasheet.yaml",), 0.6),
    ForeignDrive("real_ugv_indoor", ("real_ugv_indoor_datasheet.yaml",), 0.28),
    ForeignDrive("husky_parking_lot", ("husky_parking_lot.yaml",), largest_final_m=6.0),
)

ALL = SIMULATED + REAL
