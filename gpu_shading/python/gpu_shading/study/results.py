"""What the table of a study says about a run: numbers of EnergyPlus's SQLite file, and our messages."""

from __future__ import annotations

import contextlib
import math
import re
import sqlite3
from collections.abc import Iterable, Sequence
from pathlib import Path

TRANSMITTED = "Enclosure Windows Total Transmitted Solar Radiation Energy"
_KWH = 3.6e6
_REPORTS = (
    # report, table, name of its columns
    ("AnnualBuildingUtilityPerformanceSummary", "End Uses", "{row} {column} [{units}]"),
    ("DemandEndUseComponentsSummary", "End Uses", "Peak {row} {column} [{units}]"),
)
# Objects that a lean input has in place of others, and EnergyPlus's mirror images of them.
_OURS = re.compile(r"(Mir-)?GPU SHADING (PLACEHOLDER \d+|SKY|(NORTHERN|SOUTHERN) LEAVES)$", re.IGNORECASE)
_RENDERED = re.compile(r"shading rendered by .*?: .*?, (\d+) directions(?: rendered, (\d+) from the cache)?")


def read_numbers(file: Path, outputs: Sequence[str] = ()) -> dict[str, float]:
    """End uses in kWh, peaks in W, unmet hours, transmitted solar, and output variables over the run period, those
    that are not 0."""
    numbers: dict[str, float] = {}
    with contextlib.closing(sqlite3.connect(f"{file.absolute().as_uri()}?mode=ro", uri=True)) as base:
        for report, table, name in _REPORTS:
            rows = base.execute("SELECT RowName, ColumnName, Units, Value FROM TabularDataWithStrings WHERE "
                                "ReportName = ? AND TableName = ? ORDER BY TabularDataIndex", (report, table))
            _take(numbers, ((name.format(row=row, column=column, units=units), value)
                            for row, column, units, value in rows if row.strip() and row != "Time of Peak"))
        rows = base.execute("SELECT RowName, Value FROM TabularDataWithStrings WHERE ReportName = ? AND TableName = ? "
                            "AND ColumnName = 'Facility' ORDER BY TabularDataIndex",
                            (_REPORTS[0][0], "Comfort and Setpoint Not Met Summary"))
        _take(numbers, ((f"Unmet {row.removeprefix('Time ')} [h]", value) for row, value in rows
                        if row.startswith("Time Setpoint Not Met During Occupied")), zeros=True)
        for name in (TRANSMITTED, *outputs):
            found = base.execute(
                "SELECT d.KeyValue, d.Units, r.Value FROM ReportDataDictionary d JOIN ReportData r ON "
                "r.ReportDataDictionaryIndex = d.ReportDataDictionaryIndex JOIN Time t ON t.TimeIndex = r.TimeIndex "
                "WHERE d.Name = ? AND d.ReportingFrequency = 'Run Period' ORDER BY t.EnvironmentPeriodIndex, "
                "d.ReportDataDictionaryIndex", (name,)).fetchall()
            if name == TRANSMITTED:
                by_key = {key: value for key, _, value in found}  # of the last environment
                numbers["Transmitted Solar [kWh]"] = round(sum(by_key.values()) / _KWH, 6)
            else:
                numbers |= {f"{name}, {key} [{units}]": value for key, units, value in found
                            if not _OURS.match(key or "")}
    return numbers


def _take(numbers: dict[str, float], found: Iterable[tuple[str, str]], zeros: bool = False) -> None:
    for name, value in found:
        with contextlib.suppress(TypeError, ValueError):
            number = float(value)
            if math.isfinite(number) and (number or zeros):
                numbers[name] = number


def read_messages(text: str) -> tuple[int | None, int | None, list[str]]:
    """Of eplusout.err: directions that were rendered, directions from the cache, and our warnings."""
    ours = [line.partition("gpu_shading: ")[2].strip() for line in text.splitlines() if "gpu_shading: " in line]
    found = next((match for match in map(_RENDERED.search, ours) if match), None)
    rendered = int(found[1]) if found else None
    recalled = int(found[2] or 0) if found else None
    return rendered, recalled, list(dict.fromkeys(line for line in ours if line.startswith("warning")))


def last_lines(text: str, count: int = 3) -> str:
    """The last errors of eplusout.err or of standard error, else its last lines, in one."""
    lines = [re.sub(r"^[\s*]*\*\*\s*(\w+)\s*\*\*\s*", r"\1: ", line).strip(" *") for line in text.splitlines()]
    lines = [line for line in lines if line]
    errors = [line for line in lines if re.match(r"(Severe|Fatal): ", line) or "error: " in line] or lines
    return " | ".join(errors[-count:])
