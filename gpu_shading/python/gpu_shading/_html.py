"""Tables for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence

_MOST_ROWS = 60


def table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """HTML of a table; of many rows, the first."""
    found = list(rows)
    lines = ["<table><thead><tr>", *(f"<th>{html.escape(head)}</th>" for head in heads), "</tr></thead><tbody>"]
    for row in found[:_MOST_ROWS]:
        cells = (f"{value:.4g}" if isinstance(value, float) else "" if value is None else str(value) for value in row)
        lines += ["<tr>", *(f"<td>{html.escape(cell)}</td>" for cell in cells), "</tr>"]
    lines.append("</tbody></table>")
    if len(found) > _MOST_ROWS:
        lines.append(f"<p>{_MOST_ROWS} of {len(found)} rows</p>")
    return "".join(lines)
