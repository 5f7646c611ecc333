"""Copies of IDF and epJSON files with replaced fields, removed and added objects."""

from __future__ import annotations

import contextlib
import fnmatch
import json
import math
import os
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from gpu_shading import _programs
from gpu_shading._text import escaped, quoted
from gpu_shading.errors import InvalidInput
from gpu_shading.study import inputs

_MAX_DEPTH = 100  # of JSON
_FILE = re.compile(r"[^!,;\"\n\r]*\.[A-Za-z]\w{0,9}")


@dataclass(frozen=True)
class Field:
    """A field of all objects of a class whose names match a pattern."""

    type: str
    pattern: str
    index: int
    """In an IDF, after the class; 0 is the first."""
    key: str
    item: int | None
    """In a list of an epJSON object, where the field is in one."""
    list_key: str
    first: int
    """In an IDF, where the list begins."""
    each: int
    """Fields of an item of the list."""
    is_number: bool
    """Whether it takes numbers only."""
    text: str
    """The words that name it, "Class/Name/Field"."""

    def check(self, value: str, is_idf: bool) -> None:
        """Raises InvalidInput if the text cannot be a value of the field."""
        if self.is_number and re.fullmatch(r"\s*[-+]?\d+,\d+\s*", value):
            raise InvalidInput(f"{quoted(self.text)}: {quoted(value)}, expected a number with a decimal point: "
                               f"{value.strip().replace(',', '.')}")
        if escaped(value) != value or (is_idf and re.search("[,;!]", value)):
            raise InvalidInput(f"{quoted(self.text)}: {quoted(value)}, expected one value, without , ; ! or line ends")


@lru_cache(maxsize=1)
def _schema(prefix: Path) -> dict[str, Any]:
    return dict(json.loads((prefix / "Energy+.schema.epJSON").read_bytes())["properties"])


def _near(name: str, names: Iterable[str]) -> str | None:
    return next((known for known in names if known.lower() == name.lower()), None)


def find_field(text: str) -> Field:
    """The field that "Class/Name/Field" names; Name may have * and ?. Raises InvalidInput."""
    type_, _, rest = text.partition("/")
    pattern, _, field = rest.rpartition("/")
    if not (type_ and pattern and field):
        raise InvalidInput(f"{quoted(text)}: expected \"Class/Object Name/Field\"")
    schema = _schema(_programs.prefix())
    known = _near(type_.strip(), schema)
    if known is None:
        raise InvalidInput(f"{quoted(text)}: EnergyPlus has no class {quoted(type_)}")
    idd = schema[known]["legacy_idd"]
    info, fields, extensions = idd["field_info"], idd["fields"], idd.get("extensibles", [])
    wanted = field.strip().lower()
    for index, key in enumerate(fields):
        if info[key]["field_name"].lower() == wanted:
            return Field(known, pattern, index, key, None, "", 0, 0, _is_number(info[key]), text)
    for place, key in enumerate(extensions):
        # "Vertex 3 X-coordinate" is the third "Vertex X-coordinate".
        number = re.search("[0-9]{1,9}", wanted)
        name = re.sub(r"\s*\d+", "", info[key]["field_name"].lower())
        if number and int(number[0]) > 0 and re.sub(r"\s*[0-9]{1,9}", "", wanted) == name:
            item = int(number[0]) - 1
            return Field(known, pattern, len(fields) + item * len(extensions) + place, key, item, idd["extension"],
                         len(fields), len(extensions), _is_number(info[key]), text)
    raise InvalidInput(f"{quoted(text)}: {known} has no field {quoted(field)}")


def _is_number(info: Mapping[str, Any]) -> bool:
    return info.get("field_type") == "n"


def read(path: Path) -> Idf | EpJson:
    """Raises InvalidInput, with one line that names the file."""
    text = inputs.read(path, inputs.MAX_MODEL).decode("utf-8", "surrogateescape")  # with its ends of lines
    try:
        return EpJson(text) if path.suffix.lower() == ".epjson" else Idf(text)
    except (ValueError, RecursionError) as error:
        why = f"is nested over {_MAX_DEPTH} deep" if isinstance(error, RecursionError) else str(error)
        raise InvalidInput(f"{path}: {why}") from None


