"""cmake/same on programs that are no builds of the command: equal ones, and ones that differ in each way."""

import os
import pathlib
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake" / "same"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake" / "stable"))

import same
from case import Case, Step

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

    def found(self, new, limit=20.0, old=SAME):
        case = Case("fit/one", (Step(("fit", "given.txt")),), (("given.txt", "hello\n"),))
        work = self.folder / f"work{len(os.listdir(self.folder))}"
        work.mkdir()
        [(_, _, found)] = same.compare([case], self.program("old", old), self.program("new", new), {}, work, limit=limit)
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


if __name__ == "__main__":
    unittest.main()
