#!/usr/bin/python3
"""The command forecast: a summary on the terminal, JSON where it is asked for, and a picture of both.

The environment names the executable: SLIPNAV_FORECAST.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import matplotlib

matplotlib.use("Agg")

import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from slipnav_report import palette, slip_picture  # noqa: E402

SAMPLES = os.path.join(ROOT, "test", "golden", "gp_slip.csv")
LEAST_PIXELS = 100
MOST_LINES = 15


def forecast(*words):
    program = os.path.join(ROOT, "scripts", "plot_forecast.py")
    command = [sys.executable, program, "--forecast", os.environ["SLIPNAV_FORECAST"], *words]
    return subprocess.run(command, check=False, capture_output=True, text=True)


class ForecastTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="slipnav_forecast_test_")
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def pixels(self, name, color):
        image = matplotlib.image.imread(self.path(name))[:, :, :3].reshape(-1, 3)
        return np.count_nonzero(np.abs(image - np.array(matplotlib.colors.to_rgb(color))).max(axis=1) < 0.03)

    def test_terminal_has_a_summary_and_the_file_all_of_it(self):
        result = forecast(SAMPLES, "--out", self.path("all.json"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertLess(result.stdout.count("\n"), MOST_LINES)
        with open(self.path("all.json"), encoding="utf-8") as file:
            found = json.load(file)
        self.assertEqual((len(found["t"]), found["model"]), (600, "paper"))
        self.assertEqual(json.loads(forecast(SAMPLES, "--out", "-").stdout), found)
        last = result.stdout.splitlines()[-1].split()
        np.testing.assert_allclose([float(word) for word in last], [60.0, found["mean"][-1], 2.0 * found["stddev"][-1]],
                                   atol=6e-5)

    def test_picture_holds_samples_and_forecast(self):
        for words in ((), ("--out", "-"), ("--out", self.path("x.json"), "--horizon=20")):
            plain = forecast(SAMPLES, *words)
            result = forecast(SAMPLES, *words, "--report", self.path("picture.png"))
            self.assertEqual((result.returncode, result.stderr, result.stdout), (0, "", plain.stdout))
            for color in (palette.TEXT, palette.ESTIMATE):
                self.assertGreater(self.pixels("picture.png", color), LEAST_PIXELS, color)
            os.remove(self.path("picture.png"))

    def test_curves_of_the_picture(self):
        found = json.loads(forecast(SAMPLES, "--out", "-").stdout)
        axes = slip_picture.draw(slip_picture.read_samples(SAMPLES), found).axes[0]
        samples, mean = axes.get_lines()
        np.testing.assert_array_equal(samples.get_xydata(), np.loadtxt(SAMPLES, delimiter=",", skiprows=1))
        np.testing.assert_array_equal(mean.get_ydata(), found["mean"])
        time_s, low, high = axes.collections[0].band
        np.testing.assert_array_equal(time_s, found["t"])
        np.testing.assert_allclose(high - low, 4.0 * np.array(found["stddev"]))

    def test_what_cannot_be_done_is_named_in_one_line(self):
        for words, status, wanted in (((SAMPLES, "--report"), 2, "--report: expected one argument"),
                                      ((SAMPLES, "--report", "/nowhere/x.png"), 1, "/nowhere/x.png"),
                                      (("/nowhere.csv", "--report", self.path("y.png")), 2, "/nowhere.csv"),
                                      ((SAMPLES, "--model", "none"), 2, "--model")):
            result = forecast(*words)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (status, 1), result.stderr)
            self.assertIn(wanted, result.stderr)
        self.assertFalse(os.path.exists(self.path("y.png")))

    def test_help_names_the_picture_too(self):
        self.assertIn("--report FILE.png", forecast("--help").stdout)


if __name__ == "__main__":
    unittest.main()
