#!/usr/bin/python3
"""Parts of one recording are found and joined; recordings are grouped and put in order."""

import json
import os
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from drives_fixture import FolderTest  # noqa: E402
from slipnav_campaign.task import Failure  # noqa: E402
from slipnav_drives import groups, recordings, table  # noqa: E402
from slipnav_drives.evaluation import Evaluation  # noqa: E402
from slipnav_drives.recordings import Recording, Span  # noqa: E402
from slipnav_drives.stops import StopTimes, read_stop_times  # noqa: E402
from slipnav_tables import accuracy  # noqa: E402


def span(begin, end, **counts):
    return Span(begin, end, {name: ("type", count) for name, count in (counts or {"imu": 1000}).items()})


class JoiningTest(unittest.TestCase):
    def chains(self, **spans):
        """Parts that are joined, of files NAME.bag with these spans."""
        self.said = []
        original, recordings.span_of = recordings.span_of, lambda path: spans[recordings.stem(path)]
        self.addCleanup(setattr, recordings, "span_of", original)
        found = recordings.joined([name + ".bag" for name in spans], self.said.append)
        return [tuple(recordings.stem(part) for part in parts) for parts in found]

    def test_the_next_begins_where_the_last_ends(self):
        self.assertEqual(self.chains(a_1=span(100.1, 200), a_0=span(0, 100), a_2=span(200.2, 201)),
                         [("a_0", "a_1", "a_2")])
        self.assertEqual(self.chains(a_0=span(0, 100), a_1=span(104, 200)), [("a_0",), ("a_1",)])
        self.assertEqual(self.chains(a_0=span(0, 100), a_1=span(98, 200)), [("a_0",), ("a_1",)])

    def test_names_do_not_matter_where_stamps_tell(self):
        self.assertEqual(self.chains(x=span(0, 100), y=span(101, 200)), [("x", "y")])

    def test_topics_are_the_same(self):
        self.assertEqual(self.chains(a_0=span(0, 100, imu=1000, wheels=100), a_1=span(101, 200, imu=1000)),
                         [("a_0",), ("a_1",)])
        self.assertEqual(self.chains(a_0=span(0, 100, imu=1000), a_1=span(101, 200, scan=1000)), [("a_0",), ("a_1",)])
        odd = Span(101, 200, {"imu": ("another type", 1000)})
        self.assertEqual(self.chains(a_0=span(0, 100), a_1=odd), [("a_0",), ("a_1",)])

    def test_rare_topics_may_be_missing(self):
        """Latched at the start of the first part; too slow for a short last part."""
        self.assertEqual(self.chains(a_0=span(0, 100, imu=1000, tf_static=1, fix=100), a_1=span(100, 102, imu=20)),
                         [("a_0", "a_1")])

    def test_two_robots_at_once_are_told_apart_by_name(self):
        self.assertEqual(self.chains(red_0=span(0, 100), blue_0=span(0, 100), blue_1=span(100, 200),
                                     red_1=span(100, 200)), [("red_0", "red_1"), ("blue_0", "blue_1")])

    def test_a_short_part_is_in_between(self):
        self.assertEqual(self.chains(a_0=span(0, 100), a_1=span(100.1, 101), a_2=span(101.1, 200)),
                         [("a_0", "a_1", "a_2")])

    def test_what_cannot_be_told_is_kept_apart_and_said(self):
        self.assertEqual(self.chains(one=span(0, 100), two=span(100, 200), three=span(100.1, 200)),
                         [("one",), ("two",), ("three",)])
        self.assertIn("one.bag may be continued by two.bag or three.bag: kept apart", self.said)

    def test_damaged_files_stay_alone(self):
        self.assertEqual(self.chains(a_0=span(0, 100), a_1=None), [("a_0",), ("a_1",)])

    def test_names(self):
        named = recordings.named([("x/drive_2026-01-02-03-04-05_0.bag", "x/drive_2026-01-02-03-09-05_1.bag"),
                                  ("a/run.bag",), ("b/run.bag",), ("noend",)])
        self.assertEqual([recording.name for recording in named],
                         ["drive_2026-01-02-03-04-05", "a_run", "b_run", "noend"])
        self.assertEqual(recordings.family("drive_2026-01-02-03-04-05_0.bag"), "drive")
        self.assertEqual(recordings.family("x/test_12.bag"), "test")


