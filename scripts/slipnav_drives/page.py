"""index.html: all recordings on one self-contained page, with links to their reports."""

import html
import os
import urllib.parse

from slipnav_campaign.task import Failure

from .table import FOUND, found_text, is_bad, verdict_of, worst_first

# Heading, key in metrics.json, decimals.
COLUMNS = (("D m", "distance_m", 0), ("stops", "stop_count", 0), ("T s", "duration_s", 0),
           ("ENU %", "enu_error_pct", 2), ("median %", "median_error_pct", 2), ("horiz. max m", "horizontal_max_m", 2),
           ("final %", "final_pct", 2),
           ("wheels + gyro %", "wheel_only_error_pct", 2), ("NEES", "position_nees_mean", 2),
           ("3σ %", "coverage_3sigma_pct", 1))

STYLE = """
:root { color-scheme: light dark; --text: #222; --page: #fff; --line: #ccc; --dim: #555; --bad: #a33b00;
        --link: #0060a0 }
@media (prefers-color-scheme: dark) {
  :root { --text: #ddd; --page: #181a1b; --line: #444; --dim: #aaa; --bad: #ff9a66; --link: #7cc4ff }
}
body { font-family: sans-serif; color: var(--text); background: var(--page); margin: 2rem auto; max-width: 90rem;
       padding: 0 1rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0 }
th, td { border-bottom: 1px solid var(--line); padding: 0.3rem 0.6rem; text-align: right; font-size: 0.85rem;
         vertical-align: top }
th { font-weight: normal; color: var(--dim); vertical-align: bottom }
td.text, th.text { text-align: left } td.bad { color: var(--bad) } a { color: var(--link) }
.wide { overflow-x: auto } caption { text-align: left; padding-bottom: 0.5rem }
figure { margin: 1.5rem 0 } figcaption { font-weight: bold; margin-bottom: 0.3rem }
img { max-width: 100%; background: #fff }
"""


def linked(recording, directory):
    """Its name, as a link to its results."""
    name = html.escape(recording.name)
    for file in ("report.html", "metrics.json"):
        if os.path.exists(os.path.join(directory, recording.name, file)):
            return f'<a href="{urllib.parse.quote(recording.name)}/{file}">{name}</a>'
    return name


def number_cell(metrics, key, decimals):
    value = metrics.get(key)
    return f"<td>{'-' if value is None else f'{value:.{decimals}f}'}</td>"


def row(recording, outcome, directory, group):
    metrics = {} if isinstance(outcome, Failure) else outcome.metrics
    verdict = html.escape(verdict_of(outcome))
    bad = " bad" if is_bad(outcome) else ""
    return (f"<tr><td class=text>{linked(recording, directory)}</td><td class=text>{html.escape(group)}</td>"
            f'<td class="text{bad}">{verdict}</td>'
            + "".join(number_cell(metrics, key, decimals) for _, key, decimals in COLUMNS)
            + "".join(f"<td class=text>{html.escape(found_text(outcome, kind)) or '-'}</td>" for kind in FOUND)
            + "</tr>")


def index_html(outcomes, directory, group_of, sections_html):
    heads = "".join(f"<th class=text>{head}</th>" for head in ("recording", "group", "verdict"))
    heads += "".join(f"<th>{html.escape(head)}</th>" for head, _, _ in COLUMNS)
    heads += "<th class=text>problems (times)</th><th class=text>alarms (times)</th>"
    rows = "".join(row(recording, outcomes[recording], directory, group_of.get(recording, ""))
                   for recording in worst_first(outcomes))
    failed = sum(isinstance(outcome, Failure) for outcome in outcomes.values())
    count = f"{len(outcomes)} recordings, {failed} failed. Worst first."
    return (f"<!DOCTYPE html><html lang=en><head><meta charset=utf-8><title>slipnav: recordings</title>"
            f"<meta name=viewport content='width=device-width'><style>{STYLE}</style></head><body><h1>Recordings</h1>"
            f"<p>{count} All figures of each: <a href=rows.csv>rows.csv</a>.</p>"
            f"<div class=wide><table><tr>{heads}</tr>{rows}</table></div>{sections_html}</body></html>\n")
