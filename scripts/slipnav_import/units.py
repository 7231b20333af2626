"""Units of columns: factors that convert numbers to the units of messages."""

import math
import re
from decimal import Decimal

from slipnav_import.failure import Failure

GRAVITY_MPS2 = 9.80665  # of one g, by definition
SECONDS = {"s": Decimal(1), "ms": Decimal("1e-3"), "us": Decimal("1e-6"), "ns": Decimal("1e-9")}
DATE = "date"  # yyyy-mm-dd hh:mm:ss.sss of UTC
COUNTS = "counts"

TIME, ANGLE, LENGTH, SPEED, RATE, FORCE, NUMBER = "time", "angle", "length", "speed", "rate", "acceleration", "number"
DEGREES = "degrees"  # latitude and longitude, which messages have in degrees
WHEEL_RATE, WHEEL_ANGLE, WHEEL_SPEED, WHEEL_WAY = "wheel rate", "wheel angle", "wheel speed", "wheel way"

ANGLES = {"rad": 1.0, "deg": math.pi / 180.0}
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0}
SPEEDS = {"m/s": 1.0, "mm/s": 0.001, "km/h": 1.0 / 3.6}
RATES = {"rad/s": 1.0, "deg/s": math.pi / 180.0, "mrad/s": 0.001}
OF_KIND = {
    ANGLE: ANGLES, DEGREES: {"deg": 1.0, "rad": 180.0 / math.pi},
    LENGTH: LENGTHS, SPEED: SPEEDS, RATE: RATES, NUMBER: {"": 1.0, "1": 1.0},
    FORCE: {"m/s2": 1.0, "g": GRAVITY_MPS2, "mg": 0.001 * GRAVITY_MPS2},
    WHEEL_RATE: {**RATES, "rpm": math.pi / 30.0}, WHEEL_ANGLE: ANGLES, WHEEL_SPEED: SPEEDS, WHEEL_WAY: LENGTHS,
}
USUAL = {TIME: "s", DEGREES: "deg", LENGTH: "m", SPEED: "m/s", RATE: "rad/s", FORCE: "m/s2", NUMBER: ""}

SPELLINGS = [("µ", "u"), ("μ", "u"), ("°", "deg"), ("²", "2"), ("^", ""), ("**", ""), ("degrees", "deg"),
             ("degree", "deg"), ("radians", "rad"), ("meters", "m"), ("metres", "m"), ("seconds", "s"), ("sec", "s"),
             ("dps", "deg/s"), ("mps", "m/s"), ("m/s/s", "m/s2"), ("ticks", COUNTS), ("count", COUNTS),
             (COUNTS + "s", COUNTS), ("rev/min", "rpm"), ("r/min", "rpm")]


def plain(unit):
    """One spelling for each unit: m/s² as m/s2, rad s^-1 as rad/s, °/s as deg/s."""
    text = unit.strip()
    for spelling, usual in SPELLINGS:
        text = text.replace(spelling, usual)
    text = re.sub(r"[ *·]?s-2$", "/s2", text)
    return re.sub(r"[ *·]?s-1$", "/s", text).replace(" ", "")


def listed(kinds):
    """The units of these kinds, for people."""
    names = []
    for kind in kinds:
        units = [*SECONDS, DATE] if kind == TIME else [unit for unit in OF_KIND[kind] if unit]
        names += units + ([COUNTS] if kind == WHEEL_ANGLE else [])
    return ", ".join(dict.fromkeys(names))


def is_known(unit):
    unit = plain(unit)
    return unit in SECONDS or unit in (DATE, COUNTS) or any(unit in units for units in OF_KIND.values())


def kind_and_factor(unit, kinds, where):
    """Kind and factor of a unit; counts have no fixed factor."""
    unit = plain(unit)
    for kind in kinds:
        if kind == TIME and (unit in SECONDS or unit == DATE):
            return kind, SECONDS.get(unit)
        if kind == WHEEL_ANGLE and unit == COUNTS:
            return kind, None
        if kind != TIME and unit in OF_KIND[kind]:
            return kind, OF_KIND[kind][unit]
    raise Failure(f"{where}: unit '{unit}' is not one of {listed(kinds)}")
