"""Which folder may include which, and what the includes are."""

import collections
import hashlib
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# Within the core each room includes only rooms that stand before it.
CORE = ["base", "earth", "parameters", "ordering", "sensors", "ins", "ekf", "ekf/models", "ekf/adaptation",
        "ekf/engine", "slip", "navigation", "forecast/gp", "forecast", "stopping"]
ROS = ["runtime", "messages", "bag", "replay", "simulation", "rviz"]

# What each layer may include beside itself.
BELOW = {"core": [], "simulation": ["core"], "io": ["core"]}
BELOW["config"] = ["core", "simulation", "io"]
BELOW["evaluation"] = BELOW["config"] + ["config"]
for layer in ("calibration", "overlay"):
    BELOW[layer] = BELOW["evaluation"] + ["evaluation"]
for layer in ("inspection", "tuning",):
    BELOW[layer] = BELOW["calibration"] + ["calibration"]
BELOW["ros"] = BELOW["evaluation"] + ["evaluation", "calibration", "overlay", "inspection", "tuning"]
for layer in ("nodelets", "tools", "panel"):
    BELOW[layer] = BELOW["ros"] + ["ros"]

# The world knows nothing of the estimator.
SEEN_BY_SIMULATION = ["core/base", "core/earth", "core/parameters"]

Include = collections.namedtuple("Include", "path line included")


def room_of(path):
    """src/core/ekf/x.cpp and include/slipnav/core/ekf/x.h: core/ekf"""
    return re.sub(r"^(src|include/slipnav)/", "", os.path.dirname(path))


def source_files():
    for top in ("include", "src"):
        for folder, _, names in os.walk(os.path.join(ROOT, top)):
            for name in sorted(names):
                if name.endswith((".h", ".cpp")):
                    yield os.path.relpath(os.path.join(folder, name), ROOT)


def includes():
    """Every include of one of the project's own files by another."""
    for path in source_files():
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                match = re.match(r'#include "([^"]+)"', line)
                if not match:
                    continue
                for top in ("include", "src"):
                    included = os.path.join(top, match.group(1))
                    if os.path.exists(os.path.join(ROOT, included)):
                        yield Include(path, number, included)


def may_include(room, other):
    """Whether a file of one folder may include one of another."""
    layer, _, place = room.partition("/")
    other_layer, _, other_place = other.partition("/")
    if layer == other_layer:
        order = {"core": CORE, "ros": ROS}.get(layer)
        return room == other or not order or order.index(other_place) < order.index(place)
    if layer == "simulation":
        return other in SEEN_BY_SIMULATION
    return other_layer in BELOW[layer]


def arrows():
    """{(folder, folder that it includes): how many includes}"""
    return collections.Counter((room_of(include.path), room_of(include.included)) for include in includes()
                               if room_of(include.path) != room_of(include.included))


def fingerprint():
    """Tells one set of arrows from another; the picture carries it."""
    return hashlib.sha256(repr(sorted(arrows())).encode()).hexdigest()
