#!/usr/bin/python3
"""Evaluates several recordings at once, with one table, one page and the paper's tables by group.

One recording without the options of this program is passed to the executable `evaluate` unchanged.
"""

import argparse
import difflib
import fnmatch
import glob
import json
import os
import re
import shutil
import subprocess
import sys

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign import engine  # noqa: E402
from slipnav_campaign.task import Failure, Task  # noqa: E402
from slipnav_drives import page, table  # noqa: E402
from slipnav_drives.evaluation import Order, evaluate, findings  # noqa: E402
from slipnav_drives.recordings import recordings_of  # noqa: E402

FOR_ONE = ("odometry", "part", "figure")  # options of the executable that apply to a single recording


def say(text):
    print(f"evaluate: {text}", file=sys.stderr)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"evaluate: {message}\n")


def positive_count(text):
    count = int(text)
    if count < 1:
        raise ValueError
    return count


positive_count.__name__ = "count above zero"


def group(text):
    name, equals, pattern = text.partition("=")
    if not (name and equals and pattern):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=GLOB")
    return name, pattern


def sections_of_tables(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)["sections"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise argparse.ArgumentTypeError(f"'{path}' is not a tables.json of ./run tables:  {error}")


def own_parser():
    parser = Parser(prog="evaluate", usage=argparse.SUPPRESS, add_help=False, allow_abbrev=False,
                    formatter_class=lambda prog: argparse.HelpFormatter(prog, max_help_position=32, width=120))
    options = parser.add_argument_group("Several BAGs, or folders of them, are evaluated together; --out then has a "
                                        "folder for each, index.html and rows.csv")
    options.add_argument("--separate", action="store_true",
                         help="parts of a split recording are separate recordings, not joined")
    options.add_argument("--group", type=group, action="append", default=[], metavar="NAME=GLOB",
                         help="recordings whose path or file name matches, for the paper's tables and its figure of stop "
                              "intervals by group; without a BAG the matching files; may be repeated")
    options.add_argument("--simulated", type=sections_of_tables, metavar="FILE",
                         help="tables.json of ./run tables: its drives are shown next to the groups")
    engine.add_options(options, positive_count)
    options.add_argument("--evaluate", metavar="FILE", help="the executable (default: in PATH, or next to this program)")
    return parser


def without_executable(words):
    """(The executable or None, the other words)"""
    if "--evaluate" not in words[:-1]:
        beside = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "evaluate")
        return shutil.which("evaluate") or beside, words
    place = words.index("--evaluate")
    return words[place + 1], words[:place] + words[place + 2:]


class CommandLine:
    """Separates the options of this program from those of the executable, which it knows from its help."""

    def __init__(self, words, executable, parser):
        self.options = {}  # of the executable, by name: whether they take a value
        self.help = subprocess.run([executable, "--help"], check=True, capture_output=True, text=True).stdout
        for name, value in re.findall(r"^  --([\w-]+)( \S)?", self.help, flags=re.M):
            self.options[name] = bool(value)
        self.own_options = {action.option_strings[0][2:]: action.nargs is None for action in parser._actions}
        self.own, self.passed, self.bags, self.unknown, self.unfinished = [], [], [], [], []
        self.out = None
        self.sort(list(words))

    def sort(self, words):
        while words:
            word = words.pop(0)
            name, equals, _ = word[2:].partition("=")
            if word == "--":
                self.bags += words
                return
            if not word.startswith("-"):
                self.bags.append(word)
                continue
            target = self.own if name in self.own_options else self.passed
            takes_value = self.own_options.get(name, self.options.get(name))
            taken = [word]
            if takes_value and not equals:
                (taken if words else self.unfinished).append(words.pop(0) if words else word)
            if takes_value is None or not word.startswith("--"):
                self.unknown.append(word)
            if name == "out":
                self.out = taken[-1].partition("=")[2] if equals else taken[-1]
            else:
                target += taken

    def has(self, option):
        return any(word.partition("=")[0] == f"--{option}" for word in self.passed)

    def complain(self, parser):
        for word in self.unknown:
            known = [f"--{name}" for name in {**self.options, **self.own_options}]
            near = difflib.get_close_matches(word.partition("=")[0], known, 1, 0.0)
            parser.error(f"unknown option '{word}', did you mean '{near[0]}'?")
        for word in self.unfinished:
            parser.error(f"{word} needs a value")
        for option in FOR_ONE:
            if self.has(option):
                parser.error(f"--{option} is for a single recording")
        if self.has("report") and not self.out:
            parser.error("--report needs --out")


