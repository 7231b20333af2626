"""Times between the stops of a recorded drive, actual and forecast."""

import os
from dataclasses import dataclass
from typing import Tuple

from slipnav_tables import paper
from slipnav_tables.drive import driving_stretches, probed_times, read_columns


@dataclass(frozen=True)
class StopTimes:
    real_s: Tuple[float, ...]  # driving from one stop to the next
    forecast_s: Tuple[float, ...]  # forecast time to the stop, some seconds after a stop; infinite: beyond it
    horizon_s: float  # of the forecast


def read_stop_times(directory):
    timeline = read_columns(os.path.join(directory, "timeline.csv"), ("t", "stationary"))
    forecasts = read_columns(os.path.join(directory, "forecasts.csv"), ("t", "horizon_s", "time_to_stop_s"))
    if not (timeline["stationary"] < 0.5).any():
        return StopTimes((), (), 0.0)
    real = [stretch.duration_s for stretch in driving_stretches(timeline, with_growth=False)
            if stretch.after_stop and stretch.ended_by_stop]
    made = [value for value in probed_times(timeline, forecasts, paper.COLLECTION_S) if value is not None]
    return StopTimes(tuple(real), tuple(made), float(forecasts["horizon_s"].max(initial=0.0)))
