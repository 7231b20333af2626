"""What the bound says about the growth of the error, beyond the time since the stop."""

import numpy as np

from .clock import DISTANCE_M, GROUNDS
from .drive import Drive
from .section import Section, Table, succeeded

POLICY = "periodic:100:3"  # stops that do not depend on any forecast
SETTINGS = ("forecast.interval_s=5",)
HORIZONS_S = (10.0, 30.0, 60.0)
SIGMAS = 3.0  # of the bound
NEAR_S = 5.0  # times since the stop that count as equal
FEWEST_NEAR = 10  # growths that make a reference


def drives_on(ground, options):
    return [Drive(ground.terrain, DISTANCE_M, seed, POLICY, None, ground.settings + SETTINGS, with_forecasts=True)
            for seed in range(1, options.seeds + 1)]


def log_score(variance_m2, growth_m):
    """Of a horizontal error that is Gaussian and alike in all directions, but for a constant; higher is better."""
    return -np.log(variance_m2) - growth_m**2 / variance_m2


def variance_by_time(since_s, at_s, growth_m):
    """Mean square of growths `at_s` about as long after the stop; NaN where there are too few."""
    near = np.abs(at_s[:, None] - since_s[None, :]) <= NEAR_S
    count = near.sum(axis=0)
    mean = (near * (growth_m**2)[:, None]).sum(axis=0) / np.maximum(count, 1)
    return np.where(count >= FEWEST_NEAR, mean, np.nan)


def skills(promises):
    """Per drive the mean score of the bound less that of the time since the stop, which the other drives teach.

    @param promises of each drive: columns of a Promises at one horizon
    @return (as it is, with one factor on its variance that the other drives teach as well)
    """
    as_is, scaled = [], []
    for i, own in enumerate(promises):
        others = promises[:i] + promises[i + 1:]
        if not others or not len(own.growth_m):
            continue
        since_s, growth_m, bound_m = (np.concatenate([getattr(p, key) for p in others])
                                      for key in ("since_s", "growth_m", "bound_m"))
        reference = log_score(variance_by_time(own.since_s, since_s, growth_m), own.growth_m)
        variance_m2 = (own.bound_m / SIGMAS)**2
        factor = np.mean((SIGMAS * growth_m / bound_m)**2)
        for found, variance in ((as_is, variance_m2), (scaled, factor * variance_m2)):
            gain = log_score(variance, own.growth_m) - reference
            if np.isfinite(gain).any():
                found.append(float(np.nanmean(gain)))
    return as_is, scaled


def mean_and_error(values):
    """Mean and its standard error; None without two values."""
    if len(values) < 2:
        return None
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))


def cell(found):
    return "-" if found is None else f"{found[0]:+.2f} ± {found[1]:.2f}"


class Skill:
    NAME = "skill"

    @staticmethod
    def drives(options):
        return [drive for ground in GROUNDS for drive in drives_on(ground, options)]

    @staticmethod
    def section(outcomes, options):
        rows, data = [], {}
        for ground in GROUNDS:
            finished = succeeded(outcomes, drives_on(ground, options))
            row, data[ground.name] = [ground.name, str(len(finished))], {}
            for horizon_s in HORIZONS_S:
                found = [mean_and_error(values) for values in
                         skills([outcome.promises.at(horizon_s) for outcome in finished])]
                row += [cell(value) for value in found]
                data[ground.name][f"{horizon_s:g}"] = dict(zip(("as_is", "scaled"), found))
            rows.append(row)
        heads = ["ground", "drives"] + [f"{horizon_s:g} s{kind}" for horizon_s in HORIZONS_S
                                        for kind in ("", ", scaled")]
        notes = [f"Stops by {POLICY}. Mean log score (nats) of the growth since the stop that came, under the bound, "
                 "less that under the time since the stop, whose mean square growth the other seeds of the same ground "
                 "teach; with its standard error over the drives. `scaled`: the bound with one factor per ground that "
                 "the other seeds teach as well."]
        return Section(f"Skill of the bound, {DISTANCE_M:.0f} m", [Table(heads, rows)], notes, data=data)
