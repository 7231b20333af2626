#!/usr/bin/python3
"""The campaigns over worlds and foreign drives find what is broken, and draw the same grid at every call."""

import os
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from slipnav_campaign.task import Failure  # noqa: E402
from slipnav_zoo import adversary, grid, worlds  # noqa: E402
from slipnav_zoo.evaluation import rests, used  # noqa: E402
from slipnav_zoo.simulation import NO_STOPS, STOPS, Drive, Figures  # noqa: E402
from slipnav_zoo.table import markdown  # noqa: E402


def figures(alarms=(), **changes):
    metrics = {"enu_error_pct": 0.1, "horizontal_final_m": 0.2, "distance_m": 100.0, "wheel_only_error_pct": 1.0,
               "coverage_3sigma_pct": 99.5, "position_nees_mean": 1.0}
    simulation = {"nees_end_attitude": 1.0, "nees_end_velocity": 1.0, "nees_end_position": 1.0, "stops_seen": 2,
                  "stops_used": 2, "largest_speed_mps": 0.9, "largest_wheel_speed_mps": 0.9, "largest_error_m": 0.3,
                  "longest_beyond_3sigma_s": 0.0, "alarms": [{"what": alarm} for alarm in alarms]}
    for block in (metrics, simulation):
        block.update({key: value for key, value in changes.items() if key in block})
    return Figures(metrics, simulation)


class WorldsTest(unittest.TestCase):
    def broken(self, world="paved", **changes):
        drive = Drive(world, "tactical", STOPS, 1)
        return worlds.report({drive: figures(**changes)})[1].broken

    def test_a_good_drive_breaks_nothing(self):
        self.assertEqual(self.broken(), [])

    def test_each_limit_is_held(self):
        for change in ({"horizontal_final_m": 1.4}, {"nees_end_attitude": 1.7}, {"nees_end_velocity": 0.3},
                       {"nees_end_position": None}, {"coverage_3sigma_pct": 97.0}, {"stops_used": 1},
                       {"largest_speed_mps": 3.0}):
            self.assertEqual(len(self.broken(**change)), 1, change)

    def test_a_stuck_rover_stays_within_metres(self):
        self.assertEqual(self.broken(largest_error_m=3.5), [])
        self.assertEqual(len(self.broken("stuck_60s", largest_error_m=3.5)), 1)

    def test_a_failed_drive_is_named(self):
        drive = Drive("paved", "tactical", NO_STOPS, 1)
        self.assertEqual(worlds.report({drive: Failure("no start")})[1].broken,
                         ["paved, tactical, none, seed 1: no start"])


class GridTest(unittest.TestCase):
    def test_the_draw_is_always_the_same(self):
        self.assertEqual(len(set(grid.cells())), 60)
        self.assertEqual(grid.cells()[:3], grid.cells(3))
        self.assertEqual(grid.cells(1), [(0.04, 100, 50, "slope_firm", "tactical", 0.001)])

    def test_three_cells_may_be_fair_and_none_broken(self):
        outcomes = {drive: figures() for drive in grid.drives(seeds=1)}
        self.assertEqual(grid.report(outcomes)[1].broken, [])
        drives = list(outcomes)
        for drive in drives[:3]:
            outcomes[drive] = figures(position_nees_mean=3.0)
        self.assertEqual(grid.report(outcomes)[1].broken, [])
        outcomes[drives[3]] = figures(position_nees_mean=3.0)
        self.assertEqual(len(grid.report(outcomes)[1].broken), 1)
        outcomes[drives[3]] = figures(position_nees_mean=5.0)
        self.assertEqual(len(grid.report(outcomes)[1].broken), 2)


class AdversaryTest(unittest.TestCase):
    TEXT = """imu:
  noise:
    # velocity random walk [m/s] (1e-06 to 100)
    accel_noise_mps_per_sqrt_h: 0.008
wheel:
  # noise (0.001 to 0.02)
  speed_std_mps: 0.01
forecast:
  # not of the estimate (0 to 1)
  sigmas: 0.5
"""

    def test_parameters_stay_within_their_ranges(self):
        known = adversary.parameters(self.TEXT)
        self.assertEqual(known, {"imu.noise.accel_noise_mps_per_sqrt_h": (0.008, 1e-6, 100.0),
                                 "wheel.speed_std_mps": (0.01, 0.001, 0.02)})
        drives = adversary.drives(50, ["paved", "rough"], ["mems"], known)
        self.assertEqual(drives, adversary.drives(50, ["paved", "rough"], ["mems"], known))
        speeds = [float(setting.split("=")[1]) for drive in drives for setting in drive.settings if "speed" in setting]
        self.assertEqual(max(speeds), 0.02)
        self.assertLess(min(speeds), 0.005)

    def test_a_silent_loss_is_broken_and_a_named_one_is_not(self):
        drive = Drive("paved", "mems", STOPS, 1)
        self.assertEqual(len(adversary.report({drive: figures(longest_beyond_3sigma_s=40.0)})[1].broken), 1)
        named = figures(["forward_speed contradicts"], longest_beyond_3sigma_s=40.0)
        self.assertEqual(adversary.report({drive: named})[1].broken, [])
        self.assertEqual(len(adversary.report({drive: figures(largest_speed_mps=3.0)})[1].broken), 1)


class EvaluationTest(unittest.TestCase):
    def test_rests_lie_between_driving(self):
        time = np.arange(0.0, 20.0, 0.1)
        speed = np.where((time > 2.0) & (time < 8.05) | (time > 12.0) & (time < 15.0) | (time > 16.0), 0.8, 0.0)
        found = rests(time, speed)
        self.assertEqual(len(found), 1)  # neither the first rest nor that of one second
        self.assertAlmostEqual(found[0][0], 8.1)
        stationary = (time > 9.0) & (time < 10.0)
        self.assertTrue(used(found[0], time, stationary))
        self.assertFalse(used(found[0], time, stationary & (time > 11.0)))


class TableTest(unittest.TestCase):
    def test_a_long_last_column_widens_no_other_row(self):
        lines = markdown(["a", "alarms"], [["1", "x" * 50], ["2", "-"]]).splitlines()
        self.assertEqual(lines[-1], "| 2 | - |")


if __name__ == "__main__":
    unittest.main()