def check_objects(text: str) -> None:
    """Raises InvalidInput if what follows objects in an IDF would become a part of them."""
    bare = re.sub(r"![^\n]*", "", text).rstrip()
    if bare and not bare.endswith(";"):
        raise InvalidInput(f"objects: {quoted(text)}, expected IDF text that ends with ;")


def _matches(name: str, pattern: str) -> bool:
    return fnmatch.fnmatchcase(name.lower(), pattern.lower())


class Idf:
    """An IDF as text, with the positions of its objects and fields."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.objects: list[tuple[str, list[tuple[int, int]], int, int]] = []
        self._scan()

    def _scan(self) -> None:
        # Blanks in place of comments keep positions.
        bare = re.sub(r"![^\n]*", lambda found: " " * len(found.group()), self.text)
        self.objects, start = [], 0
        for end in (found.start() for found in re.finditer(";", bare)):
            fields, at = [], start
            for piece in bare[start:end].split(","):
                left = at + len(piece) - len(piece.lstrip())
                fields.append((left, max(left, at + len(piece.rstrip()))))
                at += len(piece) + 1
            self.objects.append((bare[slice(*fields[0])].lower(), fields[1:], fields[0][0], end + 1))
            start = end + 1

    def _found(self, type_: str, pattern: str) -> list[tuple[list[tuple[int, int]], int, int]]:
        return [(spans, start, end) for name, spans, start, end in self.objects if name == type_.lower()
                and _matches(self.text[slice(*spans[0])] if spans else "", pattern)]

    def count(self, type_: str, pattern: str = "*") -> int:
        return len(self._found(type_, pattern))

    def items(self, field: Field) -> int:
        """How many items the shortest of the lists has that the field is in."""
        return min((math.ceil((len(spans) - field.first) / field.each)
                    for spans, _, _ in self._found(field.type, field.pattern)), default=0)

    def set(self, field: Field, value: str) -> None:
        edits = []
        for spans, _, end in self._found(field.type, field.pattern):
            if field.index < len(spans):
                edits.append((*spans[field.index], value))
            else:
                edits.append((end - 1, end - 1, "," * (field.index - len(spans) + 1) + value))
        self._replace(edits)

    def remove(self, type_: str, pattern: str = "*") -> None:
        self._replace([(start, end, "") for _, start, end in self._found(type_, pattern)])

    def add(self, type_: str, **fields: str) -> None:
        """`fields`: in the order of the dictionary."""
        self.append(",".join([type_, *fields.values()]) + ";")

    def append(self, objects: str) -> None:
        self.text = self.text.rstrip("\n") + "\n" + objects.rstrip("\n") + "\n"
        self._scan()

    def files(self, folder: Path) -> list[str]:
        """The values that name files, relative to the model's folder."""
        values = {self.text[slice(*span)] for _, spans, _, _ in self.objects for span in spans}
        return sorted(value for value in values if _is_named(folder, value))

    def anchor(self, folder: Path) -> bool:
        """Makes the names of files absolute; returns whether objects of ours have some."""
        edits, ours = [], False
        for name, spans, _, _ in self.objects:
            for start, end in spans:
                value = self.text[start:end]
                if not _is_file(folder, value):
                    continue
                path = os.path.abspath(folder / value)
                if re.search("[,;!]", path):
                    raise InvalidInput(f"{path}: an IDF cannot name a file with , ; or ! in its path")
                edits.append((start, end, path))
                ours = ours or name.startswith("gpushading:")
        self._replace(edits)
        return ours

    def write(self, path: Path) -> None:
        path.write_bytes(self.text.encode("utf-8", "surrogateescape"))

    def _replace(self, edits: list[tuple[int, int, str]]) -> None:
        pieces, at = [], 0
        for start, end, value in sorted(edits):
            pieces += [self.text[at:start], value]
            at = end
        self.text = "".join([*pieces, self.text[at:]])
        self._scan()


