"""The scorer on answers whose scores are known, and on files that cannot be scored."""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import score
import submission

LABELS = {
    "a": {"cause": "none", "accepted": ["none"], "parameters": {"n": 1.2, "resistance_shunt": 400.0}},
    "b": {"cause": "none", "accepted": ["none"], "parameters": {"power_lost": 0.0}},
    "c": {"cause": "shade", "accepted": ["shade"], "parameters": {"power_lost": 0.2}},
    "d": {"cause": "mismatch", "accepted": ["mismatch", "shade"], "parameters": {"power_lost": 0.1}},
    "e": {"cause": "light", "accepted": ["light"], "parameters": {}},
}


def answer(cause, probability=None, **parameters):
    return {"cause": cause, "probability": probability, "parameters": parameters}


class Scores(unittest.TestCase):
    def test_every_share_counts_what_it_says(self):
        scores = score.score({"a": answer("none"), "b": answer("sensor"), "c": answer("shade"), "d": answer("shade"),
                              "e": answer("abstain")}, LABELS)
        counted = {name: (scores[name]["count"], scores[name]["of"]) for name in
                   ("right", "right_name", "false_cause", "missed", "wrong_name", "abstained")}
        self.assertEqual(counted, {"right": (3, 5), "right_name": (2, 3), "false_cause": (1, 2), "missed": (0, 3),
                                   "wrong_name": (0, 3), "abstained": (1, 5)})
        self.assertEqual(scores["by_cause"]["light"]["count"], 0)

    def test_a_fault_called_none_is_missed_and_one_called_otherwise_is_a_wrong_name(self):
        scores = score.score({"a": answer("none"), "b": answer("none"), "c": answer("none"), "d": answer("shunt"),
                              "e": answer("light")}, LABELS)
        self.assertEqual((scores["missed"]["count"], scores["wrong_name"]["count"]), (1, 1))

    def test_abstaining_on_a_clean_curve_is_neither_right_nor_a_false_cause(self):
        scores = score.score({key: answer("abstain") for key in LABELS}, LABELS)
        self.assertEqual((scores["false_cause"]["count"], scores["right"]["count"]), (0, 0))

    def test_brier_and_tenths_are_of_answers_with_a_probability_that_do_not_abstain(self):
        calibration = score.score({"a": answer("none", 0.9), "b": answer("none", 1.0), "c": answer("light", 0.5),
                                   "d": answer("abstain", 0.3), "e": answer("light")}, LABELS)["calibration"]
        self.assertAlmostEqual(calibration["brier_of_stated"]["value"], (0.01 + 0 + 0.25) / 3)
        self.assertEqual(calibration["brier_of_stated"]["of"], 3)
        self.assertEqual(calibration["stated"], {"count": 3, "of": 4})
        self.assertEqual([(b["from"], b["right"]["count"], b["right"]["of"]) for b in calibration["bins"]],
                         [(0.5, 0, 1), (0.9, 2, 2)])

    def test_a_brier_score_of_chosen_answers_is_not_given_for_comparison(self):
        sure = {key: answer("none", 1.0 if key == "a" else None) for key in LABELS}
        sure["b"] = answer("none", 1.0)
        scores = score.score(sure, LABELS)
        self.assertIsNone(scores["calibration"]["brier"])
        self.assertEqual(scores["calibration"]["brier_of_stated"]["value"], 0)
        self.assertTrue(score.table([("sure", scores)]).endswith("| - (2 of 5 stated) |"))
        self.assertIn("Brier score of the 2 of 5 answers that state a probability: 0.000 (0.000 to 0.000), not to be compared",
                      score.detail(scores))
        all_state = score.score({key: answer("none", 0.5) for key in "abcd"} | {"e": answer("abstain")}, LABELS)
        self.assertTrue(score.table([("all", all_state)]).endswith("| 0.250 (0.250 to 0.250); 4 of 4 stated |"))

    def test_parameters_have_errors_by_their_measure_and_coverage_of_given_intervals(self):
        answers = {key: answer("none") for key in LABELS}
        answers["a"] = answer("none", n={"value": 1.32}, resistance_shunt={
            "value": 500.0, "low_95": 300.0, "high_95": math.inf})
        answers["c"] = answer("shade", power_lost={"value": 0.25, "low_95": 0.24, "high_95": 0.26})
        answers["d"] = answer("shade", power_lost={"value": 0.11, "low_95": 0.05, "high_95": 0.15})
        parameters = score.score(answers, LABELS)["parameters"]
        self.assertAlmostEqual(parameters["n"]["median_error"], 0.1)
        self.assertEqual(parameters["n"]["coverage"]["of"], 0)
        self.assertAlmostEqual(parameters["resistance_shunt"]["median_error"], 0.2)
        self.assertEqual(parameters["resistance_shunt"]["coverage"]["count"], 1)
        self.assertEqual((parameters["power_lost"]["answered"], parameters["power_lost"]["asked"]), (2, 2))
        self.assertAlmostEqual(parameters["power_lost"]["median_error"], 0.03)
        self.assertEqual((parameters["power_lost"]["coverage"]["count"], parameters["power_lost"]["coverage"]["of"]), (1, 2))
        self.assertAlmostEqual(score.error_of(math.e, 1.0, "log"), 1.0)
        self.assertEqual(score.error_of(0.0, 1.0, "log"), math.inf)

    def test_exact_limits_are_those_of_the_binomial(self):
        for (k, n), (low, high) in {(0, 39): (0, 0.0903), (17, 20): (0.6211, 0.9679), (5, 10): (0.1871, 0.8129),
                                    (20, 20): (0.8316, 1)}.items():
            found = score.exact_limits(k, n)
            self.assertAlmostEqual(found[0], low, 4)
            self.assertAlmostEqual(found[1], high, 4)
        self.assertEqual(score.exact_limits(0, 0), (0.0, 1.0))

    def test_mcnemar_counts_curves_that_only_one_is_right_on(self):
        self.assertAlmostEqual(score.mcnemar(1, 9), 22 / 1024)
        self.assertEqual(score.mcnemar(0, 0), 1.0)
        self.assertEqual(score.mcnemar(4, 4), 1.0)
        first = {key: answer("none") for key in LABELS}
        second = {**first, "c": answer("shade"), "a": answer("light")}
        result = score.compare(first, second, LABELS)
        self.assertEqual((result["first_only"], result["second_only"]), (1, 1))


