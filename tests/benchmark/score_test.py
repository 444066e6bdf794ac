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
        self.assertAlmostEqual(calibration["brier"]["value"], (0.01 + 0 + 0.25) / 3)
        self.assertEqual(calibration["brier"]["of"], 3)
        self.assertEqual([(b["from"], b["right"]["count"], b["right"]["of"]) for b in calibration["bins"]],
                         [(0.5, 0, 1), (0.9, 2, 2)])

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
                "id,cause,colour\na,none,red\n": ":1: colour: unknown column",
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

    def test_a_missing_curve_is_an_error_and_the_program_says_it_with_exit_1(self):
        with self.assertRaisesRegex(submission.AnswerError, "1 of 2 curves have no row, first b"):
            submission.of_these({"a": answer("none")}, {"a": {}, "b": {}}, "x.csv")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.jsonl"
            path.write_text(GOOD, encoding="utf-8")
            run = subprocess.run([sys.executable, "-B", score.__file__, str(path)], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("curves have no row", run.stderr)
        self.assertEqual(run.stdout, "")


if __name__ == "__main__":
    unittest.main()
