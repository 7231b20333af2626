"""Draws mutants: at most one of each line, in an order that depends on the seed and on that line alone."""

import collections
import hashlib
import pathlib

from .changes import changes
from .code import code_of

CORE = pathlib.Path("src/core")


class Mutant(collections.namedtuple("Mutant", "key file line before after")):
    """`file` relative to the project, `line` from 1; `before` and `after` are the whole line."""

    def __str__(self):
        return f"{self.file}:{self.line}: {self.before.strip()}  →  {self.after.strip()}"

    def text(self, original):
        lines = original.split("\n")
        lines[self.line - 1] = self.after
        return "\n".join(lines)


def changed(line, change):
    start, end, replacement = change
    return line[:start] + replacement.replace("{}", line[start:end]) + line[end:]


def mutants_of_text(file, text, seed):
    """One mutant of each line that can be changed. Changes elsewhere do not change which."""
    lines, code = text.split("\n"), code_of(text).split("\n")
    seen = collections.Counter()
    for number, line in enumerate(lines):
        seen[line] += 1
        possible = changes(code, number)
        if possible:
            key = hashlib.sha256(f"{seed} {file} {seen[line]} {line}".encode()).hexdigest()
            yield Mutant(key, str(file), number + 1, line, changed(line, possible[int(key, 16) % len(possible)]))


def draw(root, seed, only=()):
    """All mutants of the core in the order in which they are tried. @param only files or folders, relative to `root`"""
    found = []
    for path in sorted((root / CORE).rglob("*.cpp")):
        file = path.relative_to(root)
        if not only or any(place == file or place in file.parents for place in map(pathlib.Path, only)):
            found += mutants_of_text(file, path.read_text(encoding="utf-8"), seed)
    return sorted(found)
