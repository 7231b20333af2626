"""What is computed over seeds: medians, and whether groups differ."""

import itertools

import numpy as np
import scipy.special
import scipy.stats

LEAST_P = 1e-4  # smaller ones are not told apart


def median(values):
    """None if there are none."""
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else None


def worst(values):
    known = [value for value in values if value is not None]
    return float(max(known)) if known else None


def anova_p(groups):
    """Of one-way analysis of variance; None where no group varies or one has fewer than two values."""
    if any(len(group) < 2 for group in groups) or mean_square_within(groups) == 0.0:
        return None
    return float(scipy.stats.f_oneway(*groups).pvalue)


def mean_square_within(groups):
    squares = sum(np.sum((np.asarray(group) - np.mean(group)) ** 2) for group in groups)
    return squares / (sum(len(group) for group in groups) - len(groups))


def tukey_p(named_groups):
    """P value of each pair of names by Tukey's honest significance test, in Kramer's form for unequal counts.

    None for all of them where anova_p() has none.
    """
    pairs = list(itertools.combinations(named_groups, 2))
    groups = list(named_groups.values())
    if anova_p(groups) is None:
        return dict.fromkeys(pairs)
    freedom = sum(len(group) for group in groups) - len(groups)
    square = mean_square_within(groups)
    values = {}
    for one, other in pairs:
        first, second = named_groups[one], named_groups[other]
        scale = np.sqrt(0.5 * square * (1.0 / len(first) + 1.0 / len(second)))
        values[one, other] = studentized_range_sf(abs(np.mean(first) - np.mean(second)) / scale, len(groups), freedom)
    return values


def studentized_range_sf(q, count, freedom):
    """Probability that the range of `count` standard normal values exceeds q·s, s² being a chi-square over its freedom.

    By the trapezoidal rule, for SciPy has it (scipy.stats.studentized_range) only since 1.7.
    """
    z = np.linspace(-9.0, 9.0, 601)
    width = 12.0 / np.sqrt(2.0 * freedom)
    s = np.linspace(max(0.0, 1.0 - width), 1.0 + width, 601)[1:]
    normal_density = np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi)
    below = scipy.special.ndtr(z)
    inside = below - scipy.special.ndtr(z - q * s[:, None])
    beyond = count * np.trapz(normal_density * (below ** (count - 1) - inside ** (count - 1)), z, axis=1)
    log_density = (0.5 * freedom * np.log(freedom) - scipy.special.gammaln(0.5 * freedom)
                   - (0.5 * freedom - 1.0) * np.log(2.0) + (freedom - 1.0) * np.log(s) - 0.5 * freedom * s**2)
    return float(np.clip(np.trapz(np.exp(log_density) * beyond, s), 0.0, 1.0))


def p_text(value):
    if value is None:
        return "unknown"
    return "< 0.0001" if value < LEAST_P else f"{value:.4f}"
