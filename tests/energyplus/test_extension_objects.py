"""The extension objects as the dictionary, the epJSON schema, the reader and the documents have them."""

import json
import os
import random
import re
import subprocess
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import fastjsonschema
import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("GPU_SHADING_BUILD", "build")
DICTIONARY = ROOT / "energyplus_patch" / "model" / "extensions" / "GPUShading.idd"
GENERATED = BUILD / "energyplus_patch" / "model" / "generated" / "model" / "extensions"
READER = BUILD / "tests" / "energyplus_patch" / "read_extension_objects"

SCHEMA = json.loads((GENERATED / "GPUShading.schema.epJSON").read_text(encoding="utf-8"))
TYPES = list(SCHEMA["properties"])


def instance_schema(object_type):
    return next(iter(SCHEMA["properties"][object_type]["patternProperties"].values()))


def is_named(object_type):
    return "name" in SCHEMA["properties"][object_type]


def valid_value(schema):
    """One that the schema of a field accepts."""
    if "anyOf" in schema:
        return valid_value(schema["anyOf"][0])
    if "enum" in schema:
        return schema["enum"][-1]
    if schema["type"] == "array":
        return [{key: valid_value(item) for key, item in schema["items"]["properties"].items()}]
    if schema["type"] == "string":
        return "Some text"
    low = schema.get("minimum", schema.get("exclusiveMinimum", -1))
    high = schema.get("maximum", schema.get("exclusiveMaximum", low + 2))
    return low + 1 if schema["type"] == "integer" else (low + high) / 2


def limits(schema):
    return [schema[name] for part in [schema, *schema.get("anyOf", [])]
            for name in ("minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum") if name in part
            for schema in [part]]


def tried_values(schema):
    """Values on both sides of what the schema of a field says, and of every other JSON type."""
    values = [valid_value(schema), 0, 1, -1, 2.5, 3.0, 1e308, -1e308, 5e-324, "", " ", "x", "0.5", "7", "1e3", "nan",
              "inf", "Auto", None, True, False, [], {}, [1], {"a": 1}]
    for limit in limits(schema):
        values += [limit, limit + 1, limit - 1, limit * (1 + 1e-9), limit * (1 - 1e-9), str(limit)]
    for part in [schema, *schema.get("anyOf", [])]:
        for word in part.get("enum", []):
            values += [word, word + "x", word.swapcase()]
    if schema.get("type") == "array":
        key, item = next(iter(schema["items"]["properties"].items()))
        each = valid_value(item)
        values += [[{key: each}] * 3, [{}], [{key: each, "more": 1}], [{"more": each}], [{key: None}], [{key: [1]}],
                   [{key: ""}], [{key: 1}, {key: 2.5}], [{key: each}, 3], [each], {"0": {key: each}}, each]
    return values


def instances(object_type):
    """[{name: fields}]: an object as the schema has it, and changed in one way or two."""
    schema = instance_schema(object_type)
    fields = schema["properties"]
    full = {key: valid_value(field) for key, field in fields.items()}
    least = {key: full[key] for key in schema.get("required", [])}
    found = [{"A": full}, {"A": least}, {"A": {}}, {"A": {**least, "no_such_field": 1}}, {"A": None}, {"A": []},
             {"A": "x"}, {"": least}, {" ": least}, {"A": least, "B": least}, {}]
    changed = random.Random(object_type)
    for key, field in fields.items():
        found.append({"A": {each: value for each, value in full.items() if each != key}})
        for value in tried_values(field):
            found.append({"A": {**least, key: value}})
            other = changed.choice(list(fields))
            found.append({"A": {**full, key: value, other: changed.choice(tried_values(fields[other]))}})
    return found


def read(form, models):
    """The verdict of the reader on each model: "ok", or the message."""
    done = subprocess.run([READER, form], input="".join(model + "\n" for model in models), capture_output=True,
                          text=True, check=True)
    verdicts = done.stdout.splitlines()
    assert len(verdicts) == len(models)
    return verdicts


