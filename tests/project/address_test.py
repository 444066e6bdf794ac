#!/usr/bin/env python3
"""Every place says the address of cmake/address.cmake: that of this repository, and of a copy of it that has one."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

import yaml

from release_test import citation_faults

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))
import address  # noqa: E402

EXAMPLE = "https://example.org/lyrefit"


class Address(unittest.TestCase):
    def setUp(self):
        self.copy = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for place in ("cmake/address.cmake", *address.PLACES):
            (self.copy / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / place, self.copy / place)

    def texts(self):
        return {place: (self.copy / place).read_text(encoding="utf-8") for place in address.PLACES}

    def run_on_copy(self, *arguments):
        return subprocess.run([sys.executable, "-B", ROOT / "cmake" / "address.py", "--root", self.copy, *arguments],
                              capture_output=True, text=True, check=False)

    def set(self, *settings):
        file = self.copy / "cmake/address.cmake"
        text = file.read_text(encoding="utf-8")
        for name, value in settings:
            text, found = re.subn(rf'^set\(LYREFIT_{name} ".*"\)$', f'set(LYREFIT_{name} "{value}")', text, flags=re.M)
            self.assertEqual(found, 1, name)
        file.write_text(text, encoding="utf-8")

    def test_every_place_agrees(self):
        self.assertEqual(subprocess.run([ROOT / "cmake" / "address.py"], check=False).returncode, 0)

    def test_every_place_has_an_address_that_is_set(self):
        self.set(("ADDRESS", EXAMPLE))
        checked = self.run_on_copy()
        self.assertNotEqual(checked.returncode, 0)
        for place in address.PLACES:
            self.assertIn(place, checked.stderr)
        self.assertEqual(self.run_on_copy("--write").returncode, 0)
        self.assertEqual(self.run_on_copy().returncode, 0)
        said = self.texts()
        for place, text in said.items():
            self.assertIn(EXAMPLE, text, place)
            self.assertNotRegex(text, "published yet", place)
        urls = tomllib.loads(said["apps/python/pyproject.toml"])["project"]["urls"]
        self.assertEqual((urls["Homepage"], urls["Issues"]), (EXAMPLE, f"{EXAMPLE}/issues"))
        citation = yaml.safe_load(said[".github/CITATION.cff"])
        self.assertEqual((citation["url"], citation["repository-code"]), (EXAMPLE, f"{EXAMPLE}.git"))
        self.assertEqual(citation_faults(citation), [])
        links = yaml.safe_load(said[".github/ISSUE_TEMPLATE/config.yml"])["contact_links"]
        self.assertEqual([set(link) for link in links], [{"name", "url", "about"}])
        self.assertIn(f"git clone {EXAMPLE}.git\n", said["README.md"])

    def test_an_address_that_there_is_not_is_left_out(self):
        self.set(("ADDRESS", EXAMPLE), ("SITE", ""), ("TRACKER", "https://example.org/questions"))
        self.assertEqual(self.run_on_copy("--write").returncode, 0)
        said = self.texts()
        self.assertNotIn("contact_links", said[".github/ISSUE_TEMPLATE/config.yml"])
        self.assertNotIn(f"{EXAMPLE}/site", "".join(said.values()))
        self.assertIn("https://example.org/questions", said["README.md"])

    def test_without_one_a_place_has_no_link_and_readme_says_how_to_make_it(self):
        before = self.texts()
        self.set(("ADDRESS", EXAMPLE))
        self.run_on_copy("--write")
        self.set(("ADDRESS", ""))
        self.assertEqual(self.run_on_copy("--write").returncode, 0)
        for place, (say, _, _) in address.PLACES.items():
            self.assertNotIn("http", say(address.addresses(self.copy)), place)
        for script in ("wheel", "packages", "site"):
            self.assertRegex(self.texts()["README.md"], rf"`cmake/{script}\.sh`[^`]*\(\d+")
        if not address.addresses(ROOT)["address"]:
            self.assertEqual(self.texts(), before)

    def test_the_command_says_it(self):
        """What `lyrefit` prints, of the sources that make it, compiled with an address and with none."""
        program = self.copy / "first.cc"
        program.write_text('#include <cstdio>\n#include "about.h"\n#include "verbs.h"\n'
                           'const char lyrefit::kLeftOut[] = "";\nint main() { std::puts(lyrefit::FirstPage().c_str()); }\n',
                           encoding="utf-8")
        for at in (EXAMPLE, ""):
            self.set(("ADDRESS", at))
            values = address.addresses(self.copy)
            subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-O0", f"-I{ROOT}/lib", f"-I{ROOT}/apps/lyrefit/line",
                            *(f'-DLYREFIT_{name.upper()}="{value}"' for name, value in values.items()), '-DLYREFIT_VERSION=""', program,
                            ROOT / "apps/lyrefit/line/first_page.cc", ROOT / "lib/lyrefit/base/version.cc", "-o", self.copy / "first"],
                           check=True)
            said = subprocess.run([self.copy / "first"], capture_output=True, text=True, check=True).stdout
            self.assertEqual([value in said for value in (values["address"] or "http", values["tracker"] or "http")],
                             [bool(at)] * 2, said)


if __name__ == "__main__":
    unittest.main()
