"""The table of a study, as CSV and Parquet, and the times beside it."""

from __future__ import annotations

import csv
import importlib
import importlib.util
import io
from collections.abc import Mapping, Sequence
from typing import Any

from gpu_shading._text import escaped
from gpu_shading.study.folder import Tables

FIRST = ("run", "model", "variant", "weather", "status", "message", "scene", "directions rendered",
         "directions from the cache", "largest error", "inputs", "gpu_shading", "energyplus")
LAST = ("messages",)
_TEXTS = {"run", "model", "variant", "weather", "status", "message", "scene", "inputs", "gpu_shading", "energyplus",
          "messages", "host"}
_WHOLE = {"directions rendered", "receivers", "directions from the cache", "attempts"}

Row = Mapping[str, Any]


def write_tables(tables: Tables, rows: Sequence[Row], times: Sequence[Row]) -> None:
    """runs.csv, runs.parquet where pyarrow is installed, and times.csv. Raises InvalidInput if one of them is not of a
    study."""
    numbers = sorted({name for row in rows for name in row} - {*FIRST, *LAST})
    columns = [*FIRST, *numbers, *LAST]
    contents = {"runs.csv": _csv(columns, rows),
                "times.csv": _csv(["run", "seconds", "cpu seconds", "attempts", "host"], times)}
    if importlib.util.find_spec("pyarrow"):
        contents["runs.parquet"] = _parquet(columns, rows)
    tables.write(contents)


def _csv(columns: Sequence[str], rows: Sequence[Row]) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(_cell, columns))
    writer.writerows([_cell(row.get(name)) for name in columns] for row in rows)
    return text.getvalue().encode()


def _cell(value: Any) -> Any:
    if not isinstance(value, str):
        return value
    text = escaped(value)
    return f"'{text}" if text[:1] in tuple("=+-@") and text else text  # a spreadsheet takes such a text for a formula


def _parquet(columns: Sequence[str], rows: Sequence[Row]) -> bytes:
    arrow, parquet = importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    types = {name: arrow.string() if name in _TEXTS else arrow.int64() if name in _WHOLE else arrow.float64()
             for name in columns}
    table = arrow.table({escaped(name): arrow.array([_escaped(row.get(name)) for row in rows], type_)
                         for name, type_ in types.items()})
    written = arrow.BufferOutputStream()
    parquet.write_table(table, written)
    return bytes(written.getvalue())


def _escaped(value: Any) -> Any:
    return escaped(value) if isinstance(value, str) else value
