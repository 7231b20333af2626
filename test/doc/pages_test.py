#!/usr/bin/python3
"""What the pages say is there: files, links, commands, parameters, topics, services, messages."""

import glob
import os
import re
import struct
import sys
import unittest

import yaml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import source_facts as facts  # noqa: E402
from source_facts import ROOT, read  # noqa: E402

FRONT_PAGES = ["README.md", "CONTRIBUTING.md"]
PAGES = FRONT_PAGES + sorted(os.path.relpath(page, ROOT) for page in glob.glob(os.path.join(ROOT, "doc", "*.md")))
FILE_ENDINGS = "h|cpp|md|yaml|txt|launch|rviz|urdf|xml|py|test|msg|srv"
LEAST_PICTURE_PIXELS = 500


def without_code_blocks(text):
    return re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)


def inline_code(text):
    return re.findall(r"`([^`\n]+)`", without_code_blocks(text))


def code_lines(text):
    """Lines of code blocks, fenced or indented, and inline code."""
    fenced = "\n".join(re.findall(r"^```[^\n]*\n(.*?)^```", text, flags=re.M | re.S))
    indented = re.findall(r"^    (\S.*)$", without_code_blocks(text), flags=re.M)
    return fenced.splitlines() + indented + inline_code(text)


def yaml_blocks(text):
    return [yaml.safe_load(block) for block in re.findall(r"^```yaml\n(.*?)^```", text, flags=re.M | re.S)]


def keys_of(tree, prefix=""):
    """Dotted keys of all blocks and fields; items of lists have the key of the list."""
    keys = set()
    for name, value in tree.items():
        key = prefix + str(name)
        keys.add(key)
        if isinstance(value, dict):
            keys |= keys_of(value, key + ".")
        elif isinstance(value, list):
            for item in value:
                keys |= keys_of(item, key + ".") if isinstance(item, dict) else set()
    return keys


def expand_braces(path):
    match = re.search(r"\{([^}]*)\}", path)
    if not match:
        return [path]
    return [path[: match.start()] + word + path[match.end():] for word in match.group(1).split(",")]


def anchors(text):
    """What headings are called in links, as GitHub does it."""
    headings = re.findall(r"^#+ (.*)$", without_code_blocks(text), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def tables(text):
    """Each Markdown table as a list of rows, each a list of cells, without the line under the header."""
    found = []
    for block in re.findall(r"(?:^\|.*\|\n)+", text + "\n", flags=re.M):
        rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in block.splitlines()]
        found.append([row for row in rows if not re.fullmatch(r"[-: ]*", "".join(row))])
    return found


class PagesTestCase(unittest.TestCase):
    def assert_in(self, what, known, where):
        """Like assertIn, with a message of one line."""
        self.assertTrue(what in known, f"{where}: {what}")


class FilesTest(PagesTestCase):
    def test_links_lead_somewhere(self):
        for page in PAGES:
            folder = os.path.join(ROOT, os.path.dirname(page))
            for target, anchor in re.findall(r"\]\(([^)#\s]*)(#[^)\s]+)?\)", read(page)):
                if "://" in target:
                    continue
                path = os.path.join(folder, target) if target else os.path.join(ROOT, page)
                self.assertTrue(os.path.exists(path), f"{page} links to {target}")
                if anchor:
                    self.assert_in(anchor[1:], anchors(read(os.path.relpath(path, ROOT))), f"{page} links to")

    def test_every_page_is_linked_from_the_readme(self):
        linked = set(re.findall(r"\]\((doc/[^)#]+\.md)", read("README.md")))
        self.assertEqual(linked, set(PAGES) - set(FRONT_PAGES))

    def test_pictures_are_pictures(self):
        shown = {os.path.normpath(os.path.join(os.path.dirname(page), picture))
                 for page in PAGES for picture in re.findall(r"!\[[^]]*\]\(([^)]+)\)", read(page))}
        self.assertIn("doc/pictures/rviz.png", shown)
        self.assertEqual(shown, {os.path.relpath(p, ROOT) for p in glob.glob(os.path.join(ROOT, "doc/pictures/*"))})
        for picture in shown:
            with open(os.path.join(ROOT, picture), "rb") as file:
                head = file.read(24)
            self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n", picture)
            self.assertGreater(min(struct.unpack(">II", head[16:24])), LEAST_PICTURE_PIXELS, picture)

    def test_files_that_are_named_are_there(self):
        pattern = re.compile(rf"[\w./*-]+(?:\{{[\w,*]+\}})?[\w*]*\.(?:{FILE_ENDINGS})")
        named = 0
        for page in PAGES:
            for code in inline_code(read(page)):
                if not pattern.fullmatch(code) or code in facts.FILES_OF_USERS:
                    continue
                for path in expand_braces(code):
                    self.assertTrue(facts.finds(path), f"{page} names {path}")
                    named += 1
        self.assertGreater(named, 50)

    def test_the_changelog_is_about_this_version(self):
        version = re.search(r"<version>(.*)</version>", read("package.xml")).group(1)
        self.assertRegex(read("CHANGELOG.rst"), rf"(?m)^(Forthcoming|{re.escape(version)} \(\d{{4}}-\d\d-\d\d\))\n---")


