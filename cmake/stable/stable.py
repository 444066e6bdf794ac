#!/usr/bin/env python3
"""The record of what is promised, and whether this version keeps what the last one promised (data/stable).

    stable.py check   --version X.Y.Z --build FOLDER [--command FILE] [--package FOLDER]
    stable.py record  the same: writes data/stable/X.Y.Z, if the version allows what changed since the record before and
                      the record is not closed

FOLDER is a build folder with the command, the Python module and the settings of the reference pages.
"""

import argparse
import pathlib
import shutil
import sys

import comparison
import promise
from declarations import declarations
from json_fields import fields
from names import command_flags, python_package
from reported import reported

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORDS = ROOT / "data" / "stable"
OPEN = """The record of {0} is open: `cmake/stable.sh --record` may write it anew. The commit that is tagged v{0} removes this
file, and with it closes the record.
"""


def current(given):
    """What there is now: the entries of each file of a record."""
    command = (given.command or given.build / "apps" / "lyrefit" / "lyrefit").resolve()
    parts = promise.promised()
    package = python_package(given.package or given.build / "apps" / "python" / "lyrefit", parts["python"])
    headers = declarations(given.doxygen, given.build / "reference" / "Doxyfile", ROOT,
                           [ROOT / "lib" / header for header in parts["header"]])
    return {
        "python.txt": promise.of_python(package, parts["python"]),
        "json.txt": {**promise.of_schemas(fields(ROOT / "data" / "schema"), parts["schema"]), **reported(command, ROOT)},
        "headers.txt": promise.of_headers(headers, parts["header"]),
        "flags.txt": promise.of_flags(command_flags(command, ROOT), parts["verb"]),
    }


def mark(version):
    """The file that says that the record of a version is open: --record may write it anew until the tag."""
    return RECORDS / version / "open.txt"


def last_record(before=None):
    """The version of the last record, or of the last one below `before`; empty where there is none."""
    versions = [folder.name for folder in RECORDS.iterdir() if folder.is_dir()]
    if before:
        versions = [version for version in versions if comparison.number(version) < comparison.number(before)]
    return max(versions, key=comparison.number, default="")


def differences(version, now):
    """What is broken and what is new since the record of a version, by file."""
    broken, changed = [], []
    for file, entries in now.items():
        before = comparison.read((RECORDS / version / file).read_text(encoding="utf-8"))
        lost, new = comparison.compare(before, entries)
        broken += [f"{file}: {text}" for text in lost]
        changed += [f"{file}: {name}" for name in new]
    return broken, changed


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["check", "record"])
    parser.add_argument("--version", required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--command", type=pathlib.Path)
    parser.add_argument("--package", type=pathlib.Path)
    parser.add_argument("--doxygen", default=shutil.which("doxygen"))
    given = parser.parse_args(arguments)
    if not given.doxygen:
        sys.exit("doxygen is not there")
    now = current(given)
    for file, entries in now.items():
        if not entries:
            sys.exit(f"nothing was read for {file}")
    record = given.what == "record"
    if record and (RECORDS / given.version).is_dir() and not mark(given.version).is_file():
        sys.exit(f"the record of {given.version} is closed")
    before = last_record(given.version if record else None)
    if before:
        broken, changed = differences(before, now)
        print(*broken, *(f"new: {name}" for name in changed), sep="\n")
        print(f"since {before}: {len(broken)} broken, {len(changed)} new or wider")
        # Until a release the version may stay: its number is raised where names were added when it is recorded.
        why = comparison.too_low(before, given.version, broken, changed if record else [])
        if why:
            sys.exit(why + (", or write the record anew: it is open" if mark(before).is_file() else ""))
    if record:
        folder = RECORDS / given.version
        folder.mkdir(exist_ok=True)
        for file, entries in now.items():
            (folder / file).write_text(comparison.written(entries), encoding="utf-8")
            print(f"{folder.relative_to(ROOT) / file}: {len(entries)} entries")
        mark(given.version).write_text(OPEN.format(given.version), encoding="utf-8")


if __name__ == "__main__":
    main()
