"""Reads an IDF or epJSON file and writes copies of it with a few changes.

Everything else is kept, including comments and layout: a copy has to be the user's model, not our interpretation of
it. Class and field names are not case-sensitive, as in EnergyPlus.
"""

import copy
import json
import os
import re
import shutil
from pathlib import Path

# Fields that the scripts change: IDF position (0 is the first after the class name), epJSON name.
SHADOW_METHOD = (0, "shading_calculation_method")
SHADOW_UPDATE = (1, "shading_calculation_update_frequency_method")
SHADOW_RESOLUTION = (5, "pixel_counting_resolution")
RUN_DESIGN_DAYS = (3, "run_simulation_for_sizing_periods")
RUN_WEATHER = (4, "run_simulation_for_weather_file_run_periods")
# Of a Daylighting:Controls: the first field of its reference points, which have three each.
FIRST_POINT = 13
FIELDS_OF_POINT = 3


def read(path):
    """An Idf or EpJson, depending on the file name's extension. Raises OSError or ValueError, naming the file."""
    path = Path(path)
    if path.exists() and not path.is_file():  # a pipe would be waited for, and a device has no end
        raise ValueError(f"{path} is not a file; expected an IDF or epJSON file")
    text = path.read_text(encoding="utf-8", errors="surrogateescape")
    try:
        return EpJson(text) if path.suffix.lower() == ".epjson" else Idf(text)
    except (RecursionError, ValueError) as error:
        raise ValueError(f"{path} is not epJSON: {error}") from None


