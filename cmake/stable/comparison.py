"""The rules of the promise (data/stable): what a later release may do to what an earlier one had.

A line of a record is NAME, KIND, TYPE, NOTES, with tabs between them; the two last may be empty.
  input   what a caller gives: its type may gain alternatives, not lose one; a new one must be optional
          unless what it is given to is new too
  output  what a caller gets: its type may lose alternatives, not gain one
  exact   its type stays
Notes are words that a caller relies on (optional, always, argument-1): they may be gained, not lost. Nothing goes.
"""

from typing import NamedTuple


class Entry(NamedTuple):
    kind: str
    type: str = ""
    notes: frozenset = frozenset()


def alternatives(type_text):
    """The alternatives of `int | list[str | None]`: those outside of all brackets."""
    parts, depth = [""], 0
    for letter in type_text:
        depth += (letter in "[(<") - (letter in "])>")
        if letter == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return {part.strip() for part in parts}


def read(text):
    """The entries of a record by their names."""
    entries = {}
    for line in text.splitlines():
        name, kind, type_text, notes = line.split("\t")
        entries[name] = Entry(kind, type_text, frozenset(notes.split()))
    return entries


def written(entries):
    """The text of a record, sorted by names."""
    lines = ("\t".join([name, e.kind, e.type, " ".join(sorted(e.notes))]) for name, e in entries.items())
    return "".join(line + "\n" for line in sorted(lines))


def _broken(before, now):
    """Why an entry does not keep what it was; empty where it does."""
    if before.kind != now.kind:
        return f"was {before.kind}, is {now.kind}"
    old, new = alternatives(before.type), alternatives(now.type)
    kept = {"input": old <= new, "output": new <= old, "exact": before.type == now.type}[before.kind]
    if not kept:
        return f"was {before.type or 'nothing'}, is {now.type or 'nothing'}"
    lost = before.notes - now.notes
    return f"is no longer {' '.join(sorted(lost))}" if lost else ""


def owner(name):
    """`fit` of the input `fit(model)`, what it is given to."""
    return name[: name.rindex("(")] if name.endswith(")") else ""


def compare(before, now):
    """What is broken, a sentence each, and the names that are new or changed."""
    broken, changed = [], []
    for name, entry in sorted(before.items()):
        if name not in now:
            broken.append(f"{name} is gone")
        elif why := _broken(entry, now[name]):
            broken.append(f"{name} {why}")
        elif entry != now[name]:
            changed.append(name)
    for name in sorted(now.keys() - before.keys()):
        entry = now[name]
        if entry.kind == "input" and "optional" not in entry.notes and owner(name) in before:
            broken.append(f"{name} is new and not optional")
        else:
            changed.append(name)
    return broken, changed


def number(version):
    """(1, 2, 0) of "1.2.0"."""
    return tuple(int(part) for part in version.split("."))


def too_low(before, now, broken, changed):
    """Why version `now` after `before` does not allow what is broken or changed; empty where it does."""
    old, new = number(before), number(now)
    if new < old:
        return f"version {now} is below the last record, {before}"
    if broken and new[0] == old[0]:
        return f"what version {before} promised is broken: mend it, or raise the major version"
    if changed and new[:2] == old[:2]:
        return f"there are names that {before} does not have: raise the minor version"
    return ""
