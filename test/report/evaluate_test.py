#!/usr/bin/python3
"""The program for several recordings: a failed one costs its row, and wrong arguments one line.

The environment names the executable: SLIPNAV_SIMULATE; `evaluate` is beside it.
"""

import html.parser
import os
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from drives_fixture import FolderTest, PROGRAM, heed_interrupts, wait_for_children  # noqa: E402

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
        return [sys.executable, PROGRAM, "--evaluate", self.fake, *arguments]

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


if __name__ == "__main__":
    unittest.main()