GOOD = '{"id":"a","cause":"none","probability":0.7}\n'


class Files(unittest.TestCase):
    def error_of(self, text, name="answers.jsonl"):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.write_text(text, encoding="utf-8")
            with self.assertRaises(submission.AnswerError) as caught:
                submission.read_answers(path)
            return str(caught.exception)[len(str(path)):]

    def test_an_error_names_line_field_and_what_was_expected(self):
        for text, expected in {
                "": ":1: empty; expected a row a curve",
                '{"id":"a","cause":"none","probability":1.2}': ":1: probability: expected a number from 0 to 1, got 1.2",
                GOOD + '{"id":"b","cause":"none","probability":NaN}':
                    ":2: probability: expected a finite number, got nan",
                GOOD + '{"id":"b","cause":"ghost"}': ":2: cause: unknown 'ghost'; known are none, shade",
                GOOD + '{"cause":"none"}': ":2: id: missing",
                GOOD + '{"id":"b"}': ":2: cause: missing",
                GOOD + '{"id":"b","cause":3}': ":2: cause: expected a text, got 3",
                GOOD + '{"id":"b","causelist":"none"}': ":2: causelist: unknown; meant may be cause; known are id, cause",
                '{"id":"a","cause":"none","probability":"0.5"}': ":1: probability: expected a number, got '0.5'",
                '{"id":"a","cause":"none","parameters":{"n":{"value":"1.2"}}}': ":1: parameters.n.value: expected a number, got '1.2'",
                '[\n{"id":"a","cause":"none"}\n]': ":1: expected JSON Lines (an object a line, no array",
                GOOD + "\n" + GOOD: ":3: id: a again; first in line 1",
                GOOD + "{not JSON": ":2: not JSON",
                GOOD + '{"id":"b","cause":"none","size":1}': ":2: size: unknown; known are id",
                '{"id":"a","cause":"none","parameters":{"n":1.2}}': ":1: parameters.n: expected an object",
                '{"id":"a","cause":"none","parameters":{"N":{"value":1}}}': ":1: parameters.N: unknown; known are photo",
                '{"id":"a","cause":"none","parameters":{"n":{"value":1,"low_95":2,"high_95":1}}}':
                    ":1: parameters.n: low_95 2 above high_95 1",
                '{"id":"a","cause":"none","parameters":{"n":{"value":-1}}}':
                    ":1: parameters.n.value: expected a number from 0 to inf, got -1",
                '{"id":"a","cause":"none","parameters":{"n":{"value":true}}}':
                    ":1: parameters.n.value: expected a number, got True"}.items():
            self.assertIn(expected, self.error_of(text), text)

    def test_tables_are_checked_alike(self):
        for text, expected in {
                "id,cause\na,none\na,shade\n": ":3: id: a again; first in line 2",
                "id,cause\n": ":1: no rows; expected one a curve",
                "id,probability\na,1\n": ":1: cause: column missing",
                "id,cause,colour\na,none,red\n": ":1: colour: unknown column; known are id, cause, probability, photo",
                "id,cause,probabilty\na,none,1\n": ":1: probabilty: unknown column; meant may be probability;",
                "id;cause\na;none\n": ":1: expected JSON Lines (an object a line) or a table whose first line names its columns "
                                       "between commas: id,cause,probability; got 'id;cause'",
                "id,cause,n\na,none,nan\n": ":2: parameters.n.value: expected a finite number, got nan",
                "id,cause,probability\na,none,high\n": ":2: probability: expected a number, got 'high'",
                "id,cause,n\na,none\n": ":2: expected 3 columns, got 2",
                "id,cause,n_low_95\na,none,1\n": ":2: parameters.n: expected an object with \"value\""}.items():
            self.assertIn(expected, self.error_of(text, "answers.csv"), text)

    def test_a_table_and_json_lines_give_the_same_answers(self):
        with tempfile.TemporaryDirectory() as folder:
            table, lines = pathlib.Path(folder) / "a.csv", pathlib.Path(folder) / "a.jsonl"
            table.write_text("id,cause,probability,n,n_low_95,n_high_95\na,none,0.7,1.2,1.1,\nb,abstain,,,,\n",
                             encoding="utf-8")
            lines.write_text('{"id":"a","cause":"none","probability":0.7,"parameters":{"n":{"value":1.2,"low_95":1.1,'
                             '"high_95":null}}}\n{"id":"b","cause":"abstain"}\n', encoding="utf-8")
            self.assertEqual(submission.read_answers(table), submission.read_answers(lines))
            self.assertEqual(submission.read_answers(table)["a"]["parameters"]["n"]["high_95"], math.inf)

    def test_a_missing_curve_is_an_error_of_the_file_and_no_line_of_it(self):
        with self.assertRaisesRegex(submission.AnswerError, "^x.csv: id: 1 of 2 curves have no row, first b; expected a row a curve"):
            submission.of_these({"a": answer("none")}, {"a": {}, "b": {}}, "x.csv")

    def test_an_unknown_curve_is_an_error_with_its_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.jsonl"
            path.write_text(GOOD + '{"id":"z","cause":"none"}\n', encoding="utf-8")
            with self.assertRaisesRegex(submission.AnswerError, r"a\.jsonl:2: id: unknown 'z'; expected that of a curve of .*: open, lab$"):
                submission.read_answers(path, {"a": "lab", "b": "open"})

    def test_curves_of_all_parts_are_known_without_a_key(self):
        parts = list(submission.known_ids().values())
        self.assertEqual([parts.count(part) for part in submission.PARTS], [250, 46, 26, 250])


