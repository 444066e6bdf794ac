#!/usr/bin/env python3
"""What the site offers for download works for a stranger: in a folder of its own, without the project.

    archive_test.py SITE

Runs every example of the archive there, which has the data that code of the pages names; the first one without Matplotlib and
pandas, with the digits of the command. The notebooks hold what their cells printed and drew.
"""

import html
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
SITE = pathlib.Path(sys.argv.pop()).resolve()
ENVIRONMENT = {key: value for key, value in os.environ.items() if key != "LYREFIT_ROOT"}
WITHOUT = "import runpy, sys; sys.modules.update(dict.fromkeys(['matplotlib', 'pandas', 'scipy'])); runpy.run_path('fit.py')"


def data_in_code(page):
    """Paths below data/ in the code of a page, without those that stand for any (VERSION.json)."""
    for code in re.findall(r"<pre.*?</pre>", page, re.S):
        for name in re.findall(r"(?<![\w/.-])data/[\w./-]*\w", html.unescape(re.sub("<[^>]*>", "", code))):
            if not pathlib.Path(name).stem.isupper():
                yield name


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

    def run_command(self, *arguments):
        return subprocess.run([os.environ["LYREFIT_COMMAND"], *arguments], cwd=self.place, capture_output=True, text=True,
                              check=True).stdout

    def test_examples(self):
        examples = sorted(self.place.glob("*.py"))
        self.assertEqual(len(examples), 16)
        for file in examples:
            with self.subTest(file.name):
                page = (SITE / "gallery" / f"{file.stem}.html").read_text(encoding="utf-8")
                without = f"import runpy, sys; sys.modules['pandas'] = None; runpy.run_path('{file.name}')"
                self.assertTrue(self.run_python(*([file.name] if "It needs pandas" in page else ["-c", without])))
                self.assertRegex(page, rf"_images/sphx_glr_{file.stem}_\d+.png")
                self.assertIn("sphx-glr-script-out", page)

    def test_what_code_of_the_pages_names_of_data_is_there(self):
        named = {}
        for page in sorted(SITE.rglob("*.html")):
            where = page.relative_to(SITE)
            if where.parts[0] != "cpp":
                named |= dict.fromkeys(data_in_code(page.read_text(encoding="utf-8")), where)
        self.assertTrue({"data/rtc_france", "data/pwp201", "data/paper/rows.csv"} <= set(named), named)
        self.assertEqual({name: where for name, where in named.items() if not self.has(name)}, {})

    def has(self, name):
        """Reports name a file without its ending."""
        return (self.place / name).exists() or any((self.place / name).parent.glob(f"{pathlib.Path(name).name}.*"))

    def test_rows_of_a_publication_find_their_curves(self):
        said = json.loads(self.run_command("audit", "data/paper/rows.csv", "--json", "-"))
        self.assertEqual(len(said["findings"]), 40)

    def test_it_is_small_and_has_the_licence(self):
        self.assertLess((SITE / "_static" / "lyrefit-examples.zip").stat().st_size, 10e6)
        self.assertEqual((self.place / "LICENSE").read_text(encoding="utf-8"), (ROOT / "LICENSE").read_text(encoding="utf-8"))
        self.assertRegex((SITE / "start.html").read_text(encoding="utf-8"), r'<a [^>]*href="[^"]+LICENSE"')

    def test_first_needs_numpy_alone(self):
        printed = self.run_python("-c", WITHOUT)
        fitted = json.loads(self.run_command("fit", "data/rtc_france", "--json", "-"))
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
