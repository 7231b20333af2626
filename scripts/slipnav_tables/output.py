"""Writes sections as Markdown, JSON and one self-contained HTML page."""

import html
import json
import os

from slipnav_campaign.task import Failure
from slipnav_report.page import STYLE, figure_block

TITLE = "The paper's tables and figure, over simulated drives"


def table_markdown(table):
    """Padded, so that it reads well without being rendered as well."""
    lines = [table.heads] + table.rows
    widths = [max(len(line[column]) for line in lines) for column in range(len(table.heads))]

    def text(cells):
        return "| " + " | ".join(cell.ljust(width) for cell, width in zip(cells, widths)) + " |"

    ruled = [text(table.heads), "|" + "|".join("-" * (width + 2) for width in widths) + "|"]
    caption = [table.caption + ":", ""] if table.caption else []
    return "\n".join(caption + ruled + [text(row) for row in table.rows])


def section_markdown(section):
    blocks = [f"## {section.title}"] + [table_markdown(table) for table in section.tables] + section.notes
    blocks += [f"![{figure.title}]({figure.name}.png)" for figure in section.figures]
    return "\n\n".join(blocks)


def failures_of(outcomes):
    return {drive: failure for drive, failure in outcomes.items() if isinstance(failure, Failure)}


def failure_lines(outcomes):
    failures = failures_of(outcomes)
    if not failures:
        return [f"All {len(outcomes)} drives finished."]
    return [f"{len(failures)} of {len(outcomes)} drives failed and are not included:"] + [
        f"- {drive}: {failure}" for drive, failure in failures.items()]


def markdown(sections, outcomes):
    blocks = [f"# {TITLE}"] + [section_markdown(section) for section in sections]
    return "\n\n".join(blocks) + "\n\n" + "\n".join(failure_lines(outcomes)) + "\n"


def table_html(table):
    def row(cells, kind):
        return "<tr>" + "".join(f"<{kind}>{html.escape(cell)}</{kind}>" for cell in cells) + "</tr>"

    caption = f"<caption>{html.escape(table.caption)}</caption>" if table.caption else ""
    rows = "".join(row(cells, "td") for cells in table.rows)
    return f"<div class=wide><table>{caption}{row(table.heads, 'th')}{rows}</table></div>"


def section_html(section):
    blocks = [f"<h2>{html.escape(section.title)}</h2>"] + [table_html(table) for table in section.tables]
    blocks += [f"<p>{html.escape(note).replace('`', '')}</p>" for note in section.notes]
    blocks += [figure_block(figure.name, figure.title, figure.png) for figure in section.figures]
    return "".join(blocks)


def page(sections, outcomes):
    body = "".join(section_html(section) for section in sections)
    failures = "".join(f"<p>{html.escape(line)}</p>" for line in failure_lines(outcomes))
    return (f"<!DOCTYPE html><html lang=en><head><meta charset=utf-8><title>slipnav: tables</title>"
            f"<style>{STYLE} body {{ max-width: 80rem }} caption {{ text-align: left; padding-bottom: 0.5rem }}</style>"
            f"</head><body><h1>{html.escape(TITLE)}</h1>{body}{failures}</body></html>\n")


def drive_json(drive, outcome):
    entry = {"terrain": drive.terrain, "distance_m": drive.distance_m, "seed": drive.seed, "policy": drive.policy,
             "threshold_m": drive.threshold_m, "settings": list(drive.settings)}
    if isinstance(outcome, Failure):
        return dict(entry, failure=str(outcome))
    return dict(entry, **outcome.as_json())


def write_all(directory, named_sections, outcomes):
    """tables.md, tables.json, tables.html and the figures."""
    sections = list(named_sections.values())
    data = {"sections": {name: section.data for name, section in named_sections.items()},
            "drives": [drive_json(drive, outcome) for drive, outcome in outcomes.items()]}
    texts = {"tables.md": markdown(sections, outcomes), "tables.html": page(sections, outcomes),
             "tables.json": json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n"}
    for name, text in texts.items():
        with open(os.path.join(directory, name), "w", encoding="utf-8") as file:
            file.write(text)
    for section in sections:
        for figure in section.figures:
            with open(os.path.join(directory, figure.name + ".png"), "wb") as file:
                file.write(figure.png)
