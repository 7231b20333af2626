"""The rows of all recordings: as text, as a file, and in the order of their verdicts."""

import csv
import io
import json

from slipnav_campaign.task import Failure

from .evaluation import NAME_WIDTH, findings, reason

# Of the processor and not of the drive: they differ from run to run.
TIMINGS = ("forecast_ms_p50", "forecast_ms_p99", "cpu_s", "realtime_factor")
FOUND = ("problems", "alarms")
FAILED = "failed"
# Beginning or content of a verdict, worst first.
VERDICTS = (FAILED, "over-confident", "worse than wheels and gyro", "stops seen but not used", "cautious", "not judged",
            "consistent")


def verdict_of(outcome):
    if isinstance(outcome, Failure):
        return f"{FAILED}: {reason(outcome)}"
    return outcome.remarks[0].split(": ", 1)[1]


def text(outcomes):
    """Like the output of `evaluate` for one recording: the header, a row and the verdict for each."""
    heads = [outcome.head for outcome in outcomes.values() if not isinstance(outcome, Failure)]
    lines, remarks = list(heads[0]) if heads else [], []
    for recording, outcome in outcomes.items():
        if isinstance(outcome, Failure):
            lines.append(recording.name.ljust(NAME_WIDTH) + "  " + verdict_of(outcome))
        else:
            lines += outcome.rows
            remarks += outcome.remarks
    return "\n".join(lines + remarks) + "\n"


def found_text(outcome, kind):
    """Its problems or alarms; those of a failure as printed."""
    if isinstance(outcome, Failure):
        mark = kind[:-1] + ": "
        return "; ".join(line[len(mark):] for line in findings(outcome.said) if line.startswith(mark))
    return "; ".join(f"{alarm['what']} ({alarm['count']})" for alarm in outcome.metrics.get(kind, []))


def cells_of(outcome):
    """{column: text} of metrics.json, numbers with all their digits."""
    cells = {}
    if not isinstance(outcome, Failure):
        for key, value in json.loads(outcome.metrics_json, parse_float=str, parse_int=str).items():
            if key not in TIMINGS + FOUND + ("verdict",):
                cells[key] = "" if value is None else value
    return cells


def rows_csv(outcomes, group_of):
    cells = {recording: cells_of(outcome) for recording, outcome in outcomes.items()}
    columns = list(dict.fromkeys(key for found in cells.values() for key in found)) + list(FOUND)
    for recording, outcome in outcomes.items():
        cells[recording].update({kind: found_text(outcome, kind) for kind in FOUND})
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(["recording", "files", "group", "verdict"] + columns)
    for recording, outcome in outcomes.items():
        writer.writerow([recording.name, " ".join(recording.parts), group_of.get(recording, ""), verdict_of(outcome)]
                        + [cells[recording].get(column, "") for column in columns])
    return buffer.getvalue()


def rank(outcome):
    verdict = verdict_of(outcome)
    return next((place for place, word in enumerate(VERDICTS) if word in verdict), len(VERDICTS))


def is_bad(outcome):
    return rank(outcome) < VERDICTS.index("cautious")


def badness(outcome):
    """Smaller is worse: the verdict, then the larger error."""
    error = None if isinstance(outcome, Failure) else outcome.metrics["enu_error_pct"]
    return rank(outcome), 0.0 if error is None else -error


def worst_first(outcomes):
    return sorted(outcomes, key=lambda recording: badness(outcomes[recording]))
