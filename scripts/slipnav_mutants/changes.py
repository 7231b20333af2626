"""The changes that can be made to one line of code."""

import re

SWAPPED = [
    (r"(?<= )[-+*/](?= |$)", {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"]}),
    (r"(?<= )[-+*/]=(?= )", {"+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="]}),
    (r"(?<= )[<>]=?(?= |$)", {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"]}),
    (r"(?<= )[=!]=(?= |$)", {"==": ["!="], "!=": ["=="]}),
    (r"(?<= )(?:&&|\|\|)(?= |$)", {"&&": ["||"], "||": ["&&"]}),
    (r"\b(?:true|false)\b", {"true": ["false"], "false": ["true"]}),
    (r"(?<=std::)(?:min|max)(?=[(<])", {"min": ["max"], "max": ["min"]}),
]
DROPPED = [r"(?<=[(\[{])-(?=[\w(])", r"(?<=[=,?:*/<>] )-(?=[\w(])", r"(?<=return )-(?=[\w(])", r"(?<![\w=!])!(?=[\w(])"]
NUMBER = re.compile(r"(?<![\w.])(?:(?P<real>\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)|"
                    r"(?P<whole>\d+)(?P<suffix>U?L{0,2}))(?![\w.])")
REAL_FACTOR = 2.0
# A line of these alone can go: an assignment, a call, a step, the end of a loop.
REMOVABLE = re.compile(r"(?:\w.* [-+*/]?= .*|[\w.:>-]+\(.*\)[\w.()]*|(?:\+\+|--)\S+|break|continue);")
ASSIGNED = re.compile(r" [-+*/]?= ")
BRACKETS = re.compile(r"\([^()]*\)|\[[^\[\]]*\]")
FUNCTION = re.compile(r"^[A-Za-z\[][^;]*\(")
OF_A_FLAG = re.compile(r"^(?:\[\[\w+\]\] )?(?:static |inline |constexpr )*bool \w")


def numbers_instead(match):
    if match["real"]:
        value = float(match["real"])
        return [repr(value * REAL_FACTOR), repr(value / REAL_FACTOR)] if value else ["1.0"]
    value = int(match["whole"])
    return [f"{other}{match['suffix']}" for other in (value + 1, value - 1) if other >= 0]


def within(line):
    """(start, end, replacement) of what can be swapped, dropped or counted differently in a line of code."""
    for pattern, others in SWAPPED:
        for match in re.finditer(pattern, line):
            yield from ((*match.span(), other) for other in others[match.group()])
    for pattern in DROPPED:
        yield from ((*match.span(), "") for match in re.finditer(pattern, line))
    for match in NUMBER.finditer(line):
        yield from ((*match.span(), other) for other in numbers_instead(match))


def without_brackets(text):
    shorter = BRACKETS.sub("", text)
    return shorter if shorter == text else without_brackets(shorter)


def is_removable(lines, number):
    """Whether a line is one whole statement, and no declaration."""
    statement = lines[number].strip()
    before = "".join(lines[:number]).rstrip()
    bare = without_brackets(statement)
    return (before.endswith((";", "{", "}", ":")) and not re.search(r"[()\[\]{}]", bare) and
            REMOVABLE.fullmatch(statement) is not None and " " not in ASSIGNED.split(bare)[0])


def returns_a_flag(lines, number):
    opened = next((line for line in reversed(lines[:number]) if FUNCTION.match(line)), "")
    return OF_A_FLAG.match(opened) is not None


def changes(lines, number):
    """(start, end, replacement) of all changes to one of the lines of code_of()."""
    line = lines[number]
    found = list(within(line))
    start, end = len(line) - len(line.lstrip()), len(line.rstrip())
    if is_removable(lines, number):
        found.append((start, end, ";"))
    returned = re.fullmatch(r"\s+return (?!true;|false;)(.+);", line.rstrip())
    if returned and returns_a_flag(lines, number):
        found.append((*returned.span(1), "!({})"))
    return found
