#!/usr/bin/env python3
"""Pages of the site have titles that tell them apart, and a page of a verb has all that its help says.

    pages_test.py SITE
"""

import collections
import os
import pathlib
import re
import subprocess
import sys
import unittest

import bs4

SITE = pathlib.Path(sys.argv.pop()).resolve()


def said(*arguments):
    return subprocess.run([os.environ["LYREFIT_COMMAND"], *arguments], capture_output=True, text=True, check=True).stdout


def text_of(page):
    return " ".join(bs4.BeautifulSoup((SITE / page).read_bytes(), "html.parser").find(role="main").get_text().split())


class Pages(unittest.TestCase):
    def test_titles_tell_pages_apart(self):
        titles = collections.defaultdict(list)
        for page in sorted(SITE.rglob("*.html")):
            name = page.relative_to(SITE).as_posix()
            if not name.startswith(("cpp/", "_static/")):
                titles[bs4.BeautifulSoup(page.read_bytes(), "html.parser").title.text.split(" \u2014 ")[0]].append(name)
        self.assertGreater(len(titles), 100)
        self.assertEqual({title: names for title, names in titles.items() if len(names) > 1 or title in ("", "<no title>")}, {})

    def test_all_of_the_help_of_a_verb_is_on_its_page(self):
        verbs = re.findall(r"^  (\w+) +", said("--help").split("Subcommands:\n")[1].split("\nAbout lyrefit:")[0], re.M)
        self.assertIn("audit", verbs)
        for verb in verbs:
            text = text_of(f"verbs/{verb}.html")
            for block in re.split(r"\n{2,}", said(verb, "--help").strip())[1:]:
                for line in block.split("\n"):
                    for part in re.split(r" {2,}", line.strip()):
                        if part not in ("-h,--help", "Print this help message and exit", "Options:"):
                            self.assertIn(" ".join(part.removesuffix(":").split()), text, verb)

    def test_every_method_that_a_report_names_has_its_paper(self):
        rows = bs4.BeautifulSoup((SITE / "cite.html").read_bytes(), "html.parser").find_all("tr")
        papers = {name.text: row.find_all("td")[1].text for row in rows if row.td for name in row.td.find_all("code")}
        listed = " ".join(said("compare", "--help").split()).partition("--algorithms LIST list of ")[2].partition(" (")[0]
        procedures = " ".join(said("translate", "--help").split()).partition("those to compute: ")[2].partition(",extended")[0]
        names = re.findall(r"[\w+]+", listed) + re.findall(r"iec\d|desoto|pvsyst", procedures.partition(" (default")[0])
        self.assertTrue({"mlo", "de", "iec4"} <= set(names), names)
        self.assertEqual([name for name in names if not papers.get(name)], [])
        self.assertIn("doi:10.3390/biomimetics8060507", papers["lo"])


if __name__ == "__main__":
    unittest.main()
