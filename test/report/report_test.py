#!/usr/bin/python3
"""The report of a simulated drive: each figure holds its data, the page needs nothing else, trajectories agree with the
metrics.

The environment names the executable: SLIPNAV_SIMULATE.
"""

import base64
import csv
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

import matplotlib

matplotlib.use("Agg")

import matplotlib.image  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from slipnav_report import (  # noqa: E402
    filter_health, forecasts, interactive, page, palette, stop_picture, tracks,
)
from slipnav_report.run_data import MOST_POINTS, RunData, read_tum, single_forecasts, thinned  # noqa: E402

MOST_BYTES = 6_000_000
MOST_BYTES_OF_PICTURES = 1_500_000
MOST_SECONDS = 60.0  # for a drive of a minute on a machine that is busy; see doc/visualization.md for what it takes
THRESHOLD_M = 0.8
LEAST_PIXELS = 30  # of pure color; the edges of lines are blended


def write_forecasts(directory, start):
    """Forecasts of known numbers: every second the bound grows by 2 cm per second, slip is 0.1 ± 0.05."""
    with open(os.path.join(directory, "forecasts.csv"), "w", newline="", encoding="ascii") as file:
        out = csv.writer(file)
        out.writerow(["t", "horizon_s", "horizontal_bound_m", "time_to_stop_s"])
        for made in range(10, 40):
            for horizon in range(1, 61):
                out.writerow([start + made, horizon, 0.02 * horizon, THRESHOLD_M / 0.02])
    with open(os.path.join(directory, "slip_forecasts.csv"), "w", newline="", encoding="ascii") as file:
        out = csv.writer(file)
        out.writerow(["t", "horizon_s", "mean", "stddev", "wheel_speed", "wheel_speed_above", "wheel_speed_below"])
        for made in range(10, 40):
            for horizon in np.arange(1, 11):
                out.writerow([start + made, horizon, 0.1, 0.05, 0.9, 0.95, 0.86])


