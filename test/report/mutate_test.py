#!/usr/bin/python3
"""Mutants of the core are drawn the same every time, from code alone, and tried and counted correctly."""

import collections
import json
import os
import pathlib
import random
import re
import sys
import tempfile
import threading
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from slipnav_mutants.campaign import Campaign, report  # noqa: E402
from slipnav_mutants.changes import changes  # noqa: E402
from slipnav_mutants.code import code_of  # noqa: E402
from slipnav_mutants.draw import changed, draw, mutants_of_text  # noqa: E402
from slipnav_mutants.workshop import (  # noqa: E402
    KILLED, LIBRARY, NOT_COMPILED, OBJECTS, SAME, SURVIVED, TESTS, TIMEOUT, Broken, Workshop)

UNTOUCHED = '''#include "1.h"
#define TWO (1 + 1)
namespace slipnav {
// 1 + 1, true && false
/* return -1;
   a = b + 2; */
constexpr char kComma = ',';
const char* const kText = "a < b \\" + 1.5 && true";
using Pair = std::array<double, 2>;
[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("checkpoint " + what + std::to_string(1 + 2));
}
void Params::visit(ParameterVisitor& v) {
  v.number("length_m", length_m, {0.1, 1e6}, "over which it is forgotten [m]");
  v.flag("is_fast", is_fast && true);
}
static_assert(kSize < 3, "");
void check(double a) {
  assert(a > 0.0);
  values.reserve(2 * size);
  refuse("is " + format(10.0 * a) +
         " m long");
}
'''


def all_changes(text):
    """Each line with each of its changes."""
    lines, code = text.split("\n"), code_of(text).split("\n")
    return [changed(line, change).strip() for number, line in enumerate(lines) for change in changes(code, number)]


class ChangesTest(unittest.TestCase):
    def test_comments_texts_and_checks_stay(self):
        self.assertEqual(all_changes(UNTOUCHED), [])
        self.assertEqual(len(code_of(UNTOUCHED)), len(UNTOUCHED))

    def test_operators_are_swapped(self):
        self.assertEqual(set(all_changes("x(a + b, c - d, e * f, g / h);")),
                         {"x(a - b, c - d, e * f, g / h);", "x(a + b, c + d, e * f, g / h);",
                          "x(a + b, c - d, e / f, g / h);", "x(a + b, c - d, e * f, g * h);"})
        self.assertEqual(set(all_changes("if (a < b || c == d) {")),
                         {"if (a <= b || c == d) {", "if (a >= b || c == d) {", "if (a < b && c == d) {",
                          "if (a < b || c != d) {"})
        self.assertEqual(all_changes("auto x = std::max(a, b);"), ["auto x = std::min(a, b);"])
        self.assertEqual(all_changes("const bool x = true;"), ["const bool x = false;"])

    def test_constants_change_by_a_factor_or_one(self):
        self.assertEqual(all_changes("constexpr double kA = 1.5e-3;"),
                         ["constexpr double kA = 0.003;", "constexpr double kA = 0.00075;"])
        self.assertEqual(all_changes("double a = 0.0;"), ["double a = 1.0;"])
        self.assertEqual(all_changes("int n = 4;"), ["int n = 5;", "int n = 3;"])
        self.assertEqual(all_changes("std::size_t n = 0U;"), ["std::size_t n = 1U;"])
        self.assertEqual(all_changes("Vector3 v_2 = m.head<3>();"), [])

    def test_a_minus_or_a_not_is_dropped(self):
        self.assertEqual(all_changes("const double a = -b;"), ["const double a = b;"])
        self.assertEqual(all_changes("return -(a);"), ["return (a);"])
        self.assertEqual(all_changes("if (!found) {"), ["if (found) {"])

    def test_a_statement_is_removed_but_no_declaration(self):
        for statement in ("reset();", "a.b(c)->d(e);", "a = b;", "a[i] = b;", "m.head<3>(kA).x() = b;",
                          "P.block(i, j) += x;", "++n;", "break;"):
            self.assertIn(";", all_changes("void f() {\n  " + statement + "\n}"), statement)
        for other in ("const double a = b;", "Lines lines(text);", "return a;", "double a;", "std::vector<int> a = b;"):
            self.assertNotIn(";", all_changes("void f() {\n  " + other + "\n}"), other)
        self.assertNotIn(";", all_changes("void f() {\n  const double a =\n      g(b);\n}"), "not the end of one")

    def test_a_returned_flag_is_inverted(self):
        self.assertEqual(all_changes("bool f() {\n  return found_;\n}"), ["return !(found_);"])
        self.assertEqual(all_changes("int f() {\n  return found_;\n}"), [])


