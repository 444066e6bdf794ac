"""cmake/sizes.py on small trees: a module that fits, one that has grown, one that links more, names without a module."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SIZES = pathlib.Path(__file__).resolve().parents[2] / "cmake" / "sizes.py"


class Sizes(unittest.TestCase):
    def run_on(self, ceilings, *flags):
        root = pathlib.Path(self.folder.name)
        for file, text in {
            "lib/modules.cmake": "lyrefit_module(base)  # first\nlyrefit_module(fit FOLDER estimate/fit LINK base WITH x)\n",
            "lib/CMakeLists.txt": "set(LYREFIT_CORE base fit)\n",
            "lib/lyrefit/base/a.h": "1\n2\n",
            "lib/lyrefit/estimate/fit/a.cc": "1\n2\n3\n",
            "cmake/sizes.txt": ceilings,
        }.items():
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            (root / file).write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", str(SIZES), "--root", str(root), *flags],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_counts_lines_and_closure(self):
        code, said = self.run_on("# most\nbase 2 2\nfit 3 5\ncore 5 5\n")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"fit +3 +3 +5 +5")

    def test_names_what_is_too_large(self):
        code, said = self.run_on("base 2 2\nfit 2 5\ncore 5 5\n")
        self.assertEqual(code, 1)
        self.assertRegex(said, r"fit .*too large")
        code, said = self.run_on("base 2 2\nfit 3 4\ncore 5 5\n")
        self.assertEqual(code, 1)
        self.assertRegex(said, r"fit .*too large")

    def test_names_what_has_no_ceiling_and_what_is_gone(self):
        code, said = self.run_on("base 2 2\ncore 5 5\nattic 1 1\n")
        self.assertEqual(code, 1)
        self.assertIn("fit: no ceiling", said)
        self.assertIn("attic, which is no module", said)

    def test_lowers_and_never_raises(self):
        self.run_on("# most\nbase 9 9\nfit 2 9\ncore 9 9\n", "--lower")
        file = pathlib.Path(self.folder.name) / "cmake" / "sizes.txt"
        self.assertEqual([line.split() for line in file.read_text(encoding="utf-8").splitlines()],
                         [["#", "most"], ["base", "2", "2"], ["fit", "2", "5"], ["core", "5", "5"]])

    def test_says_where_a_line_is_wrong(self):
        code, said = self.run_on("base two 2\n")
        self.assertEqual(code, 1)
        self.assertIn("sizes.txt:1: expected a module", said)


if __name__ == "__main__":
    unittest.main()
