"""Every field of the JSON records, read from their schemas: SCHEMA.PATH with its type.

`*` stands for any key, `[]` for every element. Of a field with listed values each value is an entry of its own. A record
inside another one is an entry whose type is its schema.
"""

import json
import pathlib

from comparison import Entry


def _resolved(schema, file, files):
    """A schema with its references followed, and the file where its own ones start; parts of `allOf` are merged."""
    while "$ref" in schema:
        place, _, path = schema["$ref"].partition("#")
        file = place or file
        target = files[file]
        for key in path.strip("/").split("/") if path.strip("/") else []:
            target = target[key]
        schema = {**target, **{key: value for key, value in schema.items() if key != "$ref"}}
    if "allOf" in schema:
        merged = {key: value for key, value in schema.items() if key != "allOf"}
        for part in schema["allOf"]:
            part, file = _resolved(part, file, files)
            merged["properties"] = {**merged.get("properties", {}), **part.get("properties", {})}
            merged["required"] = [*merged.get("required", []), *part.get("required", [])]
            merged = {**part, **merged}
        schema = merged
    return schema, file


def _walk(schema, path, always, file, files, entries, open_references=()):
    reference = schema.get("$ref")
    if reference and (reference, file) in open_references:
        return  # it holds itself: its fields stand at the outer one
    if reference in files and "." in path:  # a whole record: its fields stand there
        entries[path] = Entry("output", reference, frozenset(["always"] if always else []))
        return
    if reference:
        open_references = (*open_references, (reference, file))
    schema, file = _resolved(schema, file, files)
    types = schema.get("type", [])
    types = set([types] if isinstance(types, str) else types)
    variants = schema.get("anyOf", [])
    for variant in variants:
        resolved, _ = _resolved(variant, file, files)
        found = resolved.get("type", "object" if "properties" in resolved else [])
        types |= set([found] if isinstance(found, str) else found)
    values = schema.get("enum", [schema["const"]] if "const" in schema else [])
    if values:
        types |= {"null" if value is None else "boolean" if isinstance(value, bool) else
                  "string" if isinstance(value, str) else "number" for value in values}
    old = entries.get(path)
    if old:  # another variant has it too
        types |= set(old.type.split(" | ")) - {""}
        always = always and "always" in old.notes
    entries[path] = Entry("output", " | ".join(sorted(types)), frozenset(["always"] if always else []))
    for value in values:
        if isinstance(value, str):
            entries[f"{path} = {value}"] = Entry("exact")
    for variant in variants:
        _walk(variant, path, always, file, files, entries, open_references)
    required = schema.get("required", [])
    properties = schema.get("properties", {})
    for name in dict.fromkeys([*properties, *required]):
        _walk(properties.get(name, {}), f"{path}.{name}", name in required, file, files, entries, open_references)
    for key, mark in (("additionalProperties", ".*"), ("items", "[]")):
        if isinstance(schema.get(key), dict):
            _walk(schema[key], path + mark, False, file, files, entries, open_references)


def fields(folder):
    """The entries of all schemas in a folder; common.json alone describes no record."""
    files = {file.name: json.loads(file.read_text(encoding="utf-8")) for file in pathlib.Path(folder).glob("*.json")}
    entries = {}
    for name in sorted(files.keys() - {"common.json"}):
        _walk({"$ref": name}, name.removesuffix(".json"), True, name, files, entries)
    return entries
