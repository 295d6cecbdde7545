"""Results as notebooks show them: small tables, every text escaped."""

from __future__ import annotations

import math
from dataclasses import dataclass
from html import escape
from typing import Any, List, Sequence

#: More rows than this are counted, not shown.
MOST_ROWS = 40

_CELL = "padding:2px 10px;text-align:{};"


@dataclass(frozen=True)
class Table:
    """Rows of texts and numbers under a caption."""

    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _text(value: Any) -> str:
    """Numbers have four digits; what is not there is empty, what the data do
    not determine infinite."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not _is_number(value):
        return str(value)
    if math.isnan(value):
        return ""
    return "∞" if math.isinf(value) else f"{value:.4g}"


def _row(cells: Sequence[Any], tag: str) -> str:
    made = []
    for cell in cells:
        style = _CELL.format("right" if _is_number(cell) else "left")
        made.append(f'<{tag} style="{style}">{escape(_text(cell))}</{tag}>')
    return f"<tr>{''.join(made)}</tr>"


def _table(table: Table) -> str:
    shown = table.rows[:MOST_ROWS]
    # A heading stands over its column as its numbers do.
    like = [next((row[k] for row in shown if row[k] is not None), None)
            for k in range(len(table.columns))]
    head = "".join(
        f'<th style="{_CELL.format("right" if _is_number(one) else "left")}">'
        f"{escape(name)}</th>" for name, one in zip(table.columns, like))
    rows = "".join(_row(row, "td") for row in shown)
    left_out = len(table.rows) - len(shown)
    more = f"<div>and {left_out} more</div>" if left_out > 0 else ""
    return ('<table style="border-collapse:collapse;margin:6px 0">'
            '<caption style="text-align:left;font-weight:bold;'
            f'white-space:nowrap">{escape(table.caption)}</caption>'
            f"<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
            f"{more}")


def page(title: str, passed: bool, sentence: str, tables: List[Table],
         report: str = "") -> str:
    """A heading with the verdict, a sentence, and the tables that have rows;
    where none has any, the report."""
    shown = [_table(table) for table in tables if table.rows]
    if not shown and report:
        shown = [f'<pre style="margin:6px 0">{escape(report)}</pre>']
    mark = "✓" if passed else "✗"
    colour = "#1a7f37" if passed else "#b42318"
    return (f'<div><div><b>{escape(title)}</b> '
            f'<span style="color:{colour}">{mark}</span></div>'
            f'<div style="max-width:60em">{escape(sentence)}</div>' +
            "".join(shown) + "</div>")
