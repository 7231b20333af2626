"""A C++ source file, with everything blanked that is not to be changed: positions stay as they are."""

import re

# Comments, texts, characters, preprocessor lines.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#[^\n]*',
                      re.M | re.S)
TEMPLATE_ARGUMENTS = re.compile(r"(?<=\w)<(?:[^<>;(){}]|<[^<>;(){}]*>)*>")
# Statements that a test need not notice: they check, say in words what is wrong, or make room in advance.
UNTOUCHED_STATEMENT = r"\b(?:throw|static_assert|assert|eigen_assert|reserve|using|namespace|template{never_return})\b"
NEVER_RETURNS = re.compile(r"\[\[noreturn\]\][^;{(]*?(\w+)\(")
# What describes parameters: their ranges and meanings.
DESCRIPTION = re.compile(r"^(?:\w+ )+[\w:]*\bvisit\([^;{]*\{\n.*?^\}", re.M | re.S)


def blank(text, start, end):
    return text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]


def blank_matches(pattern, text, blank_by=" "):
    return pattern.sub(lambda match: re.sub(r"[^\n]", blank_by, match.group()), text)


def without_untouched_statements(text):
    never_return = "".join(f"|{name}" for name in sorted(set(NEVER_RETURNS.findall(text))))
    for match in re.finditer(UNTOUCHED_STATEMENT.format(never_return=never_return), text):
        begin = max(text.rfind(mark, 0, match.start()) for mark in ";{}") + 1
        ends = [place for place in (text.find(mark, match.end()) for mark in ";{") if place >= 0]
        text = blank(text, begin, min(ends, default=len(text)))
    return text


def code_of(text):
    """`text` of the same length, in which only what may be changed is left."""
    text = blank_matches(NOT_CODE, text)
    text = blank_matches(DESCRIPTION, text)
    text = without_untouched_statements(text)
    return blank_matches(TEMPLATE_ARGUMENTS, text, blank_by="_")  # `head<3>(` remains one name