class Program(unittest.TestCase):
    def run_on(self, text, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.jsonl"
            path.write_text(text, encoding="utf-8")
            run = subprocess.run([sys.executable, "-B", score.__file__, "a.jsonl", *arguments], cwd=folder, capture_output=True, text=True)
            return run, path.read_text(encoding="utf-8")

    def test_what_cannot_be_scored_ends_with_1_and_prints_no_table(self):
        rows = [f'{{"id":"{key}","cause":"none"}}\n' for key, part in submission.known_ids().items() if part == "open"]
        for text, expected in {"".join(rows[1:]): "a.jsonl: id: 1 of 250 curves have no row, first ",
                               "".join(rows) + '{"id":"z","cause":"none"}\n': "a.jsonl:251: id: unknown 'z'"}.items():
            for arguments in (("--parts", "open"), ("--parts", "open", "--check")):
                run, _ = self.run_on(text, *arguments)
                self.assertEqual((run.returncode, run.stdout), (1, ""))
                self.assertIn(expected, run.stderr)
        run, _ = self.run_on("".join(rows), "--parts", "open", "--check")
        self.assertEqual(run.stdout, "a.jsonl: 250 rows, can be scored on open\n")
        run, _ = self.run_on("".join(rows), "--parts", "closed", "--check")
        self.assertIn("250 of 250 curves have no row", run.stderr)

    def test_scores_do_not_replace_what_is_read(self):
        for place in ("a.jsonl", "./a.jsonl", str(submission.HERE / "open_labels.jsonl")):
            run, kept = self.run_on(GOOD, "--parts", "open", "--json", place)
            self.assertEqual((run.returncode, kept), (2, GOOD))
            self.assertIn(f"--json {place}: would replace what is read; expected another file", run.stderr)


if __name__ == "__main__":
    unittest.main()
