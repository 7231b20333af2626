"""Builds the core with one mutant in it, and runs the unit tests against it, all on copies in a folder of its own."""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import xml.etree.ElementTree

LIBRARY = "libslipnav_core.so"
TESTS = "slipnav_unit_tests"
OBJECTS = pathlib.Path("CMakeFiles/slipnav_core.dir")
QUICK_S = 0.1
# What the simulation uses of the core: its tests, which take long, see no other mutant.
SEEN_BY_THE_WORLD = ("base", "earth", "parameters")
# A mutant that takes this many times as long as the original, and this much longer, never ends.
PATIENCE_FACTOR, PATIENCE_S = 8, 20
LIMITS = ["prlimit", f"--as={8 << 30}", f"--fsize={1 << 30}", "--core=0"]

NOT_COMPILED, SAME, KILLED, TIMEOUT, SURVIVED = "does not compile", "same code", "killed", "timeout", "survived"


class Broken(Exception):
    """The tests cannot be run, or fail without a mutant."""


class Workshop:
    def __init__(self, root, build, folder):
        self.root, self.build, self.folder = root, build, folder
        self.library_folder = folder / "lib"
        self.copy()
        commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
        self.commands = {entry["file"]: shlex.split(entry["command"]) for entry in commands}
        self.link_command = shlex.split((build / OBJECTS / "link.txt").read_text(encoding="utf-8"))
        self.launcher = ["ccache"] if shutil.which("ccache") else []
        self.seconds = self.seconds_of_tests()

    def copy(self):
        """Sources and build may change while mutants are tried."""
        shutil.rmtree(self.folder, ignore_errors=True)
        for name in ("src", "include"):
            shutil.copytree(self.root / name, self.folder / name)
        shutil.copytree(self.build / OBJECTS, self.folder / OBJECTS)
        self.library_folder.mkdir()
        for library in (self.build / "devel/lib").glob("*.so"):
            shutil.copy(library, self.library_folder)
        shutil.copy(self.build / "devel/lib/slipnav" / TESTS, self.folder)

    def environment(self, library_folders, temporary):
        temporary.mkdir(exist_ok=True)
        paths = ":".join(map(str, library_folders))
        return dict(os.environ, LD_LIBRARY_PATH=paths, TMPDIR=str(temporary), TEST_TMPDIR=str(temporary))

    def seconds_of_tests(self):
        """{(test, its file): what it takes without a mutant}"""
        results = self.folder / "tests.xml"
        done = subprocess.run([*LIMITS, str(self.folder / TESTS), "--gtest_brief=1", f"--gtest_output=xml:{results}"],
                              env=self.environment([self.library_folder], self.folder / "tmp"), cwd=self.folder,
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Broken("the unit tests fail without a mutant:\n" + done.stdout[-1000:] + done.stderr[-1000:])
        cases = xml.etree.ElementTree.parse(results).iter("testcase")
        return {(f"{case.get('classname')}.{case.get('name')}", re.sub(r"^.*\btest/", "", case.get("file"))):
                float(case.get("time")) for case in cases}

    def stages(self, file):
        """Tests in the order in which they are tried: of the same name, of the same folder, all others; quick ones first."""
        place = pathlib.Path(file).relative_to("src").with_suffix("")
        is_of_the_world = place.parts[1] in SEEN_BY_THE_WORLD
        stages = [[], [], [], []]
        for (test, test_file), seconds in self.seconds.items():
            if test_file.startswith("simulation/") and not is_of_the_world:
                continue
            if test_file == f"{place}_test.cpp":
                stage = 0
            elif seconds > QUICK_S:
                stage = 3
            else:
                stage = 1 if pathlib.Path(test_file).parent == place.parent else 2
            stages[stage].append((test, seconds))
        return [stage for stage in stages if stage]

    def compile(self, mutant, folder):
        """The object file with the mutant, or None."""
        original = self.root / mutant.file
        source = folder / original.name
        source.write_text(mutant.text((self.folder / mutant.file).read_text(encoding="utf-8")), encoding="utf-8")
        target = source.with_suffix(".cpp.o")
        command = [argument.replace(f"{self.root}/src", f"{self.folder}/src")
                   .replace(f"{self.root}/include", f"{self.folder}/include")
                   for argument in self.commands[str(original)]]
        command[command.index("-o") + 1] = str(target)
        command[command.index("-c") + 1] = str(source)
        done = subprocess.run([*self.launcher, *command], cwd=self.build, capture_output=True, check=False)
        return target if done.returncode == 0 else None

    def link(self, mutant, target):
        library_folder = target.parent / "lib"
        library_folder.mkdir()
        own = str(OBJECTS / mutant.file) + ".o"
        command = [str(target) if argument == own else
                   str(self.folder / argument) if argument.startswith(str(OBJECTS)) else argument
                   for argument in self.link_command]
        command[command.index("-o") + 1] = str(library_folder / LIBRARY)
        return subprocess.run(command, cwd=self.build, capture_output=True, check=False).returncode == 0

    def judge(self, folder, file):
        """The outcome, and the first test that failed."""
        environment = self.environment([folder / "lib", self.library_folder], folder / "tmp")
        for stage in self.stages(file):
            names = ":".join(test for test, _ in stage)
            patience_s = PATIENCE_S + PATIENCE_FACTOR * sum(seconds for _, seconds in stage)
            try:
                done = subprocess.run([*LIMITS, str(self.folder / TESTS), "--gtest_brief=1", "--gtest_fail_fast",
                                       f"--gtest_filter={names}"], env=environment, cwd=folder, capture_output=True,
                                      text=True, errors="replace", timeout=patience_s, check=False)
            except subprocess.TimeoutExpired:
                return TIMEOUT, ""
            if done.returncode != 0:
                failed = re.search(r"^\[  FAILED  \] ([\w./]+)", done.stdout, re.M)
                return KILLED, failed.group(1) if failed else f"status {done.returncode}"
        return SURVIVED, ""

    def examine(self, mutant):
        """Outcome, and which test noticed."""
        folder = self.folder / mutant.key[:16]
        folder.mkdir()
        try:
            target = self.compile(mutant, folder)
            if target is None:
                return NOT_COMPILED, ""
            if target.read_bytes() == (self.folder / OBJECTS / f"{mutant.file}.o").read_bytes():
                return SAME, ""
            return self.judge(folder, mutant.file) if self.link(mutant, target) else (NOT_COMPILED, "")
        finally:
            shutil.rmtree(folder, ignore_errors=True)
