#!/usr/bin/python3
"""Several recordings at once give what each gives alone, a failed one costs its row, and no loss of a worker is silent.

The environment names the executable: SLIPNAV_SIMULATE; `evaluate` is beside it.
"""

import csv
import functools
import glob
import html.parser
import importlib.util
import itertools
import json
import os
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from slipnav_campaign.task import Failure  # noqa: E402
from slipnav_drives import groups, recordings, table  # noqa: E402
from slipnav_drives.evaluation import Evaluation  # noqa: E402
from slipnav_drives.recordings import Recording, Span  # noqa: E402
from slipnav_drives.stops import StopTimes, read_stop_times  # noqa: E402
from slipnav_tables import accuracy  # noqa: E402

PROGRAM = os.path.join(ROOT, "scripts", "evaluate_drives.py")
TABLE_HEAD = ["head one", "head two"]

# Stands in for the executable: its figures follow from the name of the recording.
FAKE = """#!/bin/bash
if [[ "$*" == --help ]]; then
  printf 'usage: evaluate BAG [options]\\n\\n  --out DIR        where\\n  --config YAML    file\\n  --report         plots\\n'
  printf '  --odometry FILE  bytes\\n  --help           this\\n'
  exit 0
fi
echo "$*" >>"{folder}/calls"
bag="$1"; shift
name="$(basename "$bag" .bag)"
while (($#)); do
  [[ "$1" == --out ]] && out="$2"
  shift
done
if [[ "$name" == hang* ]]; then exec sleep 600; fi
if [[ "$name" == lost* ]] && ! [[ -e "{folder}/$name.marker" && "$name" != lost_again ]]; then
  touch "{folder}/$name.marker"
  kill -9 $$
fi
if [[ "$name" == bad* ]]; then
  echo "evaluate: problem: no wheels (3 times, 0.0 s)" >&2
  echo "evaluate: no start: the wheels fell off" >&2
  exit 1
fi
[[ "$name" == worse* ]] && verdict="over-confident: NEES 40" || verdict="consistent"
echo "evaluate: alarm: gyro <shaken> (2 times, 1.0 s)" >&2
[[ -z "$out" ]] || {{ mkdir -p "$out"; printf '{metrics}' "${{#name}}" "$verdict" >"$out/metrics.json"; }}
printf 'head one\\nhead two\\n%-20s %8s\\n%s: %s\\n' "$name" "${{#name}}" "$name" "$verdict"
"""

METRICS = ('{"distance_m": 12.3000000000000001, "enu_error_pct": %s, "final_pct": null, "cpu_s": 7, '
           '"problems": [], "alarms": [{"what": "gyro <shaken>", "count": 2, "first_s": 1, "last_s": 1}], "verdict": "%s"}')


