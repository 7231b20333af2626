"""The routes of doc/architecture.md, checked against the code."""

import collections
import functools
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = "doc/architecture.md"
FUNCTION = r"(?:(\w+)::)?(\w+)"
# Called by the library of nodelets.
ENTRIES = ["onInit"]

Step = collections.namedtuple("Step", "file functions")


@functools.lru_cache(maxsize=None)
def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def routes():
    """{title: steps}"""
    found = {}
    for title, text in re.findall(r"^### Route \d: ([^\n]*)\n(.*?)(?=^##)", read(PAGE), re.M | re.S):
        found[title] = []
        for item in re.findall(r"^\d+\. (.*?)(?=^\d+\. |^$)", text, re.M | re.S):
            path, names = re.match(r"`([\w/.]+)`", item).group(1), re.findall(rf"`{FUNCTION}`", item)
            found[title].append(Step(path, [name for name in names if is_function(path, *name)]))
    return found


def is_function(path, owner, name):
    """Other words in backticks are topics, keys and classes."""
    if not path.endswith((".cpp", ".h")):
        return False
    return bool(owner) or re.search(rf"^[\w:<>&\s]+\b{name}\(", read(path), re.M) is not None


@functools.lru_cache(maxsize=None)
def bodies(path, owner, name):
    """The bodies of all overloads of a function that are defined in a file."""
    text = read(path)
    pattern = rf"\b{owner}::{name}\(" if owner else rf"^[\w:<>&*\s]+\b{name}\("
    if owner and re.search(rf"^class {owner}\b[^;]*?{{", text, re.M):
        pattern = rf"(?:\b{owner}::|^  [\w:<>&*\s]*?\b){name}\("
    found = []
    for match in re.finditer(pattern, text, re.M):
        opened = text.find("{", match.end())
        declared = text.find(";", match.end())
        if opened < 0 or 0 <= declared < opened:
            continue
        depth, end = 0, opened
        while end < len(text):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            if depth == 0:
                break
            end += 1
        found.append(text[opened:end + 1])
    return found


@functools.lru_cache(maxsize=None)
def header_of(path):
    """The text of a file and of the header next to it, or of the public one."""
    texts = [read(path)]
    base = os.path.splitext(path)[0]
    for header in (base + ".h", base.replace("src/", "include/slipnav/", 1) + ".h"):
        if header != path and os.path.exists(os.path.join(ROOT, header)):
            texts.append(read(header))
    return "\n".join(texts)


def is_called(owner, name, caller_file, caller_owner, body):
    """Whether a body calls a function: of its own class, of a member that is declared as one of the other, or free."""
    if not owner or owner == caller_owner:
        return re.search(rf"(?<![\w.>]){name}[(<]", body) is not None
    if re.search(rf"\b{owner}::{name}[(<]", body):
        return True
    declared = header_of(caller_file)
    for receiver in re.findall(rf"(\w+)(?:\(\))?(?:->|\.){name}[(<]", body):
        of_class = re.search(rf"\b{owner}\b[^;\n]*[>&\s]{receiver}\b", declared)
        of_any = re.search(rf"\bauto&? {receiver}\b", body) and owner in declared
        if of_class or of_any:
            return True
    return False


def hears(owner, name, file, caller_file, body):
    """Whether a function handles messages of a type that a body publishes."""
    handled = re.search(rf"listen<(?:\w+::)?(\w+)>\([^;]*&{owner}::{name}\)", read(file))
    if not handled:
        return False
    members = re.findall(r"(\w+)\.publish\(", body)
    declared = header_of(caller_file)
    return any(re.search(rf"SharedPublisher<(?:\w+::)?{handled.group(1)}> {member}\b", declared) for member in members)


@functools.lru_cache(maxsize=None)
def bases_of(owner, file):
    """The class that another one derives from, if it does."""
    return re.findall(rf"class {owner} (?:final )?: public (\w+)", header_of(file)) if owner else []


def overrides(owner, name, file, caller_owner, body):
    """Whether a body calls a function of the base class that this one implements."""
    return caller_owner in bases_of(owner, file) and re.search(rf"(?<![\w.>]){name}\(", body) is not None


def is_reached(owner, name, file, other, body):
    """Whether a body calls a function, also by an interface that its class implements, or is heard by it."""
    names = [owner, *bases_of(owner, file)]
    return (any(is_called(known_as, name, *other[:2], body) for known_as in names) or
            hears(owner, name, file, other[0], body) or overrides(owner, name, file, other[1], body) or
            visits(name, body))


def visits(name, body):
    """A block of parameters is described once, to whoever visits it."""
    return name == "visit" and re.search(r"\.visit\(", body) is not None


def takes_a_block_of(chain, file, name):
    """Whether a function takes a block of parameters that is on the route."""
    blocks = [owner for _, owner, other in chain if other == "visit"]
    return any(re.search(rf"\b{name}\(const {block}&", read(file)) for block in blocks)


def flaws(steps):
    """What is wrong with a route, one line each."""
    wrong = []
    chain = [(step.file, owner, name) for step in steps for owner, name in step.functions]
    for file, owner, name in chain:
        if not bodies(file, owner, name):
            wrong.append(f"{file} does not define {owner + '::' if owner else ''}{name}")
    for place, (file, owner, name) in enumerate(chain):
        others = [other for other in chain if other != (file, owner, name)]
        reached = place == 0 or name in ENTRIES or takes_a_block_of(chain, file, name) or any(
            is_reached(owner, name, file, other, body)
            for other in others for body in bodies(*other))
        if not reached:
            wrong.append(f"nothing on the route calls {owner + '::' if owner else ''}{name} of {file}")
    return wrong


def files(steps):
    return sorted({step.file for step in steps})