class DrawTest(unittest.TestCase):
    def test_it_is_always_the_same(self):
        self.assertEqual(draw(ROOT, 3), draw(ROOT, 3))
        self.assertNotEqual(draw(ROOT, 3)[:20], draw(ROOT, 4)[:20])

    def test_only_one_line_of_code_changes(self):
        for mutant in draw(ROOT, 1)[:300]:
            original = (ROOT / mutant.file).read_text(encoding="utf-8")
            before, after = original.split("\n"), mutant.text(original).split("\n")
            self.assertEqual([i for i, (a, b) in enumerate(zip(before, after)) if a != b], [mutant.line - 1])
            comment = re.search("//.*", mutant.before)
            self.assertTrue(comment is None or mutant.after.endswith(comment.group()), mutant)

    def test_only_the_named_places(self):
        places = ["src/core/slip", "src/core/ins/strapdown.cpp"]
        self.assertEqual({mutant.file for mutant in draw(ROOT, 1, places)},
                         {"src/core/slip/vehicle_slip.cpp", "src/core/ins/strapdown.cpp"})

    def test_other_lines_do_not_matter(self):
        text = "void f() {\n  a = b + 1;\n  c = d * 2.0;\n}\n"
        drawn = {mutant.after for mutant in mutants_of_text("a.cpp", text, 1)}
        longer = {mutant.after for mutant in mutants_of_text("a.cpp", "int x = 1;\n" + text + "int y = 2;\n", 1)}
        self.assertEqual(drawn, drawn & longer)
        self.assertEqual(len(longer - drawn), 2)


class CampaignTest(unittest.TestCase):
    OUTCOMES = [KILLED, NOT_COMPILED, SURVIVED, KILLED, SAME, NOT_COMPILED, TIMEOUT, KILLED, KILLED]

    def run_with(self, jobs, count=5):
        delays = random.Random(jobs)

        def examine(mutant):
            time.sleep(0.01 * delays.random())
            return self.OUTCOMES[mutant], ""

        return Campaign(range(len(self.OUTCOMES)), count, examine, lambda *_: None).run(jobs)

    def test_jobs_do_not_change_which_mutants_count(self):
        for jobs in (1, 2, 5, 16):
            campaign = self.run_with(jobs)
            self.assertEqual([result.mutant for result in campaign.results], list(range(8)), jobs)
            self.assertEqual([result.mutant for result in campaign.tested()], [0, 2, 3, 6, 7], jobs)

    def test_rate_and_survivors_are_reported(self):
        text, is_enough = report(self.run_with(2), 80.0)
        self.assertTrue(is_enough)
        self.assertEqual(text.splitlines(), [
            "survived: 2", "4 of 5 mutants noticed (80.0 %), 1 of them because the tests did not end; "
            "skipped: 2 that do not compile, 1 that change no code"])
        self.assertFalse(report(self.run_with(2), 80.1)[1])
        self.assertFalse(report(Campaign([], 5, None, None).run(2), 1.0)[1], "nothing was tried")

    def test_it_ends_when_there_are_no_more(self):
        self.assertEqual(len(self.run_with(3, count=100).results), len(self.OUTCOMES))

    def test_an_error_ends_it(self):
        started = threading.Barrier(2)

        def examine(mutant):
            started.wait(5.0)
            if mutant == 0:
                raise OSError("no space left")
            return KILLED, ""

        with self.assertRaisesRegex(OSError, "no space"):
            Campaign(range(1000), 2, examine, lambda *_: None).run(2)