def members_of(parser, arguments, recordings):
    """{group: its recordings}; a recording is in the first group that matches."""
    groups = {name: [] for name, _ in arguments.group}
    for recording in recordings:
        for name, pattern in arguments.group:
            if any(fnmatch.fnmatch(path, pattern) for path in (recording.name, *recording.parts,
                                                               *map(os.path.basename, recording.parts))):
                groups[name].append(recording)
                break
    for name, members in groups.items():
        if not members:
            parser.error(f"no recording is in the group '{name}'")
    return groups


def evaluate_all(arguments, line, recordings):
    """{recording: Evaluation or Failure}"""
    order = Order(os.path.abspath(arguments.evaluate), tuple(line.passed), line.out and os.path.abspath(line.out),
                  bool(arguments.group))
    tasks = [Task(recording.name, evaluate, (recording, order), recording.size) for recording in recordings]
    with engine.pool_of(arguments) as pool:
        return dict(zip(recordings, engine.run_all(tasks, pool, "recordings")))


def say_findings(outcomes):
    for recording, outcome in outcomes.items():
        for finding in findings(outcome.said) if isinstance(outcome, Failure) else outcome.said:
            say(f"{recording}: {finding}")


def sections_by_group(groups, outcomes, simulated):
    """({name: Section}, as text, as HTML)"""
    from slipnav_drives.groups import sections_of  # draws, and is slow to load
    from slipnav_tables.output import section_html, section_markdown

    sections = sections_of(groups, outcomes, simulated)
    return (sections, "\n\n".join(map(section_markdown, sections.values())),
            "".join(map(section_html, sections.values())))


def write(directory, name, content):
    with open(os.path.join(directory, name), "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def report(line, groups, outcomes, simulated):
    """Prints the table, and writes the files about all recordings."""
    print(table.text(outcomes), end="")
    sections, markdown, sections_html = sections_by_group(groups, outcomes, simulated) if groups else ({}, "", "")
    if markdown:
        print("\n" + markdown)
    if not line.out:
        return
    os.makedirs(line.out, exist_ok=True)
    group_of = {recording: name for name, members in groups.items() for recording in members}
    write(line.out, "rows.csv", table.rows_csv(outcomes, group_of))
    write(line.out, "index.html", page.index_html(outcomes, line.out, group_of, sections_html))
    if sections:
        data = {name: section.data for name, section in sections.items()}
        write(line.out, "groups.json", json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n")
        write(line.out, "groups.md", markdown + "\n")
        for figure in (figure for section in sections.values() for figure in section.figures):
            write(line.out, figure.name + ".png", figure.png)
    say(os.path.join(line.out, "index.html"))


def run(parser, arguments, line):
    bags = line.bags or [path for _, pattern in arguments.group for path in sorted(glob.glob(pattern, recursive=True))]
    try:
        recordings = recordings_of(bags, arguments.separate, say)
    except ValueError as error:
        parser.error(str(error))
    if not recordings:
        parser.error("missing argument BAG")
    groups = members_of(parser, arguments, recordings)
    outcomes = evaluate_all(arguments, line, recordings)
    say_findings(outcomes)
    report(line, groups, outcomes, arguments.simulated)
    failed = sum(isinstance(outcome, Failure) for outcome in outcomes.values())
    if failed:
        say(f"{failed} of {len(outcomes)} recordings failed")
    return 1 if failed else 0


def is_for_one(line):
    """Whether the executable alone is enough, as if this program did not exist."""
    return not line.own and len(line.bags) < 2 and not any(map(os.path.isdir, line.bags))


def main():
    parser = own_parser()
    executable, words = without_executable(sys.argv[1:])
    if not os.access(executable, os.X_OK):
        parser.error(f"no executable '{executable}', name it by --evaluate")
    line = CommandLine(words, executable, parser)
    if line.has("help") or "-h" in line.passed:
        print(line.help.replace("BAG [options]", "BAG... [options]", 1) + "\n" + parser.format_help().strip())
        return 0
    if is_for_one(line):
        os.execv(executable, [executable, *words])
    line.complain(parser)
    return engine.status_of(lambda: run(parser, parser.parse_args(["--evaluate", executable, *line.own]), line), say)


if __name__ == "__main__":
    sys.exit(main())
