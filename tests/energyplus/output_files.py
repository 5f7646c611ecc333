"""Reads the outputs of a run, and makes those of two runs comparable."""

import csv
import re
import sqlite3

# Dates and clock times, elapsed and run times: all that two runs of the same program may differ in.
TIMES = (
    re.compile(rb"YMD=\d{4}\.\d\d\.\d\d \d\d:\d\d"),
    re.compile(rb"(Elapsed Time=|Run Time=)\s*\d+hr\s+\d+min\s+[\d.]+sec"),
    re.compile(rb"\d{4}-\d\d-\d\d\s+\d\d:\d\d:\d\d"),
    re.compile(rb"(?<=clear), [\d.]+ s(?=;|$)", re.MULTILINE),  # our own line on what was rendered
)


def rows_of(path):
    """The rows of a table with a heading, as dictionaries."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def masked(content):
    for pattern in TIMES:
        content = pattern.sub(b"<time>", content)
    return content


def values_of(run, variable, frequency=None):
    """{key: values over time} of an output in the run's database, of one reporting frequency or of its only one."""
    with sqlite3.connect(f"file:{run.folder / 'eplusout.sql'}?mode=ro", uri=True) as data:
        rows = data.execute(
            "SELECT KeyValue, Value FROM ReportData JOIN ReportDataDictionary USING (ReportDataDictionaryIndex) "
            "WHERE Name = ?1 AND (?2 IS NULL OR ReportingFrequency = ?2) ORDER BY ReportDataIndex",
            (variable, frequency)).fetchall()
    data.close()
    values = {}
    for key, value in rows:
        values.setdefault(key, []).append(value)
    return values


def database_content(path):
    """All rows of all tables but the one with the time stamp."""
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as data:
        tables = [name for (name,) in data.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")]
        rows = {name: data.execute(f'SELECT * FROM "{name}"').fetchall() for name in tables if name != "Simulations"}
        # The version line with its time stamp is the first row of the strings too.
        content = repr(rows).encode()
    data.close()
    return content


def snapshot(folder):
    """{file name: content without times} of a run's output folder."""
    return {
        path.name: masked(database_content(path) if path.suffix == ".sql" else path.read_bytes())
        for path in sorted(folder.iterdir())
        if path.is_file()
    }


def differing(first, second):
    """Names of the files that only one has, or that are not the same in both."""
    return sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
