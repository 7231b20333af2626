"""Every world with and without stops, several seeds each: errors next to wheels and gyro, and honesty."""

import statistics

from slipnav_campaign.task import Failure

from .simulation import NO_STOPS, STOPS, Drive, groups, mean, values
from .table import Limits, markdown, number

HEADS = ["world", "grade", "stops every", "ENU %", "worst", "final %", "w+g %", "beyond", "attitude", "velocity",
         "position", "3σ %", "stops", "used", "m/s", "wheels m/s", "alarms"]

LARGEST_RATIO = 1.2  # final error over that of wheels and gyro
SPARE_PCT = 0.1
ANEES = (0.4, 1.6)
LEAST_COVERAGE_PCT = 98.0
LARGEST_SPEED_RATIO = 3.0
LARGEST_STUCK_ERROR_M = 3.0
STUCK = "stuck_"

# Worlds that also meet lesser sensors; every world meets the best one.
BEST_GRADE = "tactical"
ALSO_WITH = {"mems": ("paved", "unpaved", "rough", "sand", "slope_firm", "stones_stiff", "stones_soft", "shaken_gravel",
                      "engine", "host_jitter", "walking", "fast"),
             "phone": ("paved", "unpaved", "motor_lines")}


def drives(worlds, grades, seeds, policies=(NO_STOPS, STOPS)):
    listed = []
    for world in worlds:
        for grade in grades:
            if grade == BEST_GRADE or world in ALSO_WITH.get(grade, ()):
                listed += [Drive(world, grade, policy, seed)
                           for policy in policies for seed in range(1, seeds + 1)]
    return listed


def is_beyond(figures):
    """Worse than wheels and gyro by more than allowed."""
    alone = figures.metrics["wheel_only_error_pct"]
    return figures.final_pct is None or alone is None or figures.final_pct > LARGEST_RATIO * alone + SPARE_PCT


def row(group, outcomes):
    world, grade, policy, _ = group
    figures = [outcome for _, outcome in outcomes if not isinstance(outcome, Failure)]
    cells = [world, grade, "-" if policy == NO_STOPS else policy.split(":")[1] + " s"]
    if not figures:
        return cells + ["failed"] + ["-"] * (len(HEADS) - len(cells) - 1)
    enu = values(figures, "enu_error_pct")
    alarms = sorted({alarm for one in figures for alarm in one.alarms})
    return cells + [
        number(statistics.median(enu), 3), number(max(enu), 3),
        number(statistics.median(one.final_pct for one in figures), 3),
        number(statistics.median(values(figures, "wheel_only_error_pct")), 3),
        str(sum(is_beyond(one) for one in figures)),
        number(mean(values(figures, "nees_end_attitude"))), number(mean(values(figures, "nees_end_velocity"))),
        number(mean(values(figures, "nees_end_position"))), number(mean(values(figures, "coverage_3sigma_pct")), 1),
        str(sum(values(figures, "stops_seen"))), str(sum(values(figures, "stops_used"))),
        number(max(values(figures, "largest_speed_mps"))), number(max(values(figures, "largest_wheel_speed_mps"))),
        "; ".join(alarms) or "-"]


def check(group, outcomes, limits):
    world, grade, policy, _ = group
    who = f"{world}, {grade}" + ("" if policy == NO_STOPS else ", stops")
    figures = []
    for drive, outcome in outcomes:
        if isinstance(outcome, Failure):
            limits.fail(str(drive), str(outcome))
        else:
            figures.append(outcome)
    if not figures:
        return
    limits.at_most(who, "drives worse than wheels and gyro", sum(map(is_beyond, figures)), 0)
    for key in ("attitude", "velocity", "position"):
        anees = mean(values(figures, "nees_end_" + key))
        limits.at_least(who, f"ANEES of {key}", anees, ANEES[0])
        limits.at_most(who, f"ANEES of {key}", anees, ANEES[1])
    limits.at_least(who, "coverage of 3σ %", mean(values(figures, "coverage_3sigma_pct")), LEAST_COVERAGE_PCT)
    limits.at_least(who, "used stops", sum(values(figures, "stops_used")), sum(values(figures, "stops_seen")))
    for speed, wheels in zip(values(figures, "largest_speed_mps"), values(figures, "largest_wheel_speed_mps")):
        limits.at_most(who, "speed of the estimate over the wheels' largest", speed / wheels, LARGEST_SPEED_RATIO)
    if world.startswith(STUCK):
        limits.at_most(who, "largest error m", max(values(figures, "largest_error_m")), LARGEST_STUCK_ERROR_M)


def report(outcomes):
    """Text, and the limits with those that are broken."""
    limits = Limits()
    rows = []
    for group, members in groups(outcomes).items():
        rows.append(row(group, members))
        check(group, members, limits)
    return markdown(HEADS, rows), limits