class Idf:
    """An IDF as text, with the positions of its objects and fields."""

    def __init__(self, text):
        self.text = text
        self._scan()

    def _scan(self):
        # Comments are replaced by blanks of the same length, so that positions in both texts agree.
        bare = re.sub(r"![^\n]*", lambda found: " " * len(found.group()), self.text)
        self.objects = []  # (class in lower case, [(start, end) of each field], start, end)
        start = 0
        for end in (found.start() for found in re.finditer(";", bare)):
            fields, at = [], start
            for piece in bare[start:end].split(","):
                left = at + len(piece) - len(piece.lstrip())
                fields.append((left, max(left, at + len(piece.rstrip()))))
                at += len(piece) + 1
            name = bare[slice(*fields[0])].lower()
            self.objects.append((name, fields[1:], fields[0][0], end + 1))
            start = end + 1

    def copy(self):
        return copy.copy(self)

    def classes(self):
        return {name for name, _, _, _ in self.objects}

    def field(self, class_name, field, default=""):
        """The value of a field of the first object of the class."""
        for name, spans, _, _ in self.objects:
            if name == class_name.lower() and field[0] < len(spans):
                return self.text[slice(*spans[field[0]])] or default
        return default

    def max_daylighting_points(self):
        """The number of reference points of the Daylighting:Controls that has the most; 0 without one."""
        return max((-(-(len(spans) - FIRST_POINT) // FIELDS_OF_POINT) for name, spans, _, _ in self.objects
                    if name == "daylighting:controls"), default=0)

    def set_field(self, class_name, field, value):
        """Sets a field of the first object of the class, which is created if there is none."""
        for name, spans, _, end in self.objects:
            if name != class_name.lower():
                continue
            if field[0] < len(spans):
                start, stop = spans[field[0]]
                self._replace([(start, stop, value)])
            else:
                blanks = "," * (field[0] - len(spans) + 1)
                self._replace([(end - 1, end - 1, blanks + value)])
            return
        self.add(class_name, [""] * field[0] + [value])

    def add(self, class_name, fields):
        """Appends an object."""
        self.text = self.text.rstrip("\n") + "\n" + ",".join([class_name, *map(str, fields)]) + ";\n"
        self._scan()

    def add_unique(self, class_name, fields, _names=()):
        self.remove(lambda name: name == class_name.lower())
        self.add(class_name, fields)

    def add_output_variable(self, variable, frequency, key="*"):
        self.add("Output:Variable", [key, variable, frequency])

    def schedules_of_shades(self):
        """The schedules that objects of shades name."""
        values = [(name, [self.text[slice(*span)] for span in spans]) for name, spans, _, _ in self.objects]
        return _schedules_of_shades((name, fields[0], fields) for name, fields in values if fields)

    def remove(self, is_unwanted):
        """Removes the objects whose class, in lower case, is_unwanted accepts."""
        self._replace([(start, end, "") for name, _, start, end in self.objects if is_unwanted(name)])

    def anchor_paths(self, folder):
        """Makes paths absolute that lead through '..' from folder to an existing file."""
        edits = []
        for _, spans, _, _ in self.objects:
            for start, end in spans:
                value = self.text[start:end]
                if ".." in value and (folder / value).exists():
                    edits.append((start, end, os.path.abspath(folder / value)))
        self._replace(edits)

    def contents(self):
        return self.text

    def write(self, path):
        Path(path).write_text(self.text, encoding="utf-8", errors="surrogateescape")

    def _replace(self, edits):
        for start, end, value in sorted(edits, reverse=True):
            self.text = self.text[:start] + value + self.text[end:]
        self._scan()


class EpJson:
    """The same for epJSON; its content is kept, but not its layout."""

    def __init__(self, text):
        self.data = json.loads(text)

    def copy(self):
        other = copy.copy(self)
        other.data = copy.deepcopy(self.data)
        return other

    def _key(self, class_name):
        return next((key for key in self.data if key.lower() == class_name.lower()), None)

    def classes(self):
        return {name.lower() for name in self.data}

    def field(self, class_name, field, default=""):
        key = self._key(class_name)
        first = next(iter(self.data[key].values()), {}) if key else {}
        return str(first.get(field[1], "")) or default

    def max_daylighting_points(self):
        key = self._key("Daylighting:Controls")
        return max((len(fields.get("control_data", ())) for fields in (self.data[key] if key else {}).values()),
                   default=0)

    def set_field(self, class_name, field, value):
        key = self._key(class_name) or class_name
        objects = self.data.setdefault(key, {})
        if not objects:
            objects[f"{class_name} 1"] = {}
        first = next(iter(objects.values()))
        first[field[1]] = int(value) if re.fullmatch(r"\d+", value) else value

    def add_unique(self, class_name, fields, names=()):
        self.remove(lambda name: name == class_name.lower())
        self.data[class_name] = {f"{class_name} 1": dict(zip(names, fields, strict=True))}

    def schedules_of_shades(self):
        return _schedules_of_shades((key, name, map(str, fields.values())) for key, objects in self.data.items()
                                    for name, fields in objects.items())

    def add_output_variable(self, variable, frequency, key="*"):
        objects = self.data.setdefault(self._key("Output:Variable") or "Output:Variable", {})
        objects[f"compare_shading {len(objects)}"] = {
            "key_value": key,
            "variable_name": variable,
            "reporting_frequency": frequency,
        }

    def remove(self, is_unwanted):
        for key in [key for key in self.data if is_unwanted(key.lower())]:
            del self.data[key]

    def anchor_paths(self, folder):
        for objects in self.data.values():
            for fields in objects.values():
                for name, value in fields.items():
                    if isinstance(value, str) and ".." in value and (folder / value).exists():
                        fields[name] = os.path.abspath(folder / value)

    def contents(self):
        return json.dumps(self.data, indent=1, ensure_ascii=False)

    def write(self, path):
        Path(path).write_text(json.dumps(self.data, indent=1), encoding="utf-8")


def _schedules_of_shades(objects):
    """objects: (class, name, values of fields). Schedules named by objects of shades, in order."""
    schedules, named = {}, {}
    for type_, name, values in objects:
        if type_.lower().startswith("schedule:"):
            schedules[name.upper()] = name
        elif type_.lower().startswith(("shading:", "gpushading:")):
            named |= {value.upper(): None for value in values}
    return [schedules[name] for name in named if name in schedules]


def _copy_named(source, folder, omitted, text):
    """The same on Windows, where links need privileges: copies of the entries whose names the text has."""
    folder.mkdir(parents=True)
    for entry in source.iterdir():
        contains_omitted = any(path == entry or entry in path.parents for path in omitted)
        if contains_omitted or entry.name.lower() not in text.lower():
            continue
        if entry.is_dir():
            shutil.copytree(entry, folder / entry.name, copy_function=shutil.copyfile)
        else:
            shutil.copyfile(entry, folder / entry.name)


def _link_contents(source, folder, omitted):
    """Creates folder with links to the entries of source. An entry that contains an omitted path becomes a folder."""
    folder.mkdir(parents=True)
    for entry in source.iterdir():
        if entry in omitted:
            continue
        if any(entry in path.parents for path in omitted):
            _link_contents(entry, folder / entry.name, omitted)
        else:
            (folder / entry.name).symlink_to(entry)


def place_copy(model, original, folder, output=()):
    """Writes model into a new folder under the original's name, with links to the files beside the original.

    Relative paths in the model and a side file MODEL.gpu-shading.idf therefore still work. Paths in output, which the
    script writes, and folders that contain one are not linked.
    """
    original, folder = Path(original).resolve(), Path(folder)
    omitted = {original, *(Path(path).resolve() for path in (folder, *output))}
    model = model.copy()
    model.anchor_paths(original.parent)
    if os.name == "nt":
        side_file = original.with_suffix(".gpu-shading.idf")
        beside = side_file.read_text(encoding="utf-8", errors="replace") if side_file.is_file() else ""
        _copy_named(original.parent, folder, omitted, f"{model.contents()}\n{side_file.name}\n{beside}")
    else:
        _link_contents(original.parent, folder, omitted)
    model.write(folder / original.name)
    return folder / original.name
