"""The page of the benchmark says what the scorer says of the answers beside it."""

import os
import pathlib
import re
import unittest

import measured
import score
import submission

FOLDER = pathlib.Path(os.environ["LYREFIT_ROOT"]) / "data" / "benchmark"
PAGE = (FOLDER / "README.md").read_text(encoding="utf-8")
ORDER = ("lyrefit", "lyrefit_curve", "thumb", "neighbour", "none")


def scored(parts, key=None):
    labels = submission.read_labels(parts, FOLDER, key)
    return [(name, score.score(submission.of_these(submission.read_answers(FOLDER / "answers" / f"{name}.jsonl"), labels,
                                                   name), labels)) for name in ORDER]


class Page(unittest.TestCase):
    def test_tables_of_the_open_parts_are_the_scorer_s(self):
        for parts in (["open"], ["real"], ["lab"]):
            self.assertIn(score.table(scored(parts)), PAGE, parts)

    def test_the_detail_of_our_answers_is_the_scorer_s(self):
        self.assertIn(score.detail(dict(scored(["open"]))["lyrefit"]), PAGE)

    def test_the_table_of_the_closed_part_is_the_scorer_s(self):
        key = os.environ.get("LYREFIT_BENCHMARK_KEY")
        if not key:
            self.skipTest("needs the key, LYREFIT_BENCHMARK_KEY")
        self.assertIn(score.table(scored(["closed"], key)), PAGE)

    def test_comparisons_on_the_page_are_the_scorer_s(self):
        found = re.findall(r"score.py answers/(\w+).jsonl answers/(\w+).jsonl --compare --parts (\w+)\n\n"
                           r"    right on (\d+) curves: \w+ alone (\d+), \w+ alone (\d+), exact McNemar p = (\S+)", PAGE)
        self.assertTrue(found)
        for first, second, parts, *figures in found:
            labels = submission.read_labels([parts], FOLDER)
            both = [submission.read_answers(FOLDER / "answers" / f"{name}.jsonl") for name in (first, second)]
            result = score.compare(*both, labels)
            self.assertEqual(figures, [str(result["curves"]), str(result["first_only"]), str(result["second_only"]),
                                       f"{result['p']:.2g}"])

    def test_every_source_and_what_is_left_out_stand_on_the_page(self):
        for name, (licence, _, _) in measured.SOURCES.items():
            self.assertRegex(PAGE, rf"\| .*{re.escape(name)}.* \| {re.escape(licence)} \|")
            self.assertTrue((FOLDER / "LICENSES" / f"{licence}.txt").is_file())
        for name in measured.LEFT_OUT:
            self.assertIn(name, PAGE)
        for cause in submission.CAUSES:
            self.assertIn(f"| `{cause}` |", PAGE)

    def test_measured_labels_are_those_of_the_folder_they_came_from(self):
        folder = pathlib.Path(os.environ.get("LYREFIT_FIELD_DATA") or "-")
        if not (folder / "lab" / "labels.csv").is_file():
            self.skipTest("needs measured sets")
        for part, (records, truths) in measured.measured(folder).items():
            kept = submission.read_labels([part], FOLDER)
            self.assertEqual({truth["id"]: {**truth, "part": part} for truth in truths}, kept)
            self.assertEqual([record["id"] for record in records], list(kept))


if __name__ == "__main__":
    unittest.main()
