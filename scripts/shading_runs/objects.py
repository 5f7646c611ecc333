"""The objects of a model with the names of their fields, IDF and epJSON alike, and what differs between two models."""

import json
from dataclasses import dataclass
from functools import lru_cache
from math import cos, radians, sin
from pathlib import Path

from shading_runs import input_file


@lru_cache(maxsize=1)
def _schema(prefix):
    path = Path(prefix) / "Energy+.schema.epJSON"
    return {name.lower(): (name, found) for name, found in json.loads(path.read_bytes())["properties"].items()}


def _of_idf(model, schema):
    for type_, spans, _, _ in model.objects:
        values = [model.text[slice(*span)] for span in spans]
        idd = schema[type_][1]["legacy_idd"] if type_ in schema else {"fields": ["name"]}
        fields, repeated = idd["fields"], idd.get("extensibles", [])
        labels = fields[:len(values)]
        for i in range(len(values) - len(labels)):
            labels.append(f"{repeated[i % len(repeated)]} {i // len(repeated) + 1}" if repeated
                          else f"field {len(fields) + i + 1}")
        yield type_, dict(zip(labels, values, strict=True))


def _of_epjson(model):
    for type_, objects in model.data.items():
        for name, content in objects.items():
            fields = {"name": name}
            for key, value in content.items():
                for number, item in enumerate(value if isinstance(value, list) else [], start=1):
                    fields |= {f"{label} {number}": str(each) for label, each in item.items()}
                if not isinstance(value, list):
                    fields[key] = str(value)
            yield type_.lower(), fields


def _is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def _same(a, b):
    if _is_number(a) and _is_number(b):
        return float(a) == float(b)
    return a.strip().lower() == b.strip().lower()


class Objects:
    """The objects of a model and of further files: {class in lower case: [{field: value}]}, without empty fields."""

    def __init__(self, paths, prefix):
        schema = _schema(str(prefix))
        self.classes, self.names = {}, {}
        for path in paths:
            model = input_file.read(path)
            found = _of_idf(model, schema) if isinstance(model, input_file.Idf) else _of_epjson(model)
            for type_, fields in found:
                self.names.setdefault(type_, schema[type_][0] if type_ in schema else type_)
                self.classes.setdefault(type_, []).append({key: value for key, value in fields.items() if value})

    def first(self, type_, field, default=""):
        return next((found[field] for found in self.classes.get(type_.lower(), ()) if field in found), default)

    def daylighting_points(self):
        """{"CONTROLS, point 1": (zone in upper case, position in metres: x east, y north, z up)}."""
        placed = {}
        spaces = {found.get("name", "").upper(): found.get("zone_name", "") for found in self.classes.get("space", ())}
        zones = {found.get("name", "").upper(): found for found in self.classes.get("zone", ())}
        is_relative = self.first("GlobalGeometryRules", "daylighting_reference_point_coordinate_system",
                                 "relative").lower() == "relative"
        north = float(self.first("Building", "north_axis", "0"))
        for point in self.classes.get("daylighting:referencepoint", ()):
            within = point.get("zone_or_space_name", "").upper()
            name = spaces.get(within, within).upper()
            x, y, z = (float(point.get(f"{axis}_coordinate_of_reference_point", 0)) for axis in "xyz")
            if is_relative:
                zone = {key: float(value) for key, value in zones.get(name, {}).items() if _is_number(value)}
                x, y = _turned(x, y, zone.get("direction_of_relative_north", 0.0))
                x, y = x + zone.get("x_origin", 0.0), y + zone.get("y_origin", 0.0)
                x, y = _turned(x, y, north)
                z += zone.get("z_origin", 0.0)
            placed[point.get("name", "").upper()] = (name, (x, y, z))
        found = {}
        for controls in self.classes.get("daylighting:controls", ()):
            for label, point in controls.items():
                number = label.removeprefix("daylighting_reference_point_name ")
                if number.isdigit() and point.upper() in placed:
                    found[f"{controls.get('name', '').upper()}, point {number}"] = placed[point.upper()]
        return found


def _turned(x, y, north):
    """As EnergyPlus turns relative coordinates, by degrees clockwise."""
    angle = radians(-north)
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)


@dataclass
class Change:
    """Of an object: `field` is "" where the whole object is only in one of the models."""

    type: str
    name: str
    field: str
    before: str
    after: str


def _pairs(before, after):
    """Objects of a class by their names, or the one of each model; a name may be there several times."""
    left, right = {}, {}
    for found, objects in ((left, before), (right, after)):
        for each in objects:
            found.setdefault(each.get("name", "").lower(), []).append(each)
    if len(before) == len(after) == 1:
        return [(before[0], after[0])]
    pairs = []
    for name in {**left, **right}:
        a, b = left.get(name, []), right.get(name, [])
        pairs += [(a[i] if i < len(a) else None, b[i] if i < len(b) else None) for i in range(max(len(a), len(b)))]
    return pairs


def differences(before, after):
    """[Change] from an Objects to another, by class."""
    found = []
    for type_ in sorted({*before.classes, *after.classes}):
        title = after.names.get(type_) or before.names[type_]
        for a, b in _pairs(before.classes.get(type_, []), after.classes.get(type_, [])):
            name = (a or b).get("name", "")
            if a is None or b is None:
                found.append(Change(title, name, "", "there" if a else "none", "there" if b else "none"))
                continue
            found += [Change(title, name, field.replace("_", " "), a.get(field, "none"), b.get(field, "none"))
                      for field in {**a, **b} if not _same(a.get(field, ""), b.get(field, ""))]
    return found
