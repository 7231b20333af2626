"""A table that is readable as text and as Markdown, and the limits broken in it."""


def number(value, digits=2):
    """This many decimals, fewer for large numbers; a dash where there is none."""
    if value is None or value != value:
        return "-"
    if abs(value) >= 1000:
        return f"{value:.0f}"
    return f"{value:.{1 if abs(value) >= 100 else digits}f}"


def markdown(heads, rows):
    widths = [max(len(line[column]) for line in [heads] + rows) for column in range(len(heads))]

    def text(cells):
        middle = [cell.rjust(width) for cell, width in zip(cells[1:-1], widths[1:-1])]
        return "| " + " | ".join([cells[0].ljust(widths[0])] + middle + [cells[-1]]) + " |"

    widths[-1] = len(heads[-1])  # of any length: names of alarms
    ruled = "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    return "\n".join([text(heads), ruled] + [text(row) for row in rows])


class Limits:
    """Checks figures, and keeps broken limits."""

    def __init__(self):
        self.broken = []

    def at_most(self, who, what, value, limit):
        if value is None or not value <= limit:
            self.broken.append(f"{who}: {what} {number(value, 3)} is above {number(limit, 3)}")

    def at_least(self, who, what, value, limit):
        if value is None or not value >= limit:
            self.broken.append(f"{who}: {what} {number(value, 3)} is below {number(limit, 3)}")

    def fail(self, who, what):
        self.broken.append(f"{who}: {what}")

    def text(self):
        if not self.broken:
            return "Every limit holds."
        return "\n".join([f"{len(self.broken)} limits are broken:"] + [f"- {line}" for line in self.broken])
