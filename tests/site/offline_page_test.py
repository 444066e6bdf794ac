#!/usr/bin/env python3
"""The first line of the site's index leads to the page that needs no server, or says how to build it.

    offline_page_test.py SITE

LYREFIT_PAGE is where that page is, if it is built. Both ways are also tried on a site of one page.
"""

import os
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "apps" / "site"))
sys.dont_write_bytecode = True
import offline_page  # noqa: E402

SITE = pathlib.Path(sys.argv.pop()).resolve()


class OfflinePage(unittest.TestCase):
    def line(self, site):
        """The line, which comes before any other paragraph."""
        text = (site / "index.html").read_text(encoding="utf-8")
        main = text[text.index("<h1>"):]
        line = re.search(r"<p\b.*?</p>", main, re.S)[0]
        self.assertIn('id="offline-page"', line)
        return line

    def check(self, site):
        line, page = self.line(site), site / "_static" / "lyrefit.html"
        if not page.is_file():
            self.assertIn("cmake/web.sh --build", line)
            self.assertNotIn("href", line)
            return False
        self.assertIn('href="_static/lyrefit.html"', line)
        self.assertIn(f"one file of {page.stat().st_size / 1e6:.1f} MB", line)
        return True

    def test_the_site(self):
        built = self.check(SITE)
        page = pathlib.Path(os.environ["LYREFIT_PAGE"])
        if built and page.is_file():
            said = re.search(r"one file of ([\d.]+) MB", page.read_text(encoding="utf-8"))
            self.assertEqual(said[1], f"{page.stat().st_size / 1e6:.1f}")

    def test_both_ways(self):
        with tempfile.TemporaryDirectory() as folder:
            site, page = pathlib.Path(folder) / "site", pathlib.Path(folder) / "page.html"
            (site / "_static").mkdir(parents=True)
            (site / "index.html").write_text('<h1>lyrefit</h1>\n<p id="offline-page">before</p><p>more</p>')
            offline_page.put(page, site)
            self.assertFalse(self.check(site))
            page.write_text("x" * 1234567)
            offline_page.put(page, site)
            self.assertTrue(self.check(site))
            self.assertIn("one file of 1.2 MB", self.line(site))
            (site / "index.html").write_text("<h1>lyrefit</h1>")
            with self.assertRaises(SystemExit):
                offline_page.put(page, site)


if __name__ == "__main__":
    unittest.main()
