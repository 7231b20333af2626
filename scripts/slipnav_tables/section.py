"""Parts of the output."""

from dataclasses import dataclass, field
from typing import Dict, List, Optional

from slipnav_campaign.task import Failure

NOT_KNOWN = "-"


@dataclass(frozen=True)
class Options:
    seeds: int
    curve_seeds: int
    interval_tests: int
    interval_threshold_m: float
    clock_threshold_m: float = 3.0


@dataclass
class Table:
    heads: List[str]
    rows: List[List[str]]
    caption: str = ""


@dataclass
class Figure:
    name: str  # of the file, without its end
    title: str
    png: bytes


@dataclass
class Section:
    title: str
    tables: List[Table]
    notes: List[str]
    figures: List[Figure] = field(default_factory=list)
    data: Optional[Dict] = None  # for tables.json


def succeeded(outcomes, drives):
    return [outcomes[drive] for drive in drives if not isinstance(outcomes[drive], Failure)]


def figures_of(outcomes, drives, key):
    """A figure of metrics.json over drives that finished."""
    return [outcome.metrics[key] for outcome in succeeded(outcomes, drives)]


def number(value, decimals):
    return NOT_KNOWN if value is None else f"{value:.{decimals}f}"