def evaluated(stops=StopTimes((), (), 0.0), enu_error_pct=1.0, verdict="consistent"):
    metrics = {"distance_m": 100.0, "stop_count": 2, "duration_s": 200.0, "enu_error_pct": enu_error_pct,
               "median_error_pct": 0.1, "horizontal_median_m": 0.5, "horizontal_std_m": 0.1, "horizontal_max_m": 0.9,
               "rms_east_m": 0.3, "rms_north_m": 0.4, "rms_up_m": None, "stop_rate_pct": 5.0}
    return Evaluation((), (), ("x: " + verdict,), (), json.dumps(metrics), stops)


def members(prefix, count):
    return [Recording(f"{prefix}{number}", (f"{prefix}{number}.bag",)) for number in range(count)]


class GroupsTest(unittest.TestCase):
    def test_median_rms_and_maximum(self):
        drives = members("a", 3)
        outcomes = dict(zip(drives, (evaluated(enu_error_pct=3.0), evaluated(enu_error_pct=4.0), Failure("lost"))))
        sections = groups.sections_of({"a": drives}, outcomes)
        found = sections["accuracy"].data["a"]["enu_error_pct"]
        self.assertEqual((found["median"], found["max"]), (3.5, 4.0))
        self.assertAlmostEqual(found["rms"], np.sqrt(12.5))
        self.assertIn("a: without a2, which failed.", sections["accuracy"].notes)
        self.assertEqual(sections["accuracy"].tables[0].rows[0][:3], ["a", "2", "median"])

    def test_a_recording_counts_once_with_the_median_of_its_intervals(self):
        grounds = {"firm": members("f", 2), "soft": members("s", 2)}
        stops = [StopTimes((10.0, 20.0, 90.0), (40.0, np.inf), 60.0), StopTimes((22.0,), (50.0,), 60.0),
                 StopTimes((5.0, 7.0), (30.0,), 60.0), StopTimes((8.0,), (33.0,), 60.0)]
        outcomes = dict(zip(grounds["firm"] + grounds["soft"], map(evaluated, stops)))
        section = groups.sections_of(grounds, outcomes)["intervals"]
        self.assertEqual(section.data["real"]["groups"]["firm"]["intervals_s"], [20.0, 22.0])
        self.assertEqual(section.data["forecast"]["groups"]["firm"]["intervals_s"], [50.0, 50.0])
        self.assertLess(section.data["real"]["anova_p"], 0.05)
        self.assertEqual(list(section.data["real"]["tukey_p"]), ["firm/soft"])
        self.assertEqual(section.figures[0].png[:4], b"\x89PNG")
        self.assertNotIn(groups.DOUBT, section.notes)

    def test_with_a_single_recording_each_interval_counts_and_that_is_said(self):
        grounds = {"firm": members("f", 1), "soft": members("s", 1)}
        outcomes = {grounds["firm"][0]: evaluated(StopTimes((10.0, 11.0), (), 60.0)),
                    grounds["soft"][0]: evaluated(StopTimes((5.0, 7.0, 6.0), (), 60.0))}
        section = groups.sections_of(grounds, outcomes)["intervals"]
        self.assertEqual(section.data["real"]["groups"]["soft"]["intervals_s"], [5.0, 7.0, 6.0])
        self.assertIsNotNone(section.data["real"]["anova_p"])
        self.assertIn(groups.DOUBT, section.notes)
        self.assertIn(f"{groups.TITLES['forecast']}: unknown for every group.", section.notes)

    def test_simulated_drives_stand_beside_and_change_no_test(self):
        grounds = {"firm": members("f", 2), "soft": members("s", 2)}
        outcomes = {one: evaluated(StopTimes((10.0 + place,), (), 60.0))
                    for place, one in enumerate(grounds["firm"] + grounds["soft"])}
        figures = {key: {"median": 7.0, "worst": 9.0} for _, key, _ in accuracy.COLUMNS_1 + accuracy.COLUMNS_2}
        simulated = {"table1": {"Test1": figures}, "table2": {"Rough_B": figures},
                     "intervals": {"real": {"terrains": {"paved": {"intervals_s": [50.0, 51.0], "at_least": 0}}}}}
        alone, beside = (groups.sections_of(grounds, outcomes, other) for other in (None, simulated))
        self.assertIn("simulated, Test1", [row[0] for row in beside["accuracy"].tables[0].rows])
        self.assertIn(["simulated, Rough_B", "", "autonomous", "7", "7 (9)", "7.00 (9.00)", "7.00 (9.00)", "7 (9)"],
                      beside["stops"].tables[0].rows)
        self.assertIn("paved, simulated", [row[1] for row in beside["intervals"].tables[0].rows])
        self.assertEqual(beside["intervals"].tables[1], alone["intervals"].tables[1])
        self.assertNotEqual(beside["intervals"].figures[0].png, alone["intervals"].figures[0].png)

    def test_what_has_no_two_stops_is_named(self):
        grounds = {"firm": members("f", 2)}
        outcomes = dict(zip(grounds["firm"], (evaluated(StopTimes((), (), 60.0)), evaluated(StopTimes((9.0,), (), 60.0)))))
        section = groups.sections_of(grounds, outcomes)["intervals"]
        self.assertIn(f"{groups.TITLES['real']}, firm: unknown for f0, which have no two stops.", section.notes)
        self.assertTrue(any("nothing to compare" in note for note in section.notes))

    def test_without_truth_the_errors_cannot_be_told(self):
        drives = members("a", 1)
        sections = groups.sections_of({"a": drives}, {drives[0]: evaluated(StopTimes((), (), 0.0), enu_error_pct=None)})
        self.assertIn("a: no errors for a0: no truth.", sections["accuracy"].notes)
        self.assertEqual(sections["intervals"].tables, [])


