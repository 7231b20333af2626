"""Autonomous stops against periodic ones, as many and as long, on the same ground with the same seeds."""

from typing import NamedTuple, Tuple

import numpy as np

from slipnav_campaign.task import Failure

from . import paper
from .drive import Drive
from .section import Options, Section, Table, number
from .statistics import median

DISTANCE_M = 650.0
NEVER = "none"


class Ground(NamedTuple):
    name: str
    terrain: str
    settings: Tuple[str, ...] = ()


def soft(slip, length_m, spacing_m):
    return (f"simulator.ground.patch_slip={slip:g}", f"simulator.ground.patch_length_m={length_m:g}",
            f"simulator.ground.patch_spacing_m={spacing_m:g}")


PATCHES = soft(0.3, 50, 100)
GROUNDS = (
    Ground("paved", "paved"), Ground("unpaved", "unpaved"), Ground("gravel", "gravel"), Ground("rough", "rough"),
    Ground("patches on paved", "paved", PATCHES), Ground("patches on unpaved", "unpaved", PATCHES),
    Ground("patches on gravel", "gravel", PATCHES),
    Ground("transitions", "paved", soft(0.25, 30, 30) + ("simulator.ground.slip_variation=3",)),
    Ground("slope", "gravel", ("simulator.ground.tilt_deg=15",)),
)


def autonomous_drives(ground, options):
    return [Drive(ground.terrain, DISTANCE_M, seed, paper.AUTONOMOUS, options.clock_threshold_m, ground.settings)
            for seed in range(1, options.seeds + 1)]


def policy_of_clock(outcome):
    """As many stops as there were, as long as they were, after equal times of driving."""
    stops = sum(stretch.ended_by_stop for stretch in outcome.stretches)
    if stops == 0:
        return NEVER
    driving_s = sum(stretch.duration_s for stretch in outcome.stretches)
    hold_s = outcome.metrics["stop_rate_pct"] / 100.0 * outcome.metrics["duration_s"] / stops
    return f"periodic:{driving_s / (stops + 1):.2f}:{hold_s:.2f}"


def clock_drive(drive, outcome):
    return Drive(drive.terrain, drive.distance_m, drive.seed, policy_of_clock(outcome), None, drive.settings,
                 with_stretches=True)


def pairs_of(outcomes, ground, options):
    """(autonomous, periodic) for each seed of which both finished."""
    pairs = []
    for drive in autonomous_drives(ground, options):
        if isinstance(outcomes[drive], Failure):
            continue
        by_clock = outcomes[clock_drive(drive, outcomes[drive])]
        if not isinstance(by_clock, Failure):
            pairs.append((outcomes[drive], by_clock))
    return pairs


def figures(outcomes, threshold_m=Options.clock_threshold_m):
    growths = np.array([stretch.growth_m for outcome in outcomes for stretch in outcome.stretches])
    known = len(growths) > 0
    return {
        "stops": median([sum(stretch.ended_by_stop for stretch in outcome.stretches) for outcome in outcomes]),
        "growth_rms_m": float(np.sqrt(np.mean(growths**2))) if known else None,
        "worst_growth_m": float(growths.max()) if known else None,
        "beyond": int(np.sum(growths > threshold_m)), "stretches": len(growths),
        "enu_error_pct": median([outcome.metrics["enu_error_pct"] for outcome in outcomes]),
    }


def ratio(one, other):
    return None if one is None or not other else one / other


class Clock:
    NAME = "clock"

    @staticmethod
    def drives(options):
        return [drive for ground in GROUNDS for drive in autonomous_drives(ground, options)]

    @staticmethod
    def follow_up(outcomes, options):
        return [clock_drive(drive, outcomes[drive]) for drive in Clock.drives(options)
                if not isinstance(outcomes[drive], Failure)]

    @staticmethod
    def section(outcomes, options):
        rows, data = [], {}
        for ground in GROUNDS:
            pairs = pairs_of(outcomes, ground, options)
            both = [figures([pair[i] for pair in pairs], options.clock_threshold_m) for i in (0, 1)]
            data[ground.name] = dict(zip(("autonomous", "clock"), both), drives=len(pairs))
            for name, found in zip(("autonomous", "clock"), both):
                rows.append([ground.name if name == "autonomous" else "", name, str(len(pairs)),
                             number(found["stops"], 0), number(found["growth_rms_m"], 2),
                             number(found["worst_growth_m"], 2), f"{found['beyond']} of {found['stretches']}",
                             number(found["enu_error_pct"], 2)])
            rows.append(["", "ratio", "", ""]
                        + [number(ratio(both[0][key], both[1][key]), 2) for key in ("growth_rms_m", "worst_growth_m")]
                        + ["", number(ratio(both[0]["enu_error_pct"], both[1]["enu_error_pct"]), 2)])
        heads = ["ground", "stops by", "drives", "stops", "growth rms m", "worst m", "grown beyond ε", "ENU %"]
        notes = [f"ε = {options.clock_threshold_m:g} m. The periodic drive stops as often and as long as the autonomous drive with "
                 "that seed, after equal times of driving. Growth: of the horizontal error in a stretch between two "
                 "stops, its largest; ENU: median over the drives."]
        return Section(f"Against as many periodic stops, {DISTANCE_M:.0f} m", [Table(heads, rows)], notes, data=data)