class CommandsTest(PagesTestCase):
    def test_commands_are_there(self):
        offered = facts.commands()
        for page in PAGES:
            for line in code_lines(read(page)):
                for name in re.findall(r"\./run ([a-z][\w-]*)", line):
                    self.assert_in(name, offered, f"{page}: {line}")

    def test_options_are_known_to_the_command(self):
        checked = 0
        for page in PAGES:
            for line in code_lines(read(page)):
                match = re.match(r"\s*(?:\./run|rosrun slipnav) ([a-z][\w-]*)([^#]*)", line)
                if not match or match.group(1) not in facts.commands():
                    continue
                for option in re.findall(r"--([a-z][\w-]*)", match.group(2)):
                    self.assert_in(option, facts.options_of(match.group(1)), f"{page}: {line}")
                    checked += 1
        self.assertGreater(checked, 30)

    def test_every_command_is_in_the_readme(self):
        for name in facts.commands():
            self.assert_in(f"./run {name}", read("README.md"), "README.md lacks")

    def test_rosrun_finds_one_program_of_each_name(self):
        """It looks for executable files in the whole package, and asks where there are several."""
        built = {os.path.splitext(os.path.basename(path))[0]
                 for path in glob.glob(os.path.join(ROOT, "src", "tools", "*.cpp"))}
        scripts = [path for path in glob.glob(os.path.join(ROOT, "scripts", "*")) if os.path.isfile(path)]
        self.assertTrue(built and scripts)
        for path in scripts:
            if os.path.basename(path) in built or path.endswith(".py"):  # the latter are installed
                self.assertFalse(os.access(path, os.X_OK), os.path.relpath(path, ROOT))

    def test_launch_arguments_are_declared(self):
        for page in PAGES:
            for line in code_lines(read(page)):
                match = re.match(r"\s*roslaunch slipnav (\w+\.launch)(.*)", line)
                if not match:
                    continue
                declared = re.findall(r'<arg name="(\w+)"(?: default="[^"]*")?/>', read(f"launch/{match.group(1)}"))
                for argument in re.findall(r"(\w+):=", match.group(2)):
                    self.assert_in(argument, declared, f"{page}: {line}")


class ParametersTest(PagesTestCase):
    def setUp(self):
        self.keys = keys_of(yaml.safe_load(read("config/default.yaml")))
        self.blocks = {key for key in self.keys if "." not in key}

    def test_keys_in_text_are_parameters(self):
        checked = 0
        for page in PAGES:
            for code in inline_code(read(page)):
                match = re.fullmatch(r"([a-z_]+(?:\[\])?(?:\.[a-z][\w/]*)+)(?:[:=] ?.*)?", code)
                key = match.group(1).replace("[]", "") if match else ""
                if key.split(".")[0] not in self.blocks or re.search(rf"\.({FILE_ENDINGS}|csv|tum|json|png)$", key):
                    continue
                self.assert_in(key, self.keys, f"{page}: {code}")
                checked += 1
        self.assertGreater(checked, 60)

    def test_examples_have_known_keys(self):
        for page in PAGES:
            for block in yaml_blocks(read(page)):
                self.assertEqual(keys_of(block) - self.keys, set(), page)

    def test_overrides_in_commands_are_parameters(self):
        for page in PAGES:
            for line in code_lines(read(page)):
                for key in re.findall(r"--set ([a-z_.\d]+)=", line):
                    self.assert_in(key, self.keys, f"{page}: {line}")


class TopicsTest(PagesTestCase):
    """doc/topics.md against the calls in the code."""

    def setUp(self):
        self.page = read("doc/topics.md")
        self.rows = {}
        for table in tables(self.page):
            if table[0][0] == "topic":
                columns = [table[0].index(name) for name in ("topic", "type", "published by", "read by")]
                for row in table[1:]:
                    name, kind, writers, readers = (row[column] for column in columns)
                    self.rows[name.strip("`")] = (kind, self.names(writers), self.names(readers))

    @staticmethod
    def names(cell):
        return {word.strip() for word in cell.split(",") if word.strip()}

    def test_topics_types_and_ends_are_those_of_the_code(self):
        wanted = facts.topics()
        self.assertEqual(set(self.rows), set(wanted))
        for name, (kind, writers, readers) in wanted.items():
            self.assertEqual(self.rows[name], (kind, writers, readers), name)

    def test_services_are_those_of_the_code(self):
        rows = next(table for table in tables(self.page) if table[0][0] == "service")[1:]
        self.assertEqual({row[0].strip("`") for row in rows}, facts.services())

    def test_parameters_name_every_nodelet_and_real_blocks(self):
        blocks = keys_of(yaml.safe_load(read("config/default.yaml")))
        rows = next(table for table in tables(self.page) if table[0][0] == "nodelet")[1:]
        self.assertEqual({row[0] for row in rows}, facts.nodelets())
        for row in rows:
            self.assertEqual(set(re.findall(r"`(\w+)`", row[1])) - blocks - {"all"}, set(), row[0])

    def test_every_message_is_named(self):
        for name in facts.messages():
            self.assert_in(f"slipnav/{name}", self.page, "doc/topics.md lacks")

    def test_fields_have_units(self):
        for path, line in facts.physical_fields():
            self.assertRegex(line, r"#.*\[[^\]]+\]", path)


class TroubleshootingTest(PagesTestCase):
    """doc/troubleshooting.md against what diagnostics and logs say."""

    def setUp(self):
        self.page = re.sub(r"\s+", " ", read("doc/troubleshooting.md"))

    def test_every_message_of_the_code_is_explained(self):
        texts = facts.diagnostic_texts()
        self.assertGreater(len(texts), 40)
        for text in sorted(texts):
            self.assert_in(text, self.page, "doc/troubleshooting.md lacks")

    def test_every_quoted_message_is_in_the_code(self):
        source = facts.all_literals()
        quoted = 0
        for table in tables(read("doc/troubleshooting.md")):
            if table[0][0] != "message":
                continue
            for row in table[1:]:
                for message in re.findall(r"`([^`]+)`", row[0]):
                    self.assertTrue(facts.is_said(message, source), message)
                    quoted += 1
        self.assertGreater(quoted, 40)


if __name__ == "__main__":
    unittest.main()