class StopTimesTest(FolderTest):
    def test_real_and_forecast_times_of_each_stop(self):
        stationary = [0, 1, 1] + [0] * 20 + [1, 1] + [0] * 30 + [1, 1] + [0] * 5
        with open(self.path("timeline.csv"), "w", encoding="ascii") as file:
            file.write("t,stationary\n" + "".join(f"{t},{rest}\n" for t, rest in enumerate(stationary)))
        with open(self.path("forecasts.csv"), "w", encoding="ascii") as file:
            file.write("t,horizon_s,horizontal_bound_m,time_to_stop_s\n"
                       "10,60,1,9\n18,1,1,12\n18,60,2,12\n19,60,1,3\n40,60,1,nan\n")
        found = read_stop_times(self.folder)
        self.assertEqual(found.real_s, (20.0, 30.0))
        self.assertEqual(found.forecast_s, (12.0, np.inf))  # none after the last stop
        self.assertEqual(found.horizon_s, 60.0)


class OrderTest(unittest.TestCase):
    def test_the_worst_come_first(self):
        names = ("fine", "large", "proud", "lost", "unused", "unjudged")
        outcomes = dict(zip((Recording(name, ()) for name in names),
                            (evaluated(), evaluated(enu_error_pct=2.0), evaluated(verdict="over-confident: NEES 9"),
                             Failure("gone"), evaluated(verdict="consistent; stops seen but not used: 1 of 2"),
                             evaluated(verdict="not judged: no truth", enu_error_pct=None))))
        self.assertEqual([recording.name for recording in table.worst_first(outcomes)],
                         ["lost", "proud", "unused", "unjudged", "large", "fine"])


if __name__ == "__main__":
    unittest.main()