@pytest.mark.parametrize("object_type", TYPES)
def test_the_schema_accepts_what_the_reader_accepts(object_type):
    models = [{object_type: each} for each in [*instances(object_type), [], "x", None, 3]]
    validate = fastjsonschema.compile(SCHEMA)
    accepted = 0
    for model, verdict in zip(models, read("epjson", [json.dumps(model) for model in models]), strict=True):
        try:
            validate(model)
            expected = "ok"
            accepted += 1
        except fastjsonschema.JsonSchemaValueException as error:
            expected = error.message
        assert (verdict == "ok") == (expected == "ok"), f"{model}: schema: {expected}; reader: {verdict}"
        assert verdict == "ok" or verdict.startswith(object_type), verdict
    assert 20 < accepted < len(models) - 20


def scalars(value, schema):
    """[(value, its schema)] of a field, or of the items of an array."""
    if schema.get("type") != "array":
        return [(value, schema)]
    items = schema["items"]["properties"]
    return [(item[key], items[key]) for item in value if isinstance(item, dict) for key in item if key in items] \
        if isinstance(value, list) else []


def idf(object_type, name, fields):
    """As IDF; None where that cannot be: fields that it does not know, values that would be other fields."""
    known = SCHEMA["properties"][object_type]["legacy_idd"]
    array = known.get("extension")
    values = [name if key == "name" else fields.get(key, "") for key in known["fields"]]
    if array in fields:
        items = fields[array]
        if not isinstance(items, list) or not all(isinstance(item, dict) and list(item) == known["extensibles"]
                                                  for item in items):
            return None
        values += [item[known["extensibles"][0]] for item in items]
    if not set(fields) <= {*known["fields"], array}:
        return None
    if any(isinstance(value, bool | list | dict | None) for value in values):
        return None
    return ",".join([object_type, *map(str, values)]) + ";"


@pytest.mark.parametrize("object_type", TYPES)
def test_idf_is_read_as_epjson_is(object_type):
    """But for the case of words, for numbers in quotes and for blanks about text, which an IDF does not have."""
    fields = instance_schema(object_type)["properties"]
    pairs = []
    for each in instances(object_type):
        if list(each) != ["A"] or not isinstance(each["A"], dict):
            continue
        values = [value for value in each["A"].values() if isinstance(value, str)]
        words = {word for field in fields.values() for part in [field, *field.get("anyOf", [])]
                 for word in part.get("enum", [])}
        without_case = {word.lower() for word in words}
        # Every field is text in an IDF.
        if any(isinstance(value, int | float) and schema.get("type") == "string"
               for key, schema in fields.items() if key in each["A"]
               for value, schema in scalars(each["A"][key], schema)):
            continue
        if any(value != value.strip() or value not in words and value.lower() in without_case or value == "7"
               or re.fullmatch(r"[-\d.e+]+", value) for value in values):
            continue
        # A blank list item at the end is no item, and a blank number no number.
        text = idf(object_type, "A", each["A"])
        if text is None or "" in each["A"].values() or ",;" in text:
            continue
        pairs.append(({object_type: each}, text))
    assert len(pairs) > min(30, 4 * len(fields))
    verdicts = zip(pairs, read("epjson", [json.dumps(model) for model, _ in pairs]),
                   read("idf", [text for _, text in pairs]), strict=True)
    for (model, text), of_epjson, of_idf in verdicts:
        assert (of_epjson == "ok") == (of_idf == "ok"), f"{model}: {of_epjson}; {text}: {of_idf}"


@pytest.mark.parametrize("object_type", TYPES)
def test_words_are_read_in_any_case_from_an_idf(object_type):
    schema = instance_schema(object_type)
    least = {key: valid_value(schema["properties"][key]) for key in schema.get("required", [])}
    texts = [idf(object_type, "A", {**least, key: change(word)})
             for key, field in schema["properties"].items() for part in [field, *field.get("anyOf", [])]
             for word in part.get("enum", []) for change in (str.upper, str.lower, str.title)]
    assert set(read("idf", texts)) <= {"ok"}


