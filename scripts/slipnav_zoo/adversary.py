"""Random configurations within their ranges in random worlds: what must never happen, whatever a user configures."""

import math
import random
import re

from slipnav_campaign.task import Failure

from .simulation import NO_STOPS, STOPS, Drive
from .table import Limits, markdown, number

HEADS = ["drive", "ENU %", "m/s", "wheels m/s", "beyond 3σ s", "alarms"]

BLOCKS = ("imu.noise", "wheel", "vehicle", "nonholonomic", "zero_motion", "stationary")
LARGEST_FACTOR = 4.0  # on a parameter, either way
CHANGED = 6  # parameters of one drive
DRAW_SEED = 500
LARGEST_SPEED_RATIO = 3.0
LONGEST_SILENT_S = 30.0


def parameters(configuration):
    """{name: (value, least, largest)} of the positive numbers in the blocks, from the text of `configuration`."""
    found, path, comment = {}, [], ""
    for line in configuration.splitlines():
        text = line.strip()
        if text.startswith("#"):
            comment += " " + text[1:]
            continue
        match = re.match(r"^( *)(\w+):(?: (.*))?$", line)
        if match is None:
            comment = ""
            continue
        path = path[:len(match.group(1)) // 2] + [match.group(2)]
        limits = re.findall(r"\(([-+\d.e]+) to ([-+\d.e]+|infinity)\)", comment)
        comment = ""
        name = ".".join(path)
        if match.group(3) and limits and name.startswith(tuple(block + "." for block in BLOCKS)):
            try:
                value = float(match.group(3))
            except ValueError:
                continue
            if value > 0.0:
                found[name] = (value, float(limits[-1][0]), float(limits[-1][1].replace("infinity", "inf")))
    return found


def drives(count, worlds, grades, known):
    stream = random.Random(DRAW_SEED)
    listed = []
    for seed in range(1, count + 1):
        settings = []
        for name in sorted(stream.sample(sorted(known), min(CHANGED, len(known)))):
            value, least, largest = known[name]
            changed = value * math.exp(stream.uniform(-1.0, 1.0) * math.log(LARGEST_FACTOR))
            settings.append(f"{name}={min(max(changed, least), largest):.6g}")
        listed.append(Drive(stream.choice(worlds), stream.choice(grades), stream.choice((NO_STOPS, STOPS)), seed,
                            tuple(settings)))
    return listed


def report(outcomes):
    """Rows of the drives that break something, and the limits."""
    limits, rows = Limits(), []
    for drive, outcome in outcomes.items():
        who = f"{drive} ({', '.join(drive.settings)})"
        before = len(limits.broken)
        if isinstance(outcome, Failure):
            limits.fail(who, str(outcome))
            continue
        simulation = outcome.simulation
        speed, wheels = simulation["largest_speed_mps"], simulation["largest_wheel_speed_mps"]
        limits.at_most(who, "speed of the estimate", speed, LARGEST_SPEED_RATIO * wheels)
        if not outcome.alarms:
            limits.at_most(who, "silent time beyond 3σ", simulation["longest_beyond_3sigma_s"], LONGEST_SILENT_S)
        if len(limits.broken) > before:
            rows.append([str(drive), number(outcome.metrics["enu_error_pct"]), number(speed), number(wheels),
                         number(simulation["longest_beyond_3sigma_s"], 0), "; ".join(outcome.alarms) or "-"])
    rows.append([f"{len(outcomes)} drives, {len(rows)} broken", "", "", "", "", ""])
    return markdown(HEADS, rows), limits