class EpJson:
    """The same for epJSON."""

    def __init__(self, text: str) -> None:
        self.data: dict[str, dict[str, dict[str, Any]]] = json.loads(text, parse_constant=_refuse_constant)
        _require_table(self.data, "the model")
        for type_, objects in self.data.items():
            _require_table(objects, type_)
            for name, fields in objects.items():
                _require_table(fields, f"{type_} {quoted(name)}")
        if _depth(self.data) > _MAX_DEPTH:
            raise RecursionError

    def _found(self, type_: str, pattern: str) -> list[tuple[str, str]]:
        return [(key, name) for key, objects in self.data.items() if key.lower() == type_.lower()
                for name in objects if _matches(name, pattern)]

    def count(self, type_: str, pattern: str = "*") -> int:
        return len(self._found(type_, pattern))

    def items(self, field: Field) -> int:
        found = (self.data[type_][name].get(field.list_key, []) for type_, name in self._found(
            field.type, field.pattern))
        return min((len(items) for items in found if _is_list_of_tables(items)), default=0)

    def set(self, field: Field, value: str) -> None:
        parsed: str | float = value
        with contextlib.suppress(ValueError):
            number = int(value) if re.fullmatch(r"[-+]?\d{1,18}", value) else float(value)
            parsed = number if math.isfinite(number) else value
        for type_, name in self._found(field.type, field.pattern):
            found = self.data[type_][name]
            if field.item is not None:
                items = found.setdefault(field.list_key, [])
                if not _is_list_of_tables(items):
                    raise InvalidInput(f"{quoted(field.text)}: {field.type} {quoted(name)}: {field.list_key} is not a "
                                       "list")
                items.extend({} for _ in range(field.item + 1 - len(items)))
                found = items[field.item]
            found[field.key] = parsed

    def remove(self, type_: str, pattern: str = "*") -> None:
        for key, name in self._found(type_, pattern):
            del self.data[key][name]

    def add(self, type_: str, **fields: str) -> None:
        objects = self.data.setdefault(_near(type_, self.data) or type_, {})
        content: dict[str, Any] = dict(fields)
        if type_ == "Output:Table:SummaryReports":
            content = {"reports": [{"report_name": fields["report"]}]}
        objects[f"gpu_shading study {len(objects)}"] = content

    def append(self, objects: str) -> None:
        raise InvalidInput("objects: can be added to an IDF, not to epJSON")

    def files(self, folder: Path) -> list[str]:
        return sorted({value for _, value in self._texts() if _is_named(folder, value)})

    def anchor(self, folder: Path) -> bool:
        ours = False
        for type_, objects in self.data.items():
            for fields in objects.values():
                for key, value in fields.items():
                    if isinstance(value, str) and _is_file(folder, value):
                        fields[key] = os.path.abspath(folder / value)
                        ours = ours or type_.lower().startswith("gpushading:")
        return ours

    def _texts(self) -> Iterable[tuple[str, str]]:
        return ((key, value) for objects in self.data.values() for fields in objects.values()
                for key, value in fields.items() if isinstance(value, str))

    def write(self, path: Path) -> None:
        path.write_text(json.dumps(self.data, indent=1), encoding="utf-8")


def _refuse_constant(text: str) -> None:
    raise ValueError(f"{text} is not a number that a model may have")


def _require_table(value: object, what: str) -> None:
    if not isinstance(value, dict):
        raise ValueError(f"{what}: {quoted(value)}, expected a table of {{}}")


def _is_list_of_tables(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(item, dict) for item in value)


def _depth(value: object) -> int:
    level, depth = [value], 0
    while level:
        depth += 1
        level = [inner for outer in level if isinstance(outer, (dict, list))
                 for inner in (outer.values() if isinstance(outer, dict) else outer)]
    return depth


def _is_named(folder: Path, value: str) -> bool:
    return bool(_FILE.fullmatch(value)) and inputs.is_file(folder / value)


def _is_file(folder: Path, value: str) -> bool:
    return not os.path.isabs(value) and _is_named(folder, value)
