#!/usr/bin/env python3
"""What the site offers for download works for a stranger: in a folder of its own, without the project.

    archive_test.py SITE

Runs every example of the archive there, which has the data that commands of pages name; the first one without Matplotlib and pandas, with the digits of the command. The
notebooks hold what their cells printed and drew.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake" / "reference"))
from markdown_links import pieces  # noqa: E402

SITE = pathlib.Path(sys.argv.pop()).resolve()
ENVIRONMENT = {key: value for key, value in os.environ.items() if key != "LYREFIT_ROOT"}
WITHOUT = "import runpy, sys; sys.modules.update(dict.fromkeys(['matplotlib', 'pandas', 'scipy'])); runpy.run_path('fit.py')"


class Archive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        with zipfile.ZipFile(SITE / "_static" / "lyrefit-examples.zip") as packed:
            packed.extractall(cls.folder.name)
        cls.place = pathlib.Path(cls.folder.name) / "lyrefit-examples"

    def run_python(self, *arguments):
        run = subprocess.run([sys.executable, "-B", *arguments], cwd=self.place, env=ENVIRONMENT, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_examples(self):
        examples = sorted(self.place.glob("*.py"))
        self.assertEqual(len(examples), 15)
        for file in examples:
            with self.subTest(file.name):
                self.assertTrue(self.run_python(file.name))
                page = (SITE / "gallery" / f"{file.stem}.html").read_text(encoding="utf-8")
                self.assertRegex(page, rf"_images/sphx_glr_{file.stem}_\d+.png")
                self.assertIn("sphx-glr-script-out", page)

    def test_commands_find_their_data(self):
        for page in (ROOT / "README.md", ROOT / "apps/python/README.md", *(ROOT / "apps/lyrefit/verbs").glob("*.md")):
            code = "".join(piece for is_code, piece in pieces(page.read_text(encoding="utf-8")) if is_code)
            named = set(re.findall(r"(?<![\w/])data/[\w./-]*\w", code))
            self.assertTrue(named or page.name != "README.md")
            self.assertEqual({path for path in named if (ROOT / path).exists() and not (self.place / path).exists()}, set(), page)

    def test_first_needs_numpy_alone(self):
        printed = self.run_python("-c", WITHOUT)
        said = subprocess.run([os.environ["LYREFIT_COMMAND"], "fit", "data/rtc_france", "--json", "-"], cwd=self.place,
                              capture_output=True, text=True, check=True).stdout
        fitted = json.loads(said)
        for name, parameter in fitted["parameters"].items():
            self.assertRegex(printed, rf"(?m)^{name} +{re.escape(repr(parameter['refined']))}$")

    def test_notebooks(self):
        notebooks = sorted((SITE / "_downloads").rglob("*.ipynb"))
        executed = [json.loads(file.read_text(encoding="utf-8")) for file in notebooks]
        executed = [book for book in executed if any(cell.get("outputs") for cell in book["cells"])]
        self.assertEqual(len(executed), 5)
        for book in executed:
            outputs = [output for cell in book["cells"] for output in cell.get("outputs", [])]
            self.assertFalse([output for output in outputs if output["output_type"] == "error"])
            self.assertTrue([output for output in outputs if "image/png" in output.get("data", {})])
            self.assertTrue([output for output in outputs if re.search(r"\d", "".join(output.get("text", "")))])
            self.assertNotIn("execution", json.dumps([cell["metadata"] for cell in book["cells"]]))


if __name__ == "__main__":
    unittest.main()
