#!/usr/bin/python3
"""Pages, comments and messages are in plain American English: words that give away a translation, and British spellings."""

import ast
import glob
import io
import os
import re
import sys
import tokenize
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

BANNED = {
    r"anew": "again, from scratch; restart, reload",
    r"work(?:s|ed|ing)? off": "process",
    r"mend(?:s|ed|ing)?": "fix, repair",
    r"shall": "must, is to",
    r"the begin (?:of|on)|from begin to": "the start",
    r"(?<!there )(?:is|are|was|were) (?-i:none)": "is not one",
    r"for want of": "because ... is missing",
    r"in the place of": "instead of",
    r"left out|leaves? out(?! of)|leaving out": "skipped, rejected, omitted",
    r"goes on(?! and on)|went on|going on": "continues, resumes",
    r"beg[iau]ns? (?:again|anew)": "restarts",
    r"who wants|to whom": "if you want",
    r"not \w+(?: \w+)? any more|nothing any more": "no longer",
    r"so long ahead|so many|so much (?:of|is|later)": "this many, this much",
    r"very (?:same|own)": "same, own",
    r"laid over|laid on the": "aligned with",
}
BRITISH = [
    r"(?:re)?initialis(?-i:[a-z]*)", r"behaviours?", r"colour(?-i:[a-z]*)", r"mechanis(?:e|ed|es|ing|ation|ations)", r"levell(?:ed|ing)",
    r"(?:centi|milli|kilo|micro)?metres?", r"centr(?:e|es|ed|ing)", r"neighbour(?-i:[a-z]*)", r"(?:un)?normalis(?-i:[a-z]*)", r"linearis(?-i:[a-z]*)",
    r"(?:de)?localis(?-i:[a-z]*)", r"recognis(?-i:[a-z]*)", r"synchronis(?-i:[a-z]*)", r"(?:de)?serialis(?-i:[a-z]*)", r"quantis(?-i:[a-z]*)", r"optimis(?:e|ed|er|es|ing|ation)",
    r"factoris(?-i:[a-z]*)", r"finalis(?-i:[a-z]*)", r"visualis(?-i:[a-z]*)", r"summaris(?-i:[a-z]*)", r"organis(?-i:[a-z]*)", r"minimis(?-i:[a-z]*)", r"maximis(?-i:[a-z]*)", r"realis(?:e|ed|es)",
    r"analys(?:e|ed|er|es|ing)(?! of)", r"grey", r"licen[c]e", r"modell(?:ed|ing)", r"travell(?:ed|ing)", r"labell(?:ed|ing)",
    r"favour(?-i:[a-z]*)", r"artefacts?", r"catalogues?",
]
RULES = [(re.compile(rf"\b(?:{words})\b", re.I), f"say: {better}") for words, better in BANNED.items()]
RULES.append((re.compile(rf"\b(?:{'|'.join(BRITISH)})\b", re.I), "US spelling"))
# Text that must stay: names of random streams, which seed them, and what the words themselves are checked with.
EXEMPT_FILES = {"test/doc/prose_test.py"}
EXEMPT_TEXTS = {"turn centre"}
LICENSE = "Permission is hereby granted"


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def files(*patterns):
    found = {path for pattern in patterns for path in glob.glob(os.path.join(ROOT, pattern), recursive=True)}
    return sorted(os.path.relpath(path, ROOT) for path in found if os.path.isfile(path))


def blank(match):
    """As many lines as before, so that line numbers stay."""
    return "\n" * match.group(0).count("\n")


def prose_of_page(text):
    """Without code, links' targets and file names."""
    text = re.sub(r"^```.*?^```", blank, text, flags=re.M | re.S)
    text = re.sub(r"^    \S.*$", "", text, flags=re.M)
    text = re.sub(r"``[^`]+``|`[^`\n]+`", "", text)
    return list(enumerate(re.sub(r"\]\([^)]*\)", "]", text).splitlines(), 1))


def prose_of_cpp(text):
    """Comments and the strings of messages; file names and quoted code in them left aside."""
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("#include"):
            continue
        strings = re.findall(r'"((?:[^"\\]|\\.)*)"', line)
        comment = re.search(r"(?:^|[\s;{},)])//+<?\s?(.*)$", re.sub(r'"(?:[^"\\]|\\.)*"', "", line))
        words = [text for text in strings if " " in text and text not in EXEMPT_TEXTS]
        lines += [(number, re.sub(r"`[^`]*`|\w+/\w+|[\w/]+\.(?:h|cpp|md|py)\b", "", words)) for words in
                  words + ([comment.group(1)] if comment else [])]
    return lines


def prose_of_python(text):
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    found = []
    for token in tokens:
        if token.type in (tokenize.COMMENT, tokenize.STRING) and " " in token.string and LICENSE not in token.string:
            value = token.string
            found += [(token.start[0] + i, line) for i, line in enumerate(value.splitlines())]
    return [(number, re.sub(r"`[^`]*`|\{[^{}]*\}|[\w/]+\.(?:h|cpp|md|py)\b", "", line)) for number, line in found]


def prose_of_comments(mark):
    def prose(text):
        return [(number, match.group(1)) for number, line in enumerate(text.splitlines(), 1)
                for match in [re.search(rf"(?:^|\s){mark}\s?(.*)$", line)] if match]
    return prose


SOURCES = [
    (prose_of_page, files("*.md", "CHANGELOG.rst", "doc/*.md")),
    (prose_of_cpp, files("include/**/*.h", "src/**/*.h", "src/**/*.cpp", "test/**/*.h", "test/**/*.cpp", "examples/**/*.cpp")),
    (prose_of_python, files("scripts/**/*.py", "test/**/*.py", "setup/**/*.py")),
    (prose_of_comments("#"), files("msg/*.msg", "srv/*.srv", "config/**/*.yaml", "scripts/*", "run", "CMakeLists.txt",
                                   "cmake/*.cmake")),
]


class ProseTest(unittest.TestCase):
    def test_words_are_plain_english(self):
        complaints = []
        for prose, paths in SOURCES:
            for path in paths:
                if path in EXEMPT_FILES or (prose is not prose_of_python and path.endswith(".py")):
                    continue
                for number, line in prose(read(path)):
                    complaints += [f"{path}:{number}: '{match.group(0)}': {advice}" for rule, advice in RULES
                                   for match in rule.finditer(line)]
        self.assertEqual(complaints, [], "\n" + "\n".join(complaints))


if __name__ == "__main__":
    unittest.main()
