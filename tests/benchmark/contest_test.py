"""The score of the contest's entry: on made tables, and the entry's own where the test sets are there."""

import os
import pathlib
import tempfile
import unittest

try:
    import contest_score
except ImportError:
    contest_score = None

HEAD = "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_series\n"
DEVICES = ["1,1,5e-10,0.1,300,1.01,72\n", "2,8,5e-10,0.1,3000,1.3,72\n"]
ENTRY = pathlib.Path(os.environ["LYREFIT_ROOT"]) / "data" / "benchmark" / "contest"


def write(folder, exact, noisy):
    for name in ("case1", "case2"):
        (folder / f"{name}.csv").write_text(HEAD + "".join(exact), encoding="utf-8")
    for name in ("case3a", "case3b", "case3c", "case3d"):
        (folder / f"{name}.csv").write_text(HEAD + noisy, encoding="utf-8")


@unittest.skipUnless(contest_score, "python3-mpmath is missing")
class Scores(unittest.TestCase):
    def scored(self, exact, noisy):
        with tempfile.TemporaryDirectory() as truth, tempfile.TemporaryDirectory() as entry:
            write(pathlib.Path(truth), DEVICES, DEVICES[0])
            write(pathlib.Path(entry), exact, noisy)
            return contest_score.score(pathlib.Path(entry), pathlib.Path(truth))

    def test_the_truth_has_no_distance_but_at_the_last_point_where_it_is_rounding(self):
        scores = self.scored(DEVICES, DEVICES[0])
        self.assertLess(scores["case1"]["elsewhere"], 1e-30)
        self.assertAlmostEqual(scores["case1"]["at_voc"], scores["case1"]["counted_1"])
        self.assertEqual(scores["case3a"]["score"], 0)

    def test_a_photocurrent_one_percent_high_is_a_hundredth_at_short_circuit_and_less_beyond(self):
        off = ["1,1.01,5e-10,0.1,300,1.01,72\n", DEVICES[1]]
        elsewhere = self.scored(off, DEVICES[0])["case1"]["elsewhere"]
        self.assertGreater(elsewhere, 0.01)  # the point at 0 V alone
        self.assertLess(elsewhere, 0.01 + 8 * 0.01 * 2 ** 0.5)  # on a ray the voltage is off by as much as the current

    def test_a_noisy_set_sums_parts_of_the_true_values(self):
        off = "1,1.01,6e-10,0.09,330,1.01,72\n"
        self.assertAlmostEqual(self.scored(DEVICES, off)["case3b"]["score"], 0.01 + 0.2 + 0.1 + 0.1)

    def test_other_indices_are_an_error(self):
        with self.assertRaisesRegex(ValueError, r"expected the indices \[1, 2\], got \[1\]"):
            self.scored(DEVICES[:1], DEVICES[0])

    def test_the_page_has_the_scores_of_the_tables_beside_it(self):
        truth = pathlib.Path(os.environ.get("LYREFIT_FIELD_DATA") or "-") / "ivcurves"
        if not truth.is_dir():
            self.skipTest("needs the contest's test sets")
        page = (ENTRY / "README.md").read_text(encoding="utf-8")
        for name, scores in contest_score.score(ENTRY / "entry", truth).items():
            row = next(line for line in page.splitlines() if line.startswith(f"| {name}"))
            self.assertIn(f"| {scores['score']:.4f} |", row)
            if "elsewhere" in scores:
                self.assertIn(f"| {scores['at_voc']:.0f} | {scores['elsewhere']:.1e} |".replace("e-0", "e-"), row)


if __name__ == "__main__":
    unittest.main()