def test_every_field_is_read():
    """Each one's entry is used by code, not by the list of all of them alone; `name` is what an object goes by."""
    archives = list((BUILD / "energyplus_patch").rglob("libenergyplus_*.a"))
    assert len(archives) > 5
    listed = subprocess.run(["nm", "--demangle", "--undefined-only", *archives], capture_output=True, text=True,
                            check=True).stdout
    used = set(re.findall(r"\bU gpu_shading::energyplus::extension::(\w+)::(\w+)", listed))
    header = (GENERATED / "extension_fields.h").read_text(encoding="utf-8").split("namespace extension {\n")[1]
    declared = {(scope, field) for scope, body in re.findall(r"^namespace (\w+) \{\n(.*?)^\}  // namespace \1$", header,
                                                             re.M | re.S)
                for field in re.findall(r"^extern Field<.*> const (\w+);$", body, re.M)}
    assert len(declared) > 50
    assert declared - used == {(scope, "name") for scope, field in declared if field == "name"}
    assert used <= declared


def test_the_schema_has_the_shape_of_energyplus_s_own(official):
    own = json.loads((official.parent / "Energy+.schema.epJSON").read_text(encoding="utf-8"))
    assert SCHEMA["$schema"] == own["$schema"]
    known = {"object": set(), "field": set(), "legacy": set()}
    for found in own["properties"].values():
        known["object"] |= set(found)
        known["legacy"] |= set(found["legacy_idd"])
        for field in next(iter(found["patternProperties"].values())).get("properties", {}).values():
            known["field"] |= set(field)
    for name, found in SCHEMA["properties"].items():
        assert set(found) <= known["object"], name
        assert set(found["legacy_idd"]) <= known["legacy"], name
        assert set(found["legacy_idd"]["field_info"]) == {
            *found["legacy_idd"]["fields"], *found["legacy_idd"].get("extensibles", [])}
        for key, field in instance_schema(name)["properties"].items():
            # EnergyPlus lets a required text be blank.
            assert set(field) - {"pattern"} <= known["field"], key


def test_generated_files_are_the_same_each_time(tmp_path):
    for folder in ("a", "b"):
        subprocess.run([ROOT / "scripts" / "dev" / "extension_objects", "code", tmp_path / folder], check=True)
    for path in sorted((tmp_path / "a").iterdir()):
        text = path.read_bytes()
        assert text == (tmp_path / "b" / path.name).read_bytes() == (GENERATED / path.name).read_bytes()
        assert text.isascii() and text.endswith(b"\n") and b"\r" not in text
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "a").iterdir()}
    subprocess.run([ROOT / "scripts" / "dev" / "extension_objects", "code", tmp_path / "a"], check=True)
    assert before == {path: path.stat().st_mtime_ns for path in (tmp_path / "a").iterdir()}


@pytest.mark.parametrize(("old", "new", "message"), [
    ("  N1 , \\field Resolution", "  N2 , \\field Resolution", "N2 is out of order"),
    ("\\minimum 1\n", "\\mininum 1\n", "is not one of the slash codes"),
    ("\\default 0.001", "\\default 0.2", "is beyond \\maximum 0.1"),
    ("\\default Centre", "\\default Front", "is no \\key"),
    ("\\key Square", "\\key Round", "a \\key is given twice"),
    ("\\type integer", "\\type float", "\\type is float"),
    ("\\field Pitch", "\\field Hole Size", "two fields have one name"),
    ('array "values" in epJSON', "values", "go together"),
    ("  A4 ; \\field Reflections", "  A4 , \\field Reflections", "does not end with ;"),
    ("\\maximum 65536", "", "an integer has both limits"),
])
def test_mistakes_in_the_dictionary_are_refused(old, new, message):
    loader = SourceFileLoader("extension_objects", str(ROOT / "scripts" / "dev" / "extension_objects"))
    script = module_from_spec(spec_from_loader(loader.name, loader))
    sys.modules[loader.name] = script
    loader.exec_module(script)
    text = DICTIONARY.read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(script.DictionaryError, match=re.escape(message)):
        script.read_dictionary(text.replace(old, new, 1))