# A project of one function, whose tests take it as a library and are a program with the options of gtest.
CORE = '''extern "C" int limited(int a) {
  int unused = 7;
  if (a > 9) {
    return 10;
  }
  for (int i = 0; i < 3; ++i) {
    unused = i;
  }
  return a;
}
'''
PROGRAM = f'''#!/usr/bin/python3
import ctypes, sys
limited = ctypes.CDLL("{LIBRARY}").limited
options = dict(argument.split("=", 1) for argument in sys.argv if "=" in argument)
tests = {{"Limit.Holds": limited(20) == 10, "Limit.LeavesTheRest": limited(5) == 5}}
if "--gtest_output" in options:
    open(options["--gtest_output"][4:], "w").write("<testsuites>" + "".join(
        f'<testcase classname="Limit" name="{{name[6:]}}" time="0.01" file="../test/core/limit_test.cpp"/>'
        for name in tests) + "</testsuites>")
chosen = options.get("--gtest_filter", ":".join(tests)).split(":")
failed = [name for name in chosen if not tests[name]]
print("".join(f"[  FAILED  ] {{name}} (0 ms)\\n" for name in failed), end="")
sys.exit(1 if failed else 0)
'''


class WorkshopTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.build = self.root / "build"
        source = self.root / "src/core/limit.cpp"
        own_object = OBJECTS / "src/core/limit.cpp.o"
        library = f"devel/lib/{LIBRARY}"
        for path in (source, self.build / own_object, self.build / "devel/lib/slipnav" / TESTS):
            path.parent.mkdir(parents=True)
        (self.root / "include").mkdir()
        source.write_text(CORE, encoding="utf-8")
        compile_command = f"c++ -O2 -fPIC -I{self.root}/src -o {own_object} -c {source}"
        link_command = f"c++ -shared -o {library} {own_object}"
        (self.build / "compile_commands.json").write_text(json.dumps([{"file": str(source), "command": compile_command}]))
        (self.build / OBJECTS / "link.txt").write_text(link_command)
        for command in (compile_command, link_command):
            self.assertEqual(os.system(f"cd {self.build} && {command}"), 0)
        self.program = self.build / "devel/lib/slipnav" / TESTS
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)

    def outcomes(self):
        """{line after: outcome}, of all that can be changed."""
        workshop = Workshop(self.root, self.build, self.build / "mutants")
        mutants = [mutant for seed in range(40) for mutant in draw(self.root, seed)]
        unique = {mutant.after: mutant for mutant in mutants}
        return {after.strip(): workshop.examine(mutant) for after, mutant in unique.items()}

    def test_what_becomes_of_each_mutant(self):
        outcomes = self.outcomes()
        self.assertEqual(outcomes["return 11;"], (KILLED, "Limit.Holds"))
        self.assertEqual(outcomes["if (a <= 9) {"], (KILLED, "Limit.Holds"))
        self.assertEqual(outcomes["if (a >= 9) {"], (SURVIVED, ""))
        self.assertEqual(outcomes["if (a > 8) {"][0], SURVIVED)
        self.assertEqual(outcomes["int unused = 8;"], (SAME, ""))
        counts = collections.Counter(outcome for outcome, _ in outcomes.values())
        self.assertGreaterEqual(counts[SURVIVED], 2)
        self.assertEqual((self.root / "src/core/limit.cpp").read_text(encoding="utf-8"), CORE, "never touched")
        self.assertEqual(sorted(path.name for path in (self.build / "mutants").iterdir()),
                         sorted(["CMakeFiles", "include", "lib", "src", "tests.xml", "tmp", TESTS]), "nothing left behind")

    def test_tests_that_fail_without_a_mutant_are_refused(self):
        self.program.write_text(PROGRAM.replace("== 10", "== 12"))
        with self.assertRaisesRegex(Broken, "Limit.Holds"):
            Workshop(self.root, self.build, self.build / "mutants")


if __name__ == "__main__":
    unittest.main()
