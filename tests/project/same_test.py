"""cmake/same on programs that are no builds of the command: equal ones, and ones that differ in each way."""

import contextlib
import io
import os
import pathlib
import re
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake" / "same"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake" / "stable"))

import same
from case import Case, Step
from corpus import KINDS, NAMES, corpus_cases
from rounding import Rounding, rounding

SAME = 'echo "$@"; echo "{\\"seconds\\": $RANDOM.5}" > out.json; echo "took 0.$RANDOM s"; echo "  $((RANDOM % 99)) ms |"; \
echo a,search_seconds,b > out.csv; echo 1,0.$RANDOM,3 >> out.csv; cat given.txt; exit 2'


class Same(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, name, script):
        file = self.folder / name
        file.write_text(f"#!/bin/bash\n{script}\n", encoding="utf-8")
        file.chmod(file.stat().st_mode | stat.S_IXUSR)
        return file

    def found(self, new, limit=20.0, old=SAME, **more):
        case = Case("fit/one", (Step(("fit", "given.txt")),), (("given.txt", "hello\n"),))
        work = self.folder / f"work{len(os.listdir(self.folder))}"
        work.mkdir()
        [(_, _, found)] = same.compare([case], self.program("old", old), self.program("new", new), {}, work, limit=limit,
                                        **more)
        return found

    def test_equal_programs_are_the_same_but_for_durations(self):
        self.assertEqual(self.found(SAME), [])

    def test_each_kind_of_difference_is_named(self):
        for new, what in ((SAME.replace("exit 2", "exit 1"), "exit code"),
                          (SAME.replace('"$@"', "$1"), "standard output"),
                          (SAME + "; true", None),
                          (SAME.replace("exit 2", "echo no >&2; exit 2"), "standard error"),
                          (SAME.replace("{\\\"seconds", "{\\\"minutes"), "file out.json"),
                          (SAME.replace("exit 2", "touch more; exit 2"), "file more")):
            self.assertEqual([name for name, _ in self.found(new)], [what] if what else [])

    def test_a_limit_is_told(self):
        self.assertEqual(self.found("sleep 60", limit=0.5)[0][0], "time")
        self.assertIsNone(self.found("sleep 60", limit=0.5, old="sleep 60"))

    def test_rounding_is_told_apart_where_it_is_asked_for(self):
        old = 'echo "Rs 0.250000 ohm"; echo "{\\"Rs\\": 0.25}" > out.json'
        new = 'echo "Rs 0.250001 ohm"; echo "{\\"Rs\\": 0.2500000000001}" > out.json'
        self.assertEqual([what for what, _ in self.found(new, old=old)], ["standard output", "file out.json"])
        found = self.found(new, old=old, relative=1e-9)
        self.assertEqual((found.numbers, found.last_digits), (2, 1))
        self.assertAlmostEqual(found.largest, 4e-13, delta=1e-15)
        self.assertEqual([what for what, _ in self.found(new + "; exit 1", old=old, relative=1e-9)], ["exit code"])
        self.assertEqual(self.found(old, old=old, relative=1e-9), [])

    def test_rounding_fails_no_comparison_and_a_difference_does(self):
        cases = [Case(f"fits/{number}", (Step(("fit",)),)) for number in range(4)]
        found = [[], Rounding(3, 2e-12, 0), Rounding(1, 5e-11, 1), [("exit code", ["1"])]]
        results = [(case, [1.0, 2.0], each) for case, each in zip(cases, found)]
        for some, code in ((results[:3], 0), (results, same.DIFFERENT)):
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                self.assertEqual(same.report(some, {}, pathlib.Path("old"), pathlib.Path("new"), {}, 1e-9), code)
            self.assertRegex(said.getvalue(), rf"fits +{len(some)} +1 +2 +{len(some) - 3} ")
            self.assertIn("equal but for rounding 2, 4 numbers, the largest difference 5.0e-11 (fits/2)", said.getvalue())

    def test_faults_of_a_sanitized_build_are_named(self):
        case = Case("fit/one", (Step(("fit",)),))
        for number, (script, what) in enumerate((("exit 2", []), ("kill -ABRT $$", ["exit code"]), ("sleep 60", None),
                                                 ("echo '==1==ERROR: AddressSanitizer: overflow' >&2", ["standard error"]),
                                                 ("echo 'a.cc:1:2: runtime error: shift' >&2; exit 1", ["standard error"]))):
            work = self.folder / f"sanitized{number}"
            work.mkdir()
            [(_, _, found)] = same.compare([case], self.program("one", script), None, {}, work, limit=2.0)
            self.assertEqual(found if found is None else [name for name, _ in found], what)

    def test_cases_name_every_verb(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        verbs = {case.verb for case in same.all_cases(root, {"data": root / "data"})}
        pages = {page.stem for page in (root / "apps/lyrefit/verbs").glob("*.md")}
        self.assertLessEqual(pages - verbs, {"family", "merge", "README", "walks"})  # of fit and of batch; an index; many verbs


class Within(unittest.TestCase):
    """What is rounding of 1e-9, and what is not."""

    def told(self, old, new, what="standard output"):
        return rounding(what, old.encode(), new.encode(), 1e-9) is not None

    def test_printed_numbers_differ_by_one_in_the_last_digit(self):
        for old, new, told in (("Rs 0.25000 ohm", "Rs 0.25001 ohm", True), ("Rs 0.25000 ohm", "Rs 0.25002 ohm", False),
                               ("9.99 %", " 10.0 %", True), ("-0", "0", True), ("9.9 %", "9.8 %", False),  # too few digits
                               ("1 warning", "2 warnings", False), ("1000 points", "1001 points", False),
                               ("Rs 0.25000 ohm", "Rs 0.25001 V", False), ("a 0.25000\n", "a 0.25001\nb", False)):
            self.assertEqual(self.told(old, new), told, (old, new))

    def test_numbers_of_json_and_tables_have_all_digits(self):
        for old, new, told in (("1.0", "1.0000000005", True), ("1.0", "1.000000002", False), ("1.25", "1.26", False),
                               ("100", "101", False), ("1.0", "null", False), ("1.5", "1.5000000000000002", True)):
            self.assertEqual(self.told(f'{{"a": {old}}}', f'{{"a": {new}}}', "file a.json"), told, (old, new))
            self.assertEqual(self.told(f"a,b\n1,{old}\n", f"a,b\n1,{new}\n", "file a.csv"), told, (old, new))
        self.assertFalse(self.told('{"a": 1.5}', '{"b": 1.5}'))
        self.assertFalse(self.told('{"a": 1.5}', '{"a":  1.5}'))
        self.assertFalse(self.told('{"a": [1.5]}', '{"a": [1.5, 1.5]}'))
        self.assertTrue(self.told('{"a": "Rs 0.2500"}', '{"a": "Rs 0.2501"}'))
        self.assertFalse(self.told("a\n1.5\n", "a\n1.5\n1.5\n", "file a.csv"))

    def test_near_zero_numbers_agree_unless_they_are_saturation_currents(self):
        for old, new, told in (('{"mean_A": 1e-16}', '{"mean_A": -3e-16}', True), ('{"mean_A": 1e-9}', '{"mean_A": 2e-9}', False),
                               ('{"saturation_current": {"refined": 1e-16}}', '{"saturation_current": {"refined": 2e-16}}', False),
                               ('{"symbol": "Is1", "value": 1e-16}', '{"symbol": "Is1", "value": 2e-16}', False),
                               ("RMSE 1.1e-16 A", "RMSE 2.3e-16 A", True), ("Is1 1.1e-16 A", "Is1 2.3e-16 A", False)):
            self.assertEqual(self.told(old, new), told, (old, new))
        self.assertTrue(self.told("Rs,rmse_A\n1,1e-16\n", "Rs,rmse_A\n1,2e-16\n", "file a.csv"))
        self.assertFalse(self.told("Rs,Is1_A\n1,1e-16\n", "Rs,Is1_A\n1,2e-16\n", "file a.csv"))

    def test_what_is_no_text_is_different(self):
        self.assertIsNone(rounding("file a.png", b"\xff\x01", b"\xff\x02", 1e-9))


class Corpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cases = corpus_cases()

    def test_each_kind_has_its_cases_and_they_are_the_same_each_time(self):
        self.assertEqual([sum(case.verb == name for case in self.cases) for name in NAMES], list(KINDS.values()))
        self.assertEqual(len({case.name for case in self.cases}), len(self.cases))
        for kinds in (["cells"], ["fits", "tandems"]):
            self.assertEqual(corpus_cases(kinds), [case for case in self.cases if case.verb in kinds])

    def test_cases_read_what_they_are_given_or_have_made(self):
        for case in self.cases:
            there = {name for name, _ in case.given}
            for step in case.steps:
                read = {word for word in step.arguments[1:] if re.fullmatch(r"[\w/]+\.(csv|json|state)", word)}
                written = {word for flag, word in zip(step.arguments, step.arguments[1:])
                           if flag in ("--out", "--json", "--csv", "--extend", "--answers", "--sam", "--pvlib", "--append")}
                self.assertLessEqual(read - written, there, case.name)
                self.assertFalse(written & there - {"kept.state"}, case.name)
                there |= written

    def test_every_case_writes_what_it_found(self):
        for case in self.cases:
            self.assertIn("--json", case.steps[-1].arguments)


if __name__ == "__main__":
    unittest.main()
