#!/usr/bin/env python3
"""Gathers the benchmark into an archive that is the same to the byte whenever its contents are.

    pack.py OUT.tar.gz [--field FOLDER]

Without --field (the folder of the CMake option LYREFIT_FIELD_DATA) the measured curves are left out, and it says so.
"""

import argparse
import gzip
import hashlib
import io
import json
import pathlib
import sys
import tarfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import make  # noqa: E402
import measured  # noqa: E402

NAME = "lyrefit-benchmark-1"
PROGRAMS = ("score.py", "submission.py", "simulator.py", "recipe.py", "faults.py", "sweep.py", "make.py")


def read(path):
    return (HERE / path).read_bytes()


def sources_of(left_out_measured):
    rows = [f"{name}: {licence}, copyright {holder}; {what}" for name, (licence, holder, what) in measured.SOURCES.items()]
    rows += ["", "The made curves, the scorer and the labels: BSD-3-Clause, the lyrefit authors (LICENSE)", "", "Left out:"]
    rows += [f"{name}: {why}" for name, why in measured.LEFT_OUT.items()]
    if left_out_measured:
        rows += ["", "This archive was made without the measured curves."]
    return "\n".join(rows) + "\n"


def contents(field):
    """Bytes by path inside the archive."""
    files = {"README.md": read("README.md"), "LICENSE": (HERE.parent.parent / "LICENSE").read_bytes(),
             "SOURCES.txt": sources_of(field is None).encode()}
    for name in PROGRAMS:
        files[name] = read(name)
    for licence in sorted((HERE / "LICENSES").iterdir()):
        files[f"LICENSES/{licence.name}"] = licence.read_bytes()
    for half in ("open", "closed"):
        files[f"curves/{half}.jsonl"] = gzip.decompress(read(f"{half}.jsonl.gz"))
    for name in ("closed_labels.enc", "closed_labels.enc.sha256", "open_labels.jsonl"):
        files[f"labels/{name}"] = read(name)
    for path in sorted((HERE / "contest").rglob("*")):
        if path.suffix in (".md", ".py", ".sh", ".json", ".txt", ".csv"):
            files[path.relative_to(HERE).as_posix()] = path.read_bytes()
    if field is not None:
        for part, (records, truths) in measured.measured(field).items():
            if make.lines(truths).encode() != read(f"{part}_labels.jsonl"):
                raise ValueError(f"{part}_labels.jsonl is not what {field} gives: make it again")
            files[f"curves/{part}.jsonl"] = make.lines(records).encode()
            files[f"labels/{part}_labels.jsonl"] = make.lines(truths).encode()
    curves = {json.loads(line)["id"] for path in files if path.startswith("curves/") for line in files[path].splitlines()}
    for answers in sorted((HERE / "answers").iterdir()):  # to the curves of this archive
        rows = answers.read_text(encoding="utf-8").splitlines(keepends=True)
        files[f"answers/{answers.name}"] = "".join(row for row in rows if json.loads(row)["id"] in curves).encode()
    listed = "".join(f"{hashlib.sha256(files[path]).hexdigest()}  {path}\n" for path in sorted(files))
    files["SHA256SUMS"] = listed.encode()
    return files


def archive(files):
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb", mtime=0, compresslevel=9) as compressed:
        with tarfile.open(fileobj=compressed, mode="w", format=tarfile.USTAR_FORMAT) as tar:
            for path in sorted(files):
                entry = tarfile.TarInfo(f"{NAME}/{path}")
                entry.size, entry.mode = len(files[path]), 0o755 if path.endswith(("score.py", "make.py", ".sh")) else 0o644
                tar.addfile(entry, io.BytesIO(files[path]))
    return packed.getvalue()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--field", type=pathlib.Path)
    given = parser.parse_args()
    try:
        files = contents(given.field)
    except (OSError, ValueError) as error:
        sys.exit(str(error))
    data = archive(files)
    given.out.parent.mkdir(parents=True, exist_ok=True)
    given.out.write_bytes(data)
    print(f"{given.out}: {len(files)} files, {len(data) / 1e6:.2f} MB, sha256 {hashlib.sha256(data).hexdigest()}"
          + ("" if given.field else "; without the measured curves (--field FOLDER)"))


if __name__ == "__main__":
    main()
