"""The figures as data for the plots that the page draws itself, read from matplotlib's axes.

The plots are those of Flot, which comes with the system and goes into the page.
"""

import json
import os

import numpy as np
from matplotlib.colors import to_hex

from . import palette

FOLDER = "/usr/share/javascript"
LIBRARIES = ("jquery/jquery.min.js", "jquery-flot/jquery.flot.min.js")
# Part of the file above where they are empty; older packages have them separately.
PLUGINS = tuple(f"jquery-flot/jquery.flot.{name}.min.js" for name in ("fillbetween", "symbol"))
PACKAGES = "libjs-jquery and libjs-jquery-flot"
NOTICE = """/*! Flot, Copyright (c) 2007-2014 IOLA and Ole Laursen. Licensed under the MIT license:
Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
persons to whom the Software is furnished to do so, subject to the following conditions:
The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software.
THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE. */
"""
DECIMALS = 3  # along x: ms and mm
DIGITS = 6  # along y

# Keeps browsers from loading anything for this page, whatever is in it.
POLICY = ("<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; img-src data:; "
          "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">")


def library():
    """The library's text, or None if it is not installed."""
    needed = [os.path.join(FOLDER, name) for name in LIBRARIES]
    if not all(os.path.isfile(path) for path in needed):
        return None
    plugins = [os.path.join(FOLDER, name) for name in PLUGINS]
    jquery, *parts = needed + [path for path in plugins if os.path.isfile(path)]
    return "\n".join([read(jquery), NOTICE, *map(read, parts)]).replace("</script", "<\\/script")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Columns:
    """Columns of numbers, each once however many curves share it."""

    def __init__(self):
        self.texts = []
        self.places = {}

    def add(self, values, write):
        text = "[" + ",".join("null" if not np.isfinite(value) else write(value) for value in values) + "]"
        if text not in self.places:
            self.places[text] = len(self.texts)
            self.texts.append(text)
        return self.places[text]

    def x(self, values):
        return self.add(values, lambda value: f"{value:.{DECIMALS}f}")

    def y(self, values):
        return self.add(values, lambda value: f"{value:.{DIGITS}g}")


def joined(curves):
    """Curves whose name begins with _ go on, after a gap, what was drawn before them in the same style."""
    out = []
    for curve in curves:
        before = next((one for one in reversed(out) if one["style"] == curve["style"]), None)
        if curve["name"].startswith("_") and before:
            for key, values in curve["values"].items():
                before["values"][key] = np.concatenate([before["values"][key], [np.nan], values])
        else:
            out.append(curve)
    return out


def curve_of(line):
    values = {"x": np.asarray(line.get_xdata(), float), "y": np.asarray(line.get_ydata(), float)}
    if hasattr(line, "times"):
        values["t"] = np.asarray(line.times, float)
    marker = line.get_marker() if line.get_linestyle() == "None" else None
    style = {"color": to_hex(line.get_color()), "dash": line.get_linestyle(), "width": line.get_linewidth(),
             "marker": marker, "size": line.get_markersize() if marker else 0}
    return {"name": line.get_label(), "style": style, "values": values}


def band_of(collection):
    time, low, high = (np.asarray(column, float) for column in collection.band)
    style = {"color": to_hex(collection.get_facecolor()[0]), "alpha": collection.get_alpha()}
    return {"name": collection.get_label(), "style": style, "values": {"x": time, "low": low, "high": high}}


def curves_of(axes, columns):
    bands = [band_of(one) for one in axes.collections if hasattr(one, "band")]
    lines = [curve_of(one) for one in axes.get_lines() if not hasattr(one, "level")]
    return [{"name": "" if curve["name"].startswith("_") else curve["name"], **curve["style"],
             **{key: columns.x(values) if key in "xt" else columns.y(values) for key, values in curve["values"].items()}}
            for curve in joined(bands) + joined(lines) if len(curve["values"]["x"])]


def panel_of(figure, axes, columns):
    levels = [{"name": line.get_label(), "color": to_hex(line.get_color()), "y": float(line.level)}
              for line in axes.get_lines() if hasattr(line, "level")]
    ranges = [list(patch.range) for patch in axes.patches if hasattr(patch, "range")]
    return {"figure": figure, "label": axes.get_ylabel(), "title": axes.get_title(),
            "track": axes.get_aspect() != "auto", "log": axes.get_yscale() == "log",
            "empty": getattr(axes, "empty", ""), "xlim": axes.get_xlim(), "ylim": axes.get_ylim(),
            "curves": curves_of(axes, columns), "levels": levels, "ranges": ranges}


class PlotData:
    """Collects the figures; text() is a JSON object of columns, panels and stops."""

    def __init__(self, run):
        self.columns = Columns()
        self.panels = []
        self.stops = [[round(float(begin), DECIMALS), round(float(end), DECIMALS)] for begin, end, _, _ in run.stops()]
        self.end = float(run.timeline["t"][-1])

    def add(self, name, figure):
        self.panels += [panel_of(name, axes, self.columns) for axes in figure.axes if axes.axison]

    def text(self):
        rest = json.dumps({"panels": self.panels, "stops": self.stops, "end": self.end, "shade": palette.SAFE,
                           "dark": palette.ON_DARK}, ensure_ascii=False)
        return f'{{"columns":[{",".join(self.columns.texts)}],{rest[1:]}'.replace("<", "\\u003c")
