"""The table of a study, as CSV and Parquet, and the times beside it."""

from __future__ import annotations

import csv
import importlib
import importlib.util
import io
import os
import secrets
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gpu_shading.study.tasks import write_whole

FIRST = ("run", "model", "variant", "weather", "status", "message", "scene", "directions rendered",
         "directions from the cache", "inputs", "gpu_shading", "energyplus")
LAST = ("messages",)
_TEXTS = {"run", "model", "variant", "weather", "status", "message", "scene", "inputs", "gpu_shading", "energyplus",
          "messages", "host"}
_WHOLE = {"directions rendered", "receivers", "directions from the cache", "attempts"}

Row = Mapping[str, Any]


def write_tables(folder: Path, rows: Sequence[Row], times: Sequence[Row]) -> None:
    """runs.csv, runs.parquet where pyarrow is installed, and times.csv."""
    numbers = sorted({name for row in rows for name in row} - {*FIRST, *LAST})
    columns = [*FIRST, *numbers, *LAST]
    write_whole(folder / "runs.csv", _csv(columns, rows))
    write_whole(folder / "times.csv", _csv(["run", "seconds", "cpu seconds", "attempts", "host"], times))
    if importlib.util.find_spec("pyarrow"):
        _write_parquet(folder / "runs.parquet", columns, rows)


def _csv(columns: Sequence[str], rows: Sequence[Row]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_cell(row.get(name)) for name in columns] for row in rows)
    return text.getvalue()


def _cell(value: Any) -> Any:
    # A spreadsheet takes such a text for a formula.
    return f"'{value}" if isinstance(value, str) and value[:1] in tuple("=+-@") and value else value


def _write_parquet(path: Path, columns: Sequence[str], rows: Sequence[Row]) -> None:
    arrow, parquet = importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    types = {name: arrow.string() if name in _TEXTS else arrow.int64() if name in _WHOLE else arrow.float64()
             for name in columns}
    table = arrow.table({name: arrow.array([row.get(name) for row in rows], type_) for name, type_ in types.items()})
    staged = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    try:
        parquet.write_table(table, staged)
        os.replace(staged, path)
    finally:
        staged.unlink(missing_ok=True)
