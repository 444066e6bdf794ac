#!/usr/bin/env python3
"""Makes the made curves of the benchmark.

    make.py open --out FOLDER                  the open half: public seed, curves and labels
    make.py closed --out FOLDER --key-file F   the closed half: a secret seed, curves, labels encrypted under a new key
    make.py unlock --key-file F [--labels FILE]    the closed labels, decrypted and held against their digest

The open half is the same every time. The closed half is new every time: its seed is made here, and is kept with its
labels in the encrypted file only, so that whoever has the key can make it again (`make.py remake --key-file F`).
"""

import argparse
import gzip
import hashlib
import io
import json
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import sweep  # noqa: E402
from submission import closed_text  # noqa: E402

OPEN_SEED = b"lyrefit benchmark 1, open half"
HALF = 250
LABELS = HERE / "labels" if (HERE / "labels").is_dir() else HERE  # in the archive, in the repository
CIPHER = ["openssl", "enc", "-aes-256-cbc", "-pbkdf2", "-iter", "200000", "-md", "sha256"]


def half(seed, count=HALF):
    """Records and truths of a half, in the order of their ids, which tell nothing."""
    pairs = sorted((sweep.made_curve(seed, number) for number in range(count)), key=lambda pair: pair[0]["id"])
    return [record for record, _ in pairs], [truth for _, truth in pairs]


def lines(rows):
    return "".join(json.dumps(row, separators=(",", ":")) + "\n" for row in rows)


def packed(text):
    """gzip without time or name, so that equal text is equal bytes."""
    buffer = io.BytesIO()
    with gzip.GzipFile(fileobj=buffer, mode="wb", mtime=0, compresslevel=9) as file:
        file.write(text.encode())
    return buffer.getvalue()


def encrypted(text, key_file):
    run = subprocess.run([*CIPHER, "-salt", "-a", "-pass", f"file:{key_file}"], input=text.encode(),
                         capture_output=True, check=True)
    return run.stdout


def make_open(out):
    records, truths = half(OPEN_SEED)
    (out / "open.jsonl.gz").write_bytes(packed(lines(records)))
    (out / "open_labels.jsonl").write_text(lines(truths), encoding="utf-8")


def make_closed(out, key_file):
    if key_file.exists():
        sys.exit(f"{key_file} exists: a new half would make it useless")
    key_file.touch(mode=0o600)
    key_file.write_text(os.urandom(32).hex() + "\n", encoding="utf-8")
    seed = os.urandom(32)
    records, truths = half(seed)
    text = lines([{"seed": seed.hex()}, *truths])
    (out / "closed.jsonl.gz").write_bytes(packed(lines(records)))
    (out / "closed_labels.enc").write_bytes(encrypted(text, key_file))
    digest = hashlib.sha256(text.encode()).hexdigest()
    (out / "closed_labels.enc.sha256").write_text(f"{digest}  closed_labels.jsonl\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("open", "closed", "unlock", "remake"))
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    parser.add_argument("--key-file", type=pathlib.Path)
    parser.add_argument("--labels", type=pathlib.Path, default=LABELS / "closed_labels.enc")
    given = parser.parse_args()
    if given.what != "open" and given.key_file is None:
        parser.error(f"{given.what} needs --key-file")
    if given.what == "open":
        make_open(given.out)
    elif given.what == "closed":
        make_closed(given.out, given.key_file)
    else:
        try:
            text = closed_text(given.labels, given.key_file.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            sys.exit(str(error))
        if given.what == "unlock":
            sys.stdout.write(text)
            return
        records, _ = half(bytes.fromhex(json.loads(text.splitlines()[0])["seed"]))
        (given.out / "closed.jsonl.gz").write_bytes(packed(lines(records)))


if __name__ == "__main__":
    main()