def heed_interrupts():
    """Processes that a shell runs in the background are told to ignore them, and hand that on."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="slipnav_evaluate_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def executable(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)
        os.chmod(self.path(name), os.stat(self.path(name)).st_mode | stat.S_IXUSR)
        return self.path(name)

    def read(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def rows(self, folder="out"):
        with open(self.path(folder, "rows.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


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


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.targets, self.sources = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.targets += [attributes["href"]] if tag == "a" else []
        self.sources += [attributes.get("src", "")] if tag in ("img", "script", "link") else []


class ProgramTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.fake = self.executable("evaluate", FAKE.format(folder=self.folder, metrics=METRICS))

    def bags(self, *names):
        for name in names:
            os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
            with open(self.path(name + ".bag"), "w", encoding="ascii") as file:
                file.write(name)
        return [self.path(name + ".bag") for name in names]

    def command(self, *arguments):
        return [PROGRAM, "--evaluate", self.fake, *arguments]

    def run_program(self, *arguments):
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False, cwd=self.folder)

    def test_rows_are_in_the_order_of_the_arguments(self):
        result = self.run_program(*self.bags("one", "threes", "twos", "a"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines(),
                         TABLE_HEAD + [f"{name:20} {len(name):8}" for name in ("one", "threes", "twos", "a")]
                         + [f"{name}: consistent" for name in ("one", "threes", "twos", "a")])
        self.assertIn("evaluate: twos: alarm: gyro <shaken> (2 times, 1.0 s)\n", result.stderr)

    def test_one_recording_is_left_to_the_executable(self):
        bags = self.bags("one")
        for arguments in (bags, bags + ["--out", "x", "--report"], ["--config=a.yaml"] + bags, ["--nonsense"], []):
            expected = subprocess.run([self.fake, *arguments], capture_output=True, text=True, check=False,
                                      cwd=self.folder)
            result = self.run_program(*arguments)
            self.assertEqual((result.returncode, result.stdout, result.stderr),
                             (expected.returncode, expected.stdout, expected.stderr))
        calls = self.read("calls").splitlines()
        self.assertEqual(calls[0::2], calls[1::2])

    def test_a_failed_recording_costs_its_row(self):
        result = self.run_program("--out", "out", *self.bags("bad", "one"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("bad                   failed: no start: the wheels fell off\n", result.stdout)
        self.assertIn("one: consistent", result.stdout)
        self.assertIn("evaluate: bad: problem: no wheels (3 times, 0.0 s)\n", result.stderr)
        self.assertIn("evaluate: 1 of 2 recordings failed\n", result.stderr)
        self.assertEqual([row["verdict"] for row in self.rows()],
                         ["failed: no start: the wheels fell off", "consistent"])
        self.assertEqual(self.rows()[0]["problems"], "no wheels (3 times, 0.0 s)")
        self.assertIn("no wheels (3 times, 0.0 s)", self.read("out", "index.html"))

    def test_folders_are_searched(self):
        bags = self.bags("drives/b", "drives/deep/c", "drives/a")
        self.executable("drives/d.mcap", "")
        result = self.run_program(bags[0], "drives")
        self.assertEqual([line.split()[0] for line in result.stdout.splitlines()[2:]][:4], ["b", "a", "c", "b:"])
        self.assertIn("evaluate: drives/d.mcap is skipped: a ROS 2 recording; convert it", result.stderr)

    def test_figures_of_the_file_have_all_their_digits(self):
        self.run_program("--out", "out", *self.bags("one", "threes"))
        row = self.rows()[1]
        self.assertEqual((row["recording"], row["distance_m"], row["enu_error_pct"], row["final_pct"]),
                         ("threes", "12.3000000000000001", "6", ""))
        self.assertEqual(row["alarms"], "gyro <shaken> (2)")
        self.assertNotIn("cpu_s", row)

    def test_the_page_links_reports_and_needs_nothing_else(self):
        os.makedirs(self.path("out", "one"))
        for name in ("report.html", "metrics.json"):  # of another run
            with open(self.path("out", "one", name), "w", encoding="ascii") as file:
                file.write("old")
        self.run_program("--out", "out", "--report", *self.bags("one", "bad one", "worse than all"))
        text = self.read("out", "index.html")
        links = Links(text)
        self.assertEqual(links.targets, ["rows.csv", "worse%20than%20all/metrics.json", "one/metrics.json"])
        self.assertEqual([source for source in links.sources if not source.startswith("data:")], [])
        self.assertIn("prefers-color-scheme: dark", text)
        self.assertIn("gyro &lt;shaken&gt;", text)
        self.assertLess(len(text), 20000)

    def test_options_reach_the_executable(self):
        self.run_program("--config", "a.yaml", *self.bags("one", "threes"))
        self.assertEqual(sorted(self.read("calls").splitlines()),
                         sorted(f"{self.path(name)}.bag --config a.yaml" for name in ("one", "threes")))

    def test_what_is_killed_is_run_once_more(self):
        result = self.run_program(*self.bags("one", "lost", "lost_again"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("lost: evaluate was killed; it is rerun\n", result.stderr)
        self.assertIn("lost: consistent", result.stdout)
        self.assertIn("failed: evaluate was killed", result.stdout)
        self.assertEqual(sum("lost_again" in call for call in self.read("calls").splitlines()), 2)

    def test_interruption_ends_the_processes(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen(self.command("--jobs", "2", *self.bags("hang1", "hang2", "hang3")),
                                       stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                       preexec_fn=heed_interrupts)
            children = wait_for_children(process.pid, 2)
            process.send_signal(number)
            _, errors = process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130)
            self.assertIn("interrupted", errors)
            self.assertEqual([child for child in children if os.path.exists(f"/proc/{child}")], [])

    def test_wrong_arguments_give_one_line_and_status_2(self):
        bags = self.bags("one", "two")
        os.makedirs(self.path("empty"))
        for arguments, words in ((["--sepparate"], "unknown option '--sepparate', did you mean '--separate'?"),
                                 (["--report"], "--report needs --out"), (["--odometry", "x"], "for a single recording"),
                                 (["--group", "x"], "'x' is not NAME=GLOB"), (["--group", "x=y*"], "in the group 'x'"),
                                 (["--config"], "--config needs a value"), (["--out"], "--out needs a value"),
                                 (["--simulated", "one.bag"], "'one.bag' is not a tables.json of ./run tables"),
                                 (["empty"], "no recording (*.bag) in the folder 'empty'"), (["--jobs", "0"], "--jobs")):
            result = self.run_program(*bags, *arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""), arguments)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(words, result.stderr)

    def test_help_has_the_options_of_both(self):
        text = self.run_program("--help").stdout
        for option in ("--config YAML", "--group NAME=GLOB", "--scheduler ADDRESS", "--separate"):
            self.assertIn(option, text)

    def test_without_dask_its_package_is_named(self):
        """A folder before the others in which Dask is broken, as if it were not there."""
        self.executable("distributed.py", "raise ImportError\n")
        result = subprocess.run(self.command("--scheduler", "tcp://127.0.0.1:1", *self.bags("one")), capture_output=True,
                                text=True, check=False, env=dict(os.environ, PYTHONPATH=self.folder))
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(result.stderr, "evaluate: --scheduler needs Dask, which is not installed: "
                                        "sudo apt-get install python3-distributed\n")


def wait_for_children(parent, count):
    for _ in range(300):
        found = subprocess.run(["pgrep", "-P", str(parent)], capture_output=True, text=True, check=False).stdout
        if len(found.split()) >= count:
            return found.split()
        time.sleep(0.1)
    raise AssertionError(f"{parent} began nothing")


def is_running(process):
    """A process that has ended may have nobody to ask for its status."""
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def split_bag(path, parts, pauses):
    """Writes the messages before the first pause to the first part, and so on."""
    import rosbag

    with rosbag.Bag(path) as source:
        begin = source.get_start_time()
        targets = [rosbag.Bag(part, "w") for part in parts]
        for topic, message, stamp in source.read_messages():
            place = sum(stamp.to_sec() - begin >= pause for pause in pauses)
            targets[place].write(topic, message, stamp)
        for target in targets:
            target.close()


@functools.lru_cache(maxsize=None)
def recorded_drives():
    """A folder of four."""
    folder = tempfile.mkdtemp(prefix="slipnav_evaluate_drives_")
    unittest.addModuleCleanup(shutil.rmtree, folder, ignore_errors=True)
    for terrain, seed in itertools.product(("paved", "rough"), "12"):
        subprocess.run([os.environ["SLIPNAV_SIMULATE"], "--terrain", terrain, "--distance", "40", "--seed", seed,
                        "--policy", "periodic:15:3", "--bag", os.path.join(folder, f"{terrain}{seed}.bag")],
                       check=True, capture_output=True)
    return folder


class DrivesTest(FolderTest):
    """With the executables, on drives that were recorded in simulation."""

    def setUp(self):
        super().setUp()
        self.drives = recorded_drives()
        self.bags = sorted(glob.glob(os.path.join(self.drives, "*.bag")))
        self.evaluate = os.path.join(os.path.dirname(os.environ["SLIPNAV_SIMULATE"]), "evaluate")

    def run_program(self, *arguments, evaluate=None):
        result = subprocess.run([PROGRAM, "--evaluate", evaluate or self.evaluate, *arguments], capture_output=True,
                                text=True, check=False, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result


class RecordedDrivesTest(DrivesTest):
    def alone(self, bag):
        """Lines of its table, and figures."""
        out = self.path("alone", os.path.basename(bag))
        result = subprocess.run([self.evaluate, bag, "--out", out], check=True, capture_output=True, text=True)
        return result.stdout.splitlines(), self.read(out, "metrics.json")

    def test_the_table_is_that_of_single_runs(self):
        result = self.run_program("--out", "out", "--jobs", "3", *self.bags)
        lines = result.stdout.splitlines()
        singles = [self.alone(bag) for bag in self.bags]
        self.assertEqual(lines, singles[0][0][:2] + [single[2] for single, _ in singles]
                         + [single[3] for single, _ in singles])
        for bag, row, (_, metrics_json) in zip(self.bags, self.rows(), singles):
            figures = json.loads(metrics_json, parse_float=str, parse_int=str)
            for key in set(row) & set(figures) - {"problems", "alarms"}:
                self.assertEqual(row[key], figures[key] or "", key)
            name = os.path.basename(bag)
            for file in ("estimate.tum", "timeline.csv", "filter.csv"):
                self.assertEqual(self.read("out", name[:-4], file), self.read("alone", name, file))

    def test_the_number_of_workers_changes_no_bit(self):
        groups_of = ("--group", "firm=paved*", "--group", "soft=rough*")
        one, three = (self.run_program("--out", out, "--jobs", jobs, *groups_of, self.drives)
                      for out, jobs in (("one", "1"), ("three", "3")))
        self.assertEqual(one.stdout, three.stdout)
        self.assertIn("## Stop intervals by group", one.stdout)
        for name in ("rows.csv", "index.html", "groups.json", "groups.md", "stop_intervals.png"):
            with open(self.path("one", name), "rb") as first, open(self.path("three", name), "rb") as other:
                self.assertEqual(first.read(), other.read(), name)
        self.assertEqual([row["group"] for row in self.rows("one")], ["firm", "firm", "soft", "soft"])
        data = json.loads(self.read("one", "groups.json"))
        self.assertEqual(len(data["intervals"]["real"]["groups"]["soft"]["intervals_s"]), 2)
        self.assertAlmostEqual(data["intervals"]["real"]["groups"]["firm"]["intervals_s"][0], 15.0, delta=3.5)

    def test_parts_are_the_whole(self):
        parts = [self.path(f"paved1_{number}.bag") for number in range(3)]
        split_bag(self.bags[0], parts, (30.0, 60.0))
        result = self.run_program(*parts, self.bags[2], "--out", "out")
        self.assertIn(f"evaluate: paved1: one recording of 3 parts, which --separate would keep apart: {', '.join(parts)}",
                      result.stderr)
        lines, _ = self.alone(self.bags[0])
        self.assertIn(lines[2], result.stdout.splitlines())
        self.assertEqual(self.read("out", "paved1", "estimate.tum"), self.read("alone", "paved1.bag", "estimate.tum"))
        apart = subprocess.run([PROGRAM, "--evaluate", self.evaluate, "--separate", *parts], capture_output=True,
                               text=True, check=False)
        self.assertNotIn("one recording", apart.stderr)
        self.assertEqual([line.split()[0] for line in apart.stdout.splitlines() if line.startswith("paved1_")][:3],
                         ["paved1_0", "paved1_1", "paved1_2"])


@unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask is not installed (python3-distributed)")
class ClusterTest(DrivesTest):
    """A scheduler and three workers on this machine."""

    def setUp(self):
        super().setUp()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self.begin("dask_scheduler", "--host", "127.0.0.1", "--port", self.address.rpartition(":")[2])
        self.workers = [self.begin("dask_worker", self.address, "--nthreads", "1", "--no-nanny", "--local-directory",
                                   self.folder) for _ in range(3)]

    def begin(self, program, *arguments):
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}  # not that of ROS
        process = subprocess.Popen([sys.executable, "-m", f"distributed.cli.{program}", "--no-dashboard", *arguments],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder, env=environment)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def test_a_worker_that_is_killed_costs_its_task_once(self):
        slow = self.executable("evaluate", f'#!/bin/bash\n[[ "$1" == --help ]] || echo "$1" >>"{self.path("calls")}"\n'
                                           f'[[ "$1" == --help ]] || sleep 5\nexec "{self.evaluate}" "$@"\n')
        process = subprocess.Popen([PROGRAM, "--evaluate", slow, "--scheduler", self.address, "--out", "cluster",
                                    *self.bags], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   cwd=self.folder)
        child = wait_for_children(self.workers[1].pid, 1)[0]
        grandchild = wait_for_children(child, 1)[0]
        self.workers[1].kill()
        time.sleep(0.5)
        self.assertFalse(is_running(grandchild))  # what the worker had begun ends with it
        output, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, errors)
        self.assertRegex(errors, r"worker tcp://127\.0\.0\.1:\d+ is lost, [12] left\n")
        self.assertEqual(errors.count("its worker was lost; it is rerun"), 1, errors)
        self.assertEqual(len(self.read("calls").splitlines()), len(self.bags) + 1)
        here = self.run_program("--out", "here", *self.bags)
        self.assertEqual(output, here.stdout)
        self.assertEqual(self.read("cluster", "rows.csv"), self.read("here", "rows.csv"))
        self.assertEqual(self.read("cluster", "rough2", "timeline.csv"), self.read("here", "rough2", "timeline.csv"))


if __name__ == "__main__":
    unittest.main()
