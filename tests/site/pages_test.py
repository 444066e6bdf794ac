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
        verbs = re.findall(r"^  (\w+) +", said("--help").split("Subcommands:\n")[1].split("\n\n")[0], re.M)
        self.assertIn("audit", verbs)
        for verb in verbs:
            text = text_of(f"verbs/{verb}.html")
            for block in re.split(r"\n{2,}", said(verb, "--help").strip())[1:]:
                for line in block.split("\n"):
                    for part in re.split(r" {2,}", line.strip()):
                        if part not in ("-h,--help", "Print this help message and exit", "Options:"):
                            self.assertIn(" ".join(part.removesuffix(":").split()), text, verb)


if __name__ == "__main__":
    unittest.main()
