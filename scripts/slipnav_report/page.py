"""The report as one self-contained HTML file."""

import base64
import html
import io
import os

import matplotlib.pyplot as plt

from . import filter_health, forecasts, interactive, tracks

DPI = 110

# File name, heading, what draws it.
FIGURES = (
    ("track", "Ground track", tracks.ground_track),
    ("errors", "Position error and its ±3σ bounds", tracks.position_errors),
    ("slip", "Slip and its forecast", forecasts.slip_and_forecast),
    ("forecast", "Forecast and actual error, time to stop", forecasts.predicted_and_realized),
    ("velocity", "Velocity", filter_health.velocity),
    ("biases", "IMU biases", filter_health.biases),
    ("consistency", "Consistency: normalized innovations and errors", filter_health.consistency),
)

# Heading of the table, key in metrics.json, decimals: the columns of the paper's Table I.
COLUMNS = (
    ("D [m]", "distance_m", 0), ("stops", "stop_count", 0), ("T [s]", "duration_s", 0),
    ("ENU error [%]", "enu_error_pct", 2), ("median error [%]", "median_error_pct", 2),
    ("horizontal median [m]", "horizontal_median_m", 2), ("std [m]", "horizontal_std_m", 2),
    ("max [m]", "horizontal_max_m", 2), ("RMS east [m]", "rms_east_m", 2), ("north [m]", "rms_north_m", 2),
    ("up [m]", "rms_up_m", 2), ("wheels only [%]", "wheel_only_error_pct", 2),
    ("without stops' updates [%]", "no_zupt_error_pct", 2),
)

HINT = ("Drag over a figure to zoom: all that have a time axis follow. A double click shows the whole drive again. The "
        "values at the cursor appear in the legends; a click on a name hides its curve.")

STYLE = """
body { font-family: sans-serif; color: #222222; background: #ffffff; max-width: 62rem; margin: 2rem auto; padding: 0 1rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0 }
th, td { border-bottom: 1px solid #cccccc; padding: 0.3rem 0.6rem; text-align: right; font-size: 0.85rem }
th { font-weight: normal; color: #555555; vertical-align: bottom }
.wide { overflow-x: auto }
figure { margin: 1.5rem 0 } figcaption { font-weight: bold; margin-bottom: 0.3rem } img { max-width: 100% }
"""


def png_of(figure):
    figure.tight_layout()
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI)
    plt.close(figure)
    return buffer.getvalue()


def cell(value, decimals):
    return "-" if value is None else f"{value:.{decimals}f}"


def further_rows(metrics):
    """{name: errors} shown next to the filter: the smoothed drive, and other systems' tracks."""
    smoothed = {"smoothed": metrics["smoothed"]} if metrics.get("smoothed") else {}
    return {**smoothed, **metrics.get("compared", {})}


def table_row(metrics):
    """One row for the filter, and one for each track next to it."""
    further = further_rows(metrics)
    rows = {"filter": metrics, **further} if further else {"": metrics}
    heads = "".join(f"<th>{html.escape(title)}</th>" for title, _, _ in COLUMNS)
    named = "<th></th>" if further else ""
    lines = "".join("<tr>" + (f"<th>{html.escape(name)}</th>" if further else "")
                    + "".join(f"<td>{cell(row.get(key), decimals)}</td>" for _, key, decimals in COLUMNS) + "</tr>"
                    for name, row in rows.items())
    return f"<div class=wide><table><tr>{named}{heads}</tr>{lines}</table></div>"


def findings(title, alarms):
    """A table of problems or alarms; nothing for none."""
    if not alarms:
        return ""
    rows = "".join(f"<tr><td style='text-align:left'>{html.escape(alarm['what'])}</td><td>{alarm['count']}</td>"
                   f"<td>{alarm['first_s']:.3f}</td><td>{alarm['last_s']:.3f}</td></tr>" for alarm in alarms)
    heads = f"<tr><th style='text-align:left'>{html.escape(title)}</th><th>times</th><th>first [s]</th><th>last [s]</th></tr>"
    return f"<div class=wide><table>{heads}{rows}</table></div>"


def verdict(metrics):
    stops = f"stops: {metrics.get('stops_seen', 0)} seen, {metrics.get('stops_used', 0)} used"
    return (f"<p><b>{html.escape(metrics.get('verdict', ''))}</b> ({stops})</p>"
            f"{findings('Problem', metrics.get('problems', []))}{findings('Alarm', metrics.get('alarms', []))}")


def all_metrics(metrics):
    figures = {**metrics, **{f"{name}: {key}": value for name, row in further_rows(metrics).items()
                             for key, value in row.items()}}
    rows = "".join(f"<tr><td style='text-align:left'>{html.escape(key)}</td><td>{'-' if value is None else value}</td>"
                   "</tr>" for key, value in figures.items() if not isinstance(value, (list, dict)))
    return f"<details><summary>All figures of metrics.json</summary><table>{rows}</table></details>"


def figure_block(name, title, png, zoomable=False):
    """A zoomable figure has its picture only for browsers without scripts."""
    data = base64.b64encode(png).decode("ascii")
    picture = f'<img alt="{html.escape(title)}" src="data:image/png;base64,{data}">'
    if zoomable:
        picture = f"<div class=panels></div><noscript>{picture}</noscript>"
    return f"<figure id={name}><figcaption>{html.escape(title)}</figcaption>{picture}</figure>"


def script(library, data):
    own = interactive.read(os.path.join(os.path.dirname(__file__), "report.js"))
    return (f"<div id=cursor></div><script>{library}</script><script type=application/json id=data>{data.text()}</script>"
            f"<script>{own}</script>")


def draw_figures(run, zoomable, progress):
    """Writes the pictures; returns the blocks of the page and what its plots are drawn from."""
    blocks, data = [], interactive.PlotData(run)
    for name, title, draw in FIGURES:
        progress(title)
        figure = draw(run)
        data.add(name, figure)
        png = png_of(figure)
        with open(os.path.join(run.directory, name + ".png"), "wb") as file:
            file.write(png)
        blocks.append(figure_block(name, title, png, zoomable))
    return "".join(blocks), data


def write_report(run, progress):
    """Writes NAME.png for each figure and report.html; returns the path of the latter."""
    library = interactive.library()
    blocks, data = draw_figures(run, library is not None, progress)
    hint = (f"<p id=hint hidden>{HINT}</p>" if library else
            f"<p id=hint>Pictures only: {interactive.PACKAGES} were not installed when this page was made.</p>")
    name = html.escape(os.path.basename(os.path.abspath(run.directory)))
    style = STYLE + interactive.read(os.path.join(os.path.dirname(__file__), "report.css"))
    page = (f"<!DOCTYPE html><html lang=en><head><meta charset=utf-8>{interactive.POLICY}<title>slipnav: {name}</title>"
            f"<style>{style}</style></head><body><h1>Run {name}</h1>{table_row(run.metrics)}{verdict(run.metrics)}"
            f"{hint}{blocks}"
            f"{all_metrics(run.metrics)}{script(library, data) if library else ''}</body></html>\n")
    path = os.path.join(run.directory, "report.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)
    return path
