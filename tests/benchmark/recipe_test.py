"""The made curves: the same to the bit, physically what they claim, closed where they are to be closed."""

import gzip
import hashlib
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import make
import pack
import recipe
import simulator
import submission
import sweep

FOLDER = pathlib.Path(os.environ["LYREFIT_ROOT"]) / "data" / "benchmark"


def curves(half):
    with gzip.open(FOLDER / f"{half}.jsonl.gz", "rt", encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def solved_voltage(cells, k, current, vt):
    """Terminal voltage of a cell by bisection on its junction voltage: the equation itself, not laid out."""
    def excess(v):
        reverse = min(v, 0.0) / cells["rsh"][k] * cells["breakdown_part"][k] * (
            1 - min(v, 0.0) / cells["breakdown_V"][k]) ** -cells["breakdown_m"][k]
        return (cells["photocurrent"][k] - cells["i01"][k] * math.expm1(v / (cells["n1"][k] * vt))
                - cells["i02"][k] * math.expm1(v / (2 * vt)) - v / cells["rsh"][k] - reverse - current)

    low, high = 0.999 * cells["breakdown_V"][k], 0.95
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return low - current * cells["rs"][k]


def rounded(value):
    """A label with its numbers to 12 digits: their last ones are those of the processor's exp and log."""
    if isinstance(value, dict):
        return {key: rounded(part) for key, part in value.items()}
    return float(f"{value:.12g}") if isinstance(value, float) else value


class Recipe(unittest.TestCase):
    def test_the_open_half_comes_out_the_same(self):
        """The readings, which instruments have rounded, to the bit; the labels to 12 digits."""
        published = {record["id"]: record for record in curves("open")}
        labels = submission.read_labels(["open"], FOLDER)
        for number in (0, 1, 7, 13, 20, 23, 29, 34, 101, 249):
            record, truth = sweep.made_curve(make.OPEN_SEED, number)
            self.assertEqual(published[record["id"]], record)
            self.assertEqual(rounded(labels[truth["id"]]), rounded({**json.loads(json.dumps(truth)), "part": "open"}))

    def test_another_seed_or_number_gives_another_curve(self):
        first = sweep.made_curve(make.OPEN_SEED, 3)[0]
        for other in (sweep.made_curve(make.OPEN_SEED, 5)[0], sweep.made_curve(b"another", 3)[0]):
            self.assertNotEqual(first["id"], other["id"])
            self.assertNotEqual(first["current_A"], other["current_A"])

    def test_cells_in_series_obey_their_equations(self):
        draw = recipe.Draw(b"test", 1, "curve")
        device = next(d for d in iter(lambda: recipe.draw_device(draw), None)
                      if d["groups"] == 1 and d["modules"] == 1 and not d["plain"])
        device["arrays"]["photocurrent"][2] *= 0.4  # in reverse where the others carry more
        cells = simulator.at_temperature(device["arrays"], 40.0)
        volts, amperes = simulator.group_curve(cells, 40.0)
        isc = float(np.median(cells["photocurrent"]))
        for part, resolution in ((0.1, 5e-5), (0.3, 5e-5), (0.6, 2e-4), (0.9, 2e-4)):  # a grid, coarser in reverse
            total = sum(solved_voltage(cells, k, part * isc, simulator.thermal_voltage(40.0))
                        for k in range(device["cells"]))
            self.assertAlmostEqual(float(np.interp(total, volts, amperes)) / isc, part, delta=resolution)

    def test_a_bypass_diode_carries_what_the_cells_do_not(self):
        draw = recipe.Draw(b"test", 2, "curve")
        device = next(d for d in iter(lambda: recipe.draw_device(draw), None) if d["groups"] == 1 and d["modules"] == 1)
        first = next(recipe.section_slices(device))[0]
        group = {name: array[first] for name, array in device["arrays"].items()}
        volts, total = simulator.section_curve([group], (1e-8, 1.05), 25.0)
        alone = np.interp(volts, *simulator.group_curve(group, 25.0))
        bypass = 1e-8 * np.expm1(np.minimum(-volts / (1.05 * simulator.thermal_voltage(25.0)), 80))
        self.assertLess(float(np.max(np.abs(total - alone - bypass))), 1e-9)
        self.assertGreater(float(np.interp(-0.5, volts, total)), float(np.interp(-0.5, volts, alone)) + 0.5)

    def test_every_fault_bends_its_curve_and_no_clean_one_is_bent(self):
        for truth in submission.read_labels(["open"], FOLDER).values():
            if truth["cause"] == "none":
                self.assertEqual(truth["misfit_percent_isc"], 0)
            elif truth["cause"] != "sensor":
                self.assertGreaterEqual(truth["misfit_percent_isc"], 100 * recipe.SMALLEST_MISFIT)

    def test_both_halves_have_250_curves_of_one_form_with_ids_that_tell_nothing(self):
        ids = set()
        forms = []
        for half in ("open", "closed"):
            records = curves(half)
            self.assertEqual(len(records), make.HALF)
            self.assertEqual([r["id"] for r in records], sorted(r["id"] for r in records))
            for record in records:
                self.assertRegex(record["id"], "^m[0-9a-f]{10}$")
                self.assertTrue(np.all(np.isfinite(record["voltage_V"] + record["current_A"])))
            ids |= {record["id"] for record in records}
            forms.append({key for record in records for key in record})
        self.assertEqual(len(ids), 500)
        self.assertEqual(*forms)
        causes = [truth["cause"] for truth in submission.read_labels(["open"], FOLDER).values()]
        self.assertGreaterEqual(causes.count("none"), 100)
        self.assertEqual(set(causes), set(recipe.CAUSES))
        self.assertAlmostEqual(sum(share for share, _ in recipe.CAUSES.values()), 1)


class Closed(unittest.TestCase):
    def test_a_closed_half_opens_with_its_key_alone_and_can_be_verified_and_made_again(self):
        with tempfile.TemporaryDirectory() as folder:
            out, key = pathlib.Path(folder), pathlib.Path(folder) / "key"
            kept, make.HALF = make.HALF, 2
            try:
                make.half.__defaults__ = (2,)
                make.make_closed(out, key)
            finally:
                make.HALF = kept
                make.half.__defaults__ = (kept,)
            self.assertEqual(key.stat().st_mode & 0o777, 0o600)
            text = submission.closed_text(out / "closed_labels.enc", key.read_text(encoding="utf-8"))
            rows = [json.loads(line) for line in text.splitlines()]
            again = make.half(bytes.fromhex(rows[0]["seed"]), 2)
            self.assertEqual(gzip.decompress((out / "closed.jsonl.gz").read_bytes()).decode(), make.lines(again[0]))
            self.assertEqual(make.lines(rows[1:]), make.lines(again[1]))
            with self.assertRaisesRegex(ValueError, "this key does not open the labels whose digest is [0-9a-f]{64}"):
                submission.closed_text(out / "closed_labels.enc", "no key")

    def test_the_published_labels_are_encrypted_and_have_a_digest(self):
        data = (FOLDER / "closed_labels.enc").read_bytes()
        self.assertTrue(data.startswith(b"U2FsdGVkX1"))  # "Salted__" of openssl, in base 64
        self.assertNotIn(b"shade", data)
        self.assertRegex((FOLDER / "closed_labels.enc.sha256").read_text(encoding="utf-8"),
                         r"^[0-9a-f]{64}  closed_labels\.jsonl\n$")
        key = os.environ.get("LYREFIT_BENCHMARK_KEY")
        if key:
            rows = submission.closed_text(FOLDER / "closed_labels.enc", key).splitlines()
            self.assertEqual({json.loads(row)["id"] for row in rows[1:]}, {record["id"] for record in curves("closed")})

    def test_closed_labels_without_a_key_are_an_error_that_says_how(self):
        with self.assertRaisesRegex(ValueError, "--key-file FILE or LYREFIT_BENCHMARK_KEY"):
            submission.read_labels(["closed"], FOLDER)


def field_folder():
    folder = pathlib.Path(os.environ.get("LYREFIT_FIELD_DATA") or "-")
    return folder if (folder / "lab" / "labels.csv").is_file() else None


class Archive(unittest.TestCase):
    def test_it_is_the_same_to_the_byte(self):
        files = pack.contents(field_folder())
        self.assertEqual(pack.archive(files), pack.archive(dict(reversed(files.items()))))
        for line in files["SHA256SUMS"].decode().splitlines():
            digest, path = line.split("  ")
            self.assertEqual(hashlib.sha256(files[path]).hexdigest(), digest)
        self.assertFalse([path for path in files if path.endswith("key") or path == "labels/closed_labels.jsonl"])

    def test_commands_of_its_page_run_in_it_and_a_part_that_it_has_not_is_named(self):
        for field in {None, field_folder()}:
            files = pack.contents(field)
            with tempfile.TemporaryDirectory() as folder:
                for path, data in files.items():
                    target = pathlib.Path(folder) / path
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(data)
                self.check_commands(folder, files["README.md"].decode(), has_all=field is not None)

    def check_commands(self, folder, page, has_all):
        commands = re.findall(r"^    score.py (answers/[^#\n]*)", page, re.M)
        self.assertGreater(len(commands), 4)
        for command in [*commands, "answers/lyrefit.jsonl", "answers/none.jsonl --check", "answers/none.jsonl --parts open,real"]:
            run = subprocess.run([sys.executable, "-I", "-B", f"{folder}/score.py", *command.split()], cwd=folder,
                                 capture_output=True, text=True)
            absent = re.search("real|lab", command.partition("--parts")[2])
            if absent and not has_all:
                self.assertEqual(run.returncode, 1, command)
                self.assertRegex(run.stderr, f"^part {absent.group()} is not in this archive, which has open, closed; cmake/benchmark.sh")
            else:
                self.assertEqual((run.returncode, run.stderr), (0, ""), command)
                self.assertRegex(run.stdout, r"^\| answers \||can be scored on open|^right on \d+ curves")
        for link in re.findall(r"\]\(([^)#]+)\)", page):
            self.assertTrue((pathlib.Path(folder) / link).is_file(), link)


if __name__ == "__main__":
    unittest.main()
