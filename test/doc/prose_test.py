#!/usr/bin/python3
"""Pages, comments and messages are in plain American English: no words typical of translations, no British spelling."""

import glob
import io
import os
import re
import sys
import tokenize
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from source_facts import ROOT, read  # noqa: E402

# What to say instead, by pattern.
BANNED = {
    r"anew": "again, from scratch, re-",
    r"work(?:s|ed|ing)? off": "process",
    r"mend(?:s|ed|ing)?": "fix, repair",
    r"shall": "must, is to",
    r"the begin (?:of|on)|from begin to": "start",
    r"(?<!there )(?:is|are|was|were) (?-i:none)": "is not one",
    r"for want of": "because ... is missing",
    r"in the place of": "instead of",
    r"left out|leaves? out(?! of)|leaving out": "skipped, rejected, omitted",
    r"goes on(?! and on)|went on|going on": "continues, resumes",
    r"beg[iau]ns? again": "restarts",
    r"who wants|to whom": "if you want",
    r"not \w+(?: \w+)? any more|nothing any more": "no longer",
    r"so many|so much (?:of|is|later)|so long ahead": "this many, this much",
    r"very (?:same|own)": "exactly the same, own",
    r"laid over|laid on the": "aligned with, fitted to",
}
# American by ending; stems that take any ending.
BRITISH_ENDINGS = ("initialis localis normalis linearis recognis synchronis serialis quantis factoris finalis "
                   "visualis summaris organis minimis maximis neighbour colour behaviour favour").split()
BRITISH_WORDS = (r"mechanis(?:e|ed|es|ing|ations?)", r"optimis(?:e|ed|er|ing|ation)", r"realis(?:e|ed|es)",
                 r"analys(?:e|ed|er|ing)", r"(?:lev|mod|trav|lab)ell(?:ed|ing)", r"(?:centi|milli|kilo|micro)?metres?",
                 r"centr(?:e|es|ed|ing)", r"grey", r"licence", r"artefacts?", r"catalogues?")
BRITISH = "|".join([rf"(?:re|un|de)?{stem}[a-z]*" for stem in BRITISH_ENDINGS] + list(BRITISH_WORDS))

RULES = [(re.compile(rf"\b(?:{pattern})\b", re.I), f"say: {better}") for pattern, better in BANNED.items()]
RULES.append((re.compile(rf"\b(?:{BRITISH})\b", re.I), "US spelling"))

# What must stay: the name of a random stream, which seeds it, and the terms of a license.
EXEMPT_TEXTS = {"turn centre"}
LICENSE = "Permission is hereby granted"
# Code and names in prose: in quotes for code, paths, files, placeholders.
NAMES = re.compile(r"``[^`]+``|`[^`]*`|\w+(?:/\w+)+|[\w/]+\.(?:h|cpp|md|py)\b|\{[^{}]*\}")


def complaints_about(line):
    """(word, advice) of each rule that a line of prose breaks. Identifiers in camel case are code."""
    return [(match.group(0), advice) for rule, advice in RULES for match in rule.finditer(NAMES.sub("", line))
            if match.group(0)[1:].islower() or match.group(0).isupper()]


def files(*patterns):
    found = {path for pattern in patterns for path in glob.glob(os.path.join(ROOT, pattern), recursive=True)}
    own = os.path.join(ROOT, "test", "doc", os.path.basename(__file__))
    return sorted(os.path.relpath(path, ROOT) for path in found if os.path.isfile(path) and path != own)


def blank(match):
    """As many lines as before."""
    return "\n" * match.group(0).count("\n")


def prose_of_page(text):
    """Without code blocks and the targets of links."""
    text = re.sub(r"^```.*?^```", blank, text, flags=re.M | re.S)
    text = re.sub(r"^    \S.*$", "", text, flags=re.M)
    return enumerate(re.sub(r"\]\([^)]*\)", "]", text).splitlines(), 1)


def prose_of_cpp(text):
    """Comments, and string literals of more than one word."""
    literal = r'"((?:[^"\\]|\\.)*)"'
    for number, line in enumerate(text.splitlines(), 1):
        comment = re.search(r"(?:^|[\s;{},)])//+<?\s?(.*)$", re.sub(literal, "", line))
        for words in re.findall(literal, line) + ([comment.group(1)] if comment else []):
            if " " in words and words not in EXEMPT_TEXTS and not line.lstrip().startswith("#include"):
                yield number, words


def prose_of_python(text):
    """Comments, and strings of more than one word."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in (tokenize.COMMENT, tokenize.STRING) and " " in token.string and LICENSE not in token.string:
            yield from enumerate(token.string.splitlines(), token.start[0])


def prose_of_comments(text):
    for number, line in enumerate(text.splitlines(), 1):
        match = re.search(r"(?:^|\s)#\s?(.*)$", line)
        if match:
            yield number, match.group(1)


def all_lines(text):
    return enumerate(text.splitlines(), 1)


SOURCES = [
    (prose_of_page, files("*.md", "CHANGELOG.rst", "doc/*.md")),
    (prose_of_cpp, files("include/**/*.h", "src/**/*.h", "src/**/*.cpp", "test/**/*.h", "test/**/*.cpp",
                         "examples/**/*.cpp")),
    (prose_of_python, files("scripts/**/*.py", "test/**/*.py")),
    (prose_of_comments, files("msg/*.msg", "srv/*.srv", "config/**/*.yaml", "CMakeLists.txt", "cmake/*.cmake")),
    (all_lines, [path for path in files("run", "scripts/*", "launch/*") if not path.endswith(".py")]),
]


class ProseTest(unittest.TestCase):
    def test_words_are_plain_american_english(self):
        found = [f"{path}:{number}: '{word}': {advice}" for prose, paths in SOURCES for path in paths
                 for number, line in prose(read(path)) for word, advice in complaints_about(line)]
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_every_rule_finds_its_words(self):
        for line in ("begins anew", "is worked off", "it was mended", "the rover shall stop", "from the begin of it",
                     "is none.", "for want of truth", "in the place of it", "left out", "it goes on", "has begun again",
                     "who wants it may", "not there any more", "so many of them", "the very same", "laid over it",
                     "the initialiser", "two metres", "Colours", "levelled"):
            self.assertNotEqual(complaints_about(line), [], line)

    def test_code_is_not_prose(self):
        for line in ("`anew`", "turn_centre_m", "normalisedInnovation()", "core/ins/levelling.h", "there are none"):
            self.assertEqual(complaints_about(line), [], line)

    def test_comments_and_messages_are_seen(self):
        self.assertEqual(list(prose_of_cpp('f("a b", x);  // c d\n')), [(1, "a b"), (1, "c d")])
        self.assertEqual(list(prose_of_python('x = "a b"  # c d\n')), [(1, '"a b"'), (1, "# c d")])
        self.assertEqual(list(prose_of_comments("int8 x  # a b\n")), [(1, "a b")])


if __name__ == "__main__":
    unittest.main()
