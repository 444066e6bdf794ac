"""What is promised within a major version, by the list data/stable/promised.txt; everything else is experimental."""

import pathlib
import re
from typing import NamedTuple

from comparison import alternatives

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = ROOT / "data" / "stable" / "promised.txt"
KINDS = ("header", "schema", "verb", "python")


class Part(NamedTuple):
    """What the list says of a header, a schema, a verb, or a function or class of Python."""

    left_out: set  # names in it that are experimental
    includes: dict  # experimental headers that it includes, each with the reason


def read(text):
    """The parts of a list: of each kind by their names."""
    parts = {kind: {} for kind in KINDS}
    part = None
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split(maxsplit=1)
        if not words or line.startswith("#"):
            continue
        if not line.startswith(" ") and words[0] in KINDS and words[1] not in parts[words[0]]:
            part = parts[words[0]].setdefault(words[1], Part(set(), {}))
        elif line.startswith("  ") and part and words[0] == "except":
            part.left_out.add(words[1])
        elif line.startswith("  ") and part and words[0] == "includes" and ": " in words[1]:
            header, reason = words[1].split(": ", 1)
            part.includes[header] = reason
        else:
            raise ValueError(f"line {number}: {line}")
    return parts


def promised():
    """The parts of the list of this version."""
    return read(LIST.read_text(encoding="utf-8"))


def _within(name, parts):
    """Whether a name is one of the names, or a part of one: `a::b` and `a(int)` of `a`, `a.b` and `a[]` too."""
    return any(name == part or (name.startswith(part) and re.match(r"::|[(.\[ ]", name[len(part):])) for part in parts)


def of_headers(entries, headers):
    """The entries of promised headers, without the declarations in them that are experimental."""
    left_out = {name for part in headers.values() for name in part.left_out}
    return {name: entry for name, entry in entries.items() if not _within(name, left_out)}


def of_schemas(entries, schemas):
    """The entries of promised schemas, without the fields in them that are experimental."""
    kept = {}
    for name, entry in entries.items():
        schema, path = re.match(r"(\w+)\.?(.*)", name).groups()
        part = schemas.get(f"{schema}.json")
        if part and not _within(path, part.left_out):
            kept[name] = entry
    return kept


def of_flags(entries, verbs):
    """The entries of promised verbs and of exit codes, without the flags that are experimental."""
    kept = {}
    for name, entry in entries.items():
        verb, flag = re.match(r"([a-z]+)[( ]?([^) ]*)", name).groups()
        if verb == "exit" or verb in verbs and flag not in verbs[verb].left_out:
            kept[name] = entry
    return kept


def of_python(entries, names):
    """The entries of promised functions and classes, without the arguments and members that are experimental.

    Types lose the alternatives that are experimental classes: these may go.
    """
    classes = {name for name, entry in entries.items() if entry.type.startswith("class ") and name not in names}
    kept = {}
    for name, entry in entries.items():
        owner, part = re.match(r"(\w+)[.(]?([^)]*)", name).groups()
        if owner in names and part not in names[owner].left_out:
            types = alternatives(entry.type)
            if types & classes:
                entry = entry._replace(type=" | ".join(sorted(types - classes, key=entry.type.index)))
            kept[name] = entry
    return kept