def curve(axes, label):
    for line in axes.get_lines():
        if line.get_label() == label:
            return line
    raise AssertionError(f"no curve '{label}' among {[line.get_label() for line in axes.get_lines()]}")


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix="slipnav_report_")
        subprocess.run(
            [os.environ["SLIPNAV_SIMULATE"], "--distance", "25", "--seed", "3", "--smooth",
             "--threshold", str(THRESHOLD_M), "--out", cls.directory],
            check=True, stdout=subprocess.DEVNULL,
        )
        write_forecasts(cls.directory, RunData(cls.directory).start)
        begin = time.monotonic()
        subprocess.run([sys.executable, os.path.join(ROOT, "scripts", "plot_report.py"), cls.directory], check=True,
                       stderr=subprocess.DEVNULL)
        cls.seconds = time.monotonic() - begin
        cls.run_data = RunData(cls.directory)
        with open(os.path.join(cls.directory, "metrics.json"), encoding="utf-8") as file:
            cls.metrics = json.load(file)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    def tearDown(self):
        plt.close("all")

    def page(self):
        with open(os.path.join(self.directory, "report.html"), encoding="utf-8") as file:
            return file.read()

    def data(self):
        return json.loads(re.search(r"<script type=application/json id=data>(.*?)</script>", self.page(), re.S).group(1))

    def panels(self, figure):
        return [panel for panel in self.data()["panels"] if panel["figure"] == figure]

    def values(self, panel, name):
        """x and y of the curve of that name."""
        columns = self.data()["columns"]
        found = [one for one in panel["curves"] if one["name"] == name]
        self.assertEqual(len(found), 1, f"{name} among {[one['name'] for one in panel['curves']]}")
        return [np.array(columns[found[0][key]], dtype=float) for key in ("x", "y" if "y" in found[0] else "high")]

    def test_page_needs_nothing_else(self):
        text = self.page()
        self.assertTrue(interactive.POLICY in text)
        self.assertIn("default-src 'none'", interactive.POLICY)  # no browser loads anything
        own = text.replace(interactive.library() or "", "")
        self.assertEqual(re.findall(r"https?://|<script src|<link|@import|src=\"(?!data:)", own), [])
        self.assertLess(len(text.encode()), MOST_BYTES)
        self.assertLess(self.seconds, MOST_SECONDS)

    def test_page_without_the_library_has_the_pictures(self):
        run = RunData(self.directory)
        with tempfile.TemporaryDirectory() as empty, mock.patch.object(interactive, "FOLDER", empty):
            self.assertIsNone(interactive.library())
            run.directory = empty
            page.write_report(run, progress=lambda title: None)
            with open(os.path.join(empty, "report.html"), encoding="utf-8") as file:
                text = file.read()
        self.assertEqual(len(re.findall(r"<figcaption>[^<]*</figcaption><img ", text)), len(page.FIGURES))
        self.assertEqual(re.findall("<script|<noscript| hidden>", text), [])
        self.assertTrue(interactive.PACKAGES in text)
        self.assertLess(len(text.encode()), MOST_BYTES_OF_PICTURES)

    @unittest.skipUnless(interactive.library(), f"{interactive.PACKAGES} are not installed")
    def test_library_is_in_the_page_with_its_licenses(self):
        text = self.page()
        self.assertEqual(len(re.findall("<noscript>", text)), len(page.FIGURES))
        for wanted in ("OpenJS Foundation", "Permission is hereby granted", "fillBetween"):
            self.assertTrue(wanted in text, wanted)
        self.assertEqual((text.count("</script"), text.count("<!--")), (3, 0))  # none of its own ends a script

    @unittest.skipUnless(interactive.library(), f"{interactive.PACKAGES} are not installed")
    def test_curves_of_the_page_are_the_files(self):
        line = self.run_data.timeline
        (track,) = self.panels("track")
        self.assertTrue(track["track"])
        for name, table, keys in (("estimate", line, ("est_e", "est_n")), ("truth", self.run_data.truth, ("e", "n")),
                                  ("wheels and gyro only", self.run_data.wheel_track, ("east", "north"))):
            for got, key in zip(self.values(track, name), keys):
                np.testing.assert_allclose(got, table[key], atol=6e-4, err_msg=name)
        for panel, error, axis in zip(self.panels("errors"), self.run_data.errors(), "enu"):
            time_s, drawn = self.values(panel, "error")
            np.testing.assert_allclose(time_s, line["t"], atol=6e-4)
            np.testing.assert_allclose(drawn, error, rtol=1e-5)
            np.testing.assert_allclose(self.values(panel, "±3σ")[1], 3.0 * line["sigma_" + axis], rtol=1e-5)
        np.testing.assert_allclose(self.values(self.panels("slip")[0], "slip ratio")[1], line["slip"], rtol=1e-5)
        np.testing.assert_allclose(self.values(self.panels("velocity")[0], "filter")[1], line["speed"], rtol=1e-5)
        accel = self.values(self.panels("biases")[0], "forward")[1] * filter_health.MICRO_G
        np.testing.assert_allclose(accel, self.run_data.filter["accel_bias_x"], rtol=1e-5)
        nees = self.values(self.panels("consistency")[6], "NEES position")[1]
        np.testing.assert_allclose(nees, np.maximum(self.run_data.nees["nees"], filter_health.LEAST_SHOWN), rtol=1e-5)
        stops = [[begin, end] for begin, end, _, _ in self.run_data.stops()]
        np.testing.assert_allclose(self.data()["stops"], stops, atol=6e-4)

    @unittest.skipUnless(interactive.library(), f"{interactive.PACKAGES} are not installed")
    def test_forecasts_of_the_page_end_where_the_next_begins(self):
        panel = self.panels("forecast")[0]
        time_s, bound = self.values(panel, "forecast bound")
        self.assertEqual(np.count_nonzero(np.isnan(bound)), len(single_forecasts(self.run_data.forecasts)) - 1)
        np.testing.assert_allclose(bound[:60], 0.02 * np.arange(1, 61), rtol=1e-5)
        np.testing.assert_allclose(time_s[:60], 10.0 + np.arange(1, 61), atol=6e-4)
        self.assertEqual([one["y"] for one in panel["levels"]], [THRESHOLD_M])

    def test_drives_of_any_length_have_as_many_points(self):
        for rows in (1, 6000, 6001, 11999, 500000):
            time_s, _ = thinned(np.arange(rows), np.arange(rows))
            self.assertLessEqual(len(time_s), MOST_POINTS)
            self.assertGreater(2 * len(time_s), min(rows, MOST_POINTS))

    def test_threshold_is_the_configured_one(self):
        """Also where bounds are far from straight between two seconds, or come to it nowhere."""
        run = RunData(self.directory)
        run.metrics = {**self.metrics, "threshold_m": 1.0}
        error = forecasts.predicted_and_realized(run).axes[0]
        self.assertEqual(curve(error, "ε = 1 m").get_ydata()[0], 1.0)

    def test_noise_of_truth_is_drawn_where_it_is_larger(self):
        run = RunData(self.directory)
        for axis, factor in zip("enu", (0.5, 0.5, 2.0)):
            sigma = factor * np.median(run.timeline["sigma_" + axis])
            run.nees["truth_sigma_" + axis] = np.full(len(run.nees["t"]), sigma)
        figure = tracks.position_errors(run)
        labels = [[line.get_label() for line in axes.get_lines()] for axes in figure.axes]
        self.assertEqual([("±3σ of truth itself" in one) for one in labels], [False, False, True])
        drawn = curve(figure.axes[2], "±3σ of truth itself").get_ydata()
        np.testing.assert_allclose(drawn, 3.0 * run.nees["truth_sigma_u"])

    def test_files_have_the_noise_of_truth(self):
        self.assertTrue((self.run_data.nees["truth_sigma_u"] > self.run_data.nees["truth_sigma_e"]).all())

    def test_empty_axes_say_why(self):
        run = RunData(self.directory)
        for table in (run.forecasts, run.nees):
            table.update({name: column[:0] for name, column in table.items()})
        for name in "enu":
            run.timeline["truth_" + name] = np.full(len(run.timeline["t"]), np.nan)
        run.filter["nis_zero_rate"] = np.full(len(run.filter["t"]), np.nan)
        reasons = [getattr(axes, "empty", "") for draw in (forecasts.predicted_and_realized, filter_health.consistency)
                   for axes in draw(run).axes]
        self.assertEqual(reasons, ["no forecast and no truth", "no forecast, no countdown", "", "", "", "", "",
                                   "no stop, or none was used", "no truth in this recording", ""])

    def test_legends_cover_no_curve(self):
        for name, _, draw in page.FIGURES:
            figure = draw(self.run_data)
            figure.canvas.draw()
            for axes in figure.axes:
                if axes.get_legend():
                    self.assertGreaterEqual(axes.get_legend().get_window_extent().x0, axes.get_window_extent().x1, name)

    def test_page_holds_every_figure_and_each_shows_its_colors(self):
        wanted = {"track": ("ESTIMATE", "TRUTH", "DEAD_RECKONING", "STOP"), "errors": ("ESTIMATE", "ERROR"), "slip": ("TEXT",),
                  "forecast": ("ERROR", "ESTIMATE"), "velocity": ("ESTIMATE", "TRUTH", "DEAD_RECKONING"),
                  "biases": ("ESTIMATE", "ERROR", "STOP"), "consistency": ("ESTIMATE",)}
        found = re.findall(r'<figure id=(\w+)>.*?base64,([^"]+)"', self.page())
        self.assertEqual([name for name, _ in found], [name for name, _, _ in page.FIGURES])
        self.assertEqual({name for name, _ in found}, set(wanted))
        for name, data in found:
            png = base64.b64decode(data)
            with open(os.path.join(self.directory, name + ".png"), "rb") as file:
                self.assertEqual(file.read(), png)
            pixels = matplotlib.image.imread(io.BytesIO(png))[:, :, :3].reshape(-1, 3)
            for color in wanted[name]:
                rgb = np.array(matplotlib.colors.to_rgb(getattr(palette, color)))
                near = np.count_nonzero(np.abs(pixels - rgb).max(axis=1) < 0.03)
                self.assertGreater(near, LEAST_PIXELS, f"{name} has no {color}")

    def test_page_has_the_table_row(self):
        cells = re.findall(r"<td>([^<]*)</td>", self.page())
        self.assertEqual(cells[0], f"{self.metrics['distance_m']:.0f}")
        self.assertEqual(cells[1], str(self.metrics["stop_count"]))
        self.assertEqual(cells[3], f"{self.metrics['enu_error_pct']:.2f}")
        self.assertEqual(cells[len(page.COLUMNS) + 3], f"{self.metrics['smoothed']['enu_error_pct']:.2f}")

    def test_a_run_without_smoothing_has_one_row_and_no_smoothed_curve(self):
        plain = {key: value for key, value in self.metrics.items() if key != "smoothed"}
        self.assertEqual(page.table_row(plain).count("<tr>"), 2)
        run = RunData(self.directory)
        run.smoothed = None
        for figure in (tracks.ground_track(run), tracks.position_errors(run)):
            labels = [line.get_label() for line in figure.axes[0].get_lines()]
            self.assertNotIn("smoothed", labels)

    def test_tracks_of_others_have_a_row_and_curves(self):
        metrics = {**self.metrics, "compared": {"vio": {**self.metrics["smoothed"], "enu_error_pct": 98.76}}}
        row = page.table_row(metrics)
        self.assertEqual(row.count("<tr>"), 4)
        self.assertIn("<th>vio</th>", row)
        self.assertIn("<td>98.76</td>", row)
        run = RunData(self.directory)
        run.compared = {"vio": {key: values + (0.5 if key == "est_e" else 0.0) for key, values in run.smoothed.items()}}
        line = curve(tracks.ground_track(run).axes[0], "vio")
        np.testing.assert_allclose(line.get_xdata(), run.smoothed["est_e"] + 0.5)
        east = curve(tracks.position_errors(run).axes[0], "vio").get_ydata()
        np.testing.assert_allclose(east, run.smoothed["est_e"] - run.smoothed["truth_e"] + 0.5)

    def test_ground_track(self):
        axes = tracks.ground_track(self.run_data).axes[0]
        for label in ("estimate", "smoothed", "truth", "wheels and gyro only"):
            east, north = curve(axes, label).get_data()
            self.assertGreater(len(east), 100)
            self.assertGreater(np.ptp(east) + np.ptp(north), 20.0, label)
        stops = [line for line in axes.get_lines() if line.get_label().startswith("stops")]
        self.assertEqual(len(stops[0].get_xdata()), self.metrics["stop_count"])

    def test_position_errors(self):
        figure = tracks.position_errors(self.run_data)
        for axes, key in zip(figure.axes, ("rms_east_m", "rms_north_m", "rms_up_m")):
            error = curve(axes, "error").get_ydata()
            error = error[np.isfinite(error)]
            self.assertAlmostEqual(np.sqrt(np.mean(error**2)), self.metrics[key], delta=0.2 * self.metrics[key] + 0.003)
            self.assertEqual(len([c for c in axes.collections if c.get_label() == "±3σ"]), 1)
            rms = self.metrics["smoothed"][key]
            smoothed = curve(axes, "smoothed").get_ydata()
            smoothed = smoothed[np.isfinite(smoothed)]
            self.assertAlmostEqual(np.sqrt(np.mean(smoothed**2)), rms, delta=0.2 * rms + 0.003)

    def test_slip_and_its_forecast(self):
        axes = forecasts.slip_and_forecast(self.run_data).axes[0]
        slip = curve(axes, "slip ratio").get_ydata()
        self.assertGreater(np.count_nonzero(np.isfinite(slip)), 100)
        time_s, mean = curve(axes, "forecast mean").get_data()
        self.assertEqual(len(time_s), 10)
        self.assertAlmostEqual(time_s[0], 11.0, places=3)
        self.assertTrue(np.all(mean == 0.1))
        bands = [c for c in axes.collections if c.get_label().startswith("forecast")]
        self.assertAlmostEqual(bands[0].get_paths()[0].get_extents().height, 4 * 0.05, places=6)

    def test_forecast_and_realized_error(self):
        figure = forecasts.predicted_and_realized(self.run_data)
        error, countdown = figure.axes
        self.assertAlmostEqual(curve(error, "forecast bound").get_ydata()[-1], 1.2)
        grown = curve(error, "error grown since the last stop").get_ydata()
        self.assertGreater(np.nanmax(grown), 0.0)
        self.assertAlmostEqual(curve(error, f"ε = {THRESHOLD_M:g} m").get_ydata()[0], THRESHOLD_M, places=6)
        self.assertEqual(len(countdown.get_lines()[0].get_xdata()), 30)
        self.assertAlmostEqual(countdown.get_lines()[0].get_ydata()[0], 40.0)

    def test_figure_of_a_stop_holds_its_forecast(self):
        run = self.run_data
        stops = run.stops()
        self.assertGreaterEqual(len(stops), 2)
        stop = stop_picture.Stop(run, 2)
        self.assertEqual((stop.begin, stop.driving_since), (stops[1][0], stops[0][1]))
        made = np.unique(run.forecasts["t"])
        self.assertEqual(stop.forecast, made[made >= stop.driving_since][0])  # all of them announce a stop
        speeds, slip, wheels, error = stop_picture.stop_figure(run, 2).axes
        x, y = curve(error, "predicted bound").get_data()
        np.testing.assert_allclose(y, 0.02 * (x - stop.forecast), atol=1e-6)
        x, y = curve(error, f"stop due after {THRESHOLD_M / 0.02:.1f} s").get_data()
        np.testing.assert_allclose(x, stop.forecast + THRESHOLD_M / 0.02, atol=1e-6)
        x, y = curve(error, "error grown since the last stop").get_data()
        self.assertEqual((x[0] >= stop.driving_since, y[0]), (True, 0.0))
        self.assertGreater(y.max(), 0.0)
        np.testing.assert_allclose(curve(wheels, "of the mean slip").get_ydata(), 0.9)
        low, high = next(patch.band for patch in wheels.collections if hasattr(patch, "band"))[1:]
        np.testing.assert_allclose((low[0], high[0]), (0.86, 0.95))
        np.testing.assert_allclose(curve(slip, "predicted mean").get_ydata(), 0.1)
        np.testing.assert_allclose(curve(speeds, "filter").get_ydata(), run.timeline["speed"])

    def test_announcement_is_the_begin_of_what_announces_the_stop(self):
        due = np.array([np.nan, 30.0, np.nan, 20.0, 19.0, 18.0])
        table = {"t": np.arange(6.0), "time_to_stop_s": due}
        self.assertEqual(stop_picture.announcement(table, 0.0, 6.0), 3.0)
        self.assertEqual(stop_picture.announcement(table, 1.0, 3.0), 2.0)  # none does: the last one
        self.assertIsNone(stop_picture.announcement(table, 6.0, 9.0))

    def test_stop_that_there_is_not_is_refused(self):
        program = os.path.join(ROOT, "scripts", "plot_report.py")
        count = len(self.run_data.stops())
        for number in (0, count + 1):
            result = subprocess.run([sys.executable, program, self.directory, "--figure", str(number)],
                                    capture_output=True, text=True, check=False)
            self.assertEqual((result.returncode, result.stderr),
                             (1, f"plot_report: there is no stop {number}: the drive has {count}\n"))
        subprocess.run([sys.executable, program, self.directory, "--figure", "1"], check=True)
        self.assertEqual(matplotlib.image.imread(os.path.join(self.directory, "stop_1.png")).shape[2], 4)

    def test_velocity(self):
        axes = filter_health.velocity(self.run_data).axes[0]
        for label in ("wheels", "truth, over 1 s", "filter"):
            speed = curve(axes, label).get_ydata()
            self.assertAlmostEqual(np.median(speed[speed > 0.4]), 0.8, delta=0.1, msg=label)

    def test_biases(self):
        for axes in filter_health.biases(self.run_data).axes:
            for axis in filter_health.AXIS_NAMES:
                bias = curve(axes, axis).get_ydata()
                self.assertGreater(len(bias), 100)
                self.assertGreater(np.max(np.abs(bias)), 0.0)

    def test_consistency(self):
        figure = filter_health.consistency(self.run_data)
        titles = [axes.get_title() for axes in figure.axes[:7]]
        for axes, title in zip(figure.axes, titles):
            self.assertNotIn("not measured", title)
            self.assertGreater(len(axes.get_lines()[0].get_xdata()), 10)
        self.assertIn("NEES", titles[6])
        mean = float(re.search(r"mean/dof ([\d.]+)", titles[6]).group(1))
        self.assertAlmostEqual(mean, self.metrics["position_nees_mean"], delta=0.01)

    def test_trajectories_have_the_rmse_of_the_metrics(self):
        """As evo_ape pairs them: the nearest stamp within 10 ms."""
        truth = read_tum(os.path.join(self.directory, "truth.tum"))
        estimate = read_tum(os.path.join(self.directory, "estimate.tum"))
        nearest = np.abs(estimate["t"][:, None] - truth["t"][None, :]).argmin(axis=0)
        paired = np.abs(estimate["t"][nearest] - truth["t"]) <= 0.01
        square = sum((estimate[a][nearest] - truth[a])[paired] ** 2 for a in "enu")
        rms = np.sqrt(sum(self.metrics[key] ** 2 for key in ("rms_east_m", "rms_north_m", "rms_up_m")))
        self.assertAlmostEqual(np.sqrt(square.mean()), rms, delta=1e-6)

    @unittest.skipUnless(shutil.which("evo_ape"), "evo is not installed")
    def test_evo_agrees(self):
        output = subprocess.run(["evo_ape", "tum", "truth.tum", "estimate.tum"], cwd=self.directory, check=True,
                                capture_output=True, text=True).stdout
        rms = np.sqrt(sum(self.metrics[key] ** 2 for key in ("rms_east_m", "rms_north_m", "rms_up_m")))
        self.assertAlmostEqual(float(re.search(r"rmse\s+([\d.]+)", output).group(1)), rms, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
