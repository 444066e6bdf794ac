"""What the package shows: its types, its docstrings, its examples."""

import ast
import inspect
import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import unittest

import lyrefit
import lyrefit.pvlib
import lyrefit.searches
from helpers import ROOT
from lyrefit import _lyrefit

sys.path.insert(0, str(ROOT / "cmake" / "stable"))
import promise

PACKAGE = pathlib.Path(lyrefit.__file__).parent
STUB = ast.parse((PACKAGE / "_lyrefit.pyi").read_text())


def help_of(verb):
    return subprocess.run([os.environ["LYREFIT_COMMAND"], *verb.split(), "--help"], capture_output=True, text=True).stdout


def help_by_flag(text):
    """What a help says of each flag and argument."""
    blocks = re.split(r"^  (?=\S)", text, flags=re.MULTILINE)[1:]
    return {re.split(r"[ ,]", block)[0]: " ".join(block.split("\n\n")[0].split()) for block in blocks}


def flags_of(text):
    """The flags that a help lists, each at the beginning of a line."""
    return set(re.findall(r"^ +(--[\w-]+)", text, flags=re.MULTILINE))


class Surface(unittest.TestCase):
    def test_submodules_are_imported_where_they_are_used(self):
        code = ("import sys, lyrefit; before = [name for name in sys.modules if name.startswith('lyrefit.')]; "
                "print(sorted(before), callable(lyrefit.searches.cma_es), callable(lyrefit.pvlib.singlediode), "
                "hasattr(lyrefit, 'nothing'))")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual((run.stdout, run.stderr), ("['lyrefit._lyrefit'] True True False\n", ""))

    def test_every_name_has_a_type(self):
        declared = {node.name: node for node in STUB.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        for name in dir(_lyrefit):
            if name.startswith("_"):
                continue
            self.assertIn(name, declared, f"{name} has no stub in _lyrefit.pyi.in")
            thing = getattr(_lyrefit, name)
            if not inspect.isclass(thing) or issubclass(thing, Exception):
                continue
            members = {member.name for member in declared[name].body if isinstance(member, ast.FunctionDef)}
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    self.assertIn(member, members, f"{name}.{member} has no stub")
                    self.assertTrue(value.__doc__, f"{name}.{member} has no docstring")

    def test_every_keyword_has_a_type_and_works(self):
        stubs = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}
        for verb, keywords in _lyrefit._keywords.items():
            if verb not in stubs:
                continue
            names = {argument.arg for argument in stubs[verb].args.kwonlyargs}
            self.assertEqual(names, {name for name, *_ in keywords}, verb)
            signature = inspect.signature(getattr(lyrefit, verb))
            self.assertLessEqual(names, set(signature.parameters), verb)

    def test_every_flag_of_fit_has_a_keyword(self):
        known = {name for verb in ("fit", "simulate") for name, *_ in _lyrefit._keywords[verb]}
        other = {"cells": "cells_in_series", "with": "with_", "curve": "curve_index", "no_polish": "polish"}
        # What a file is written into or read from has no keyword, nor has what other verbs are for.
        files = {"json", "csv", "plot", "html", "brief", "verbose", "quiet", "full_json", "full_plot", "help", "list_columns",
                 "set", "from", "voltages", "out", "pvlib", "pan", "sam"}
        sections = re.split(r"^(\w[\w ]*):$", help_of("fit"), flags=re.MULTILINE)
        family = "".join(text for head, text in zip(sections[1::2], sections[2::2]) if head.startswith("Family"))
        self.assertIn("--family", family)
        flags = flags_of(help_of("fit")) - flags_of(family) | flags_of(help_of("simulate"))
        self.assertGreater(len(flags), 40)
        for flag in flags:
            name = flag[2:].replace("-", "_")
            if name not in files:
                self.assertIn(other.get(name, name), known, flag)

    def test_exactly_what_is_not_promised_says_that_it_is_experimental(self):
        """The list in data/stable, against docstrings and --help."""
        note, promised = "xperimental: may change in a minor version", promise.promised()
        modules = {"pvlib": lyrefit.pvlib, "searches": lyrefit.searches}
        things = {name: getattr(lyrefit, name) for name in lyrefit.__all__ if name != "__version__"} | modules
        for name, thing in things.items():
            head = re.split(r"\n *(?:Parameters|Returns)\n", inspect.getdoc(thing))[0]
            self.assertEqual(f"E{note}." in head, name not in promised["python"], name)
        for verb in _lyrefit._keywords:
            if verb in promised["python"]:
                left_out = promised["python"][verb].left_out
                doc = inspect.getdoc(getattr(lyrefit, verb))
                entries = dict(re.findall(r"^(\w+) : (.*(?:\n    .*)*)", doc, re.MULTILINE))
                said = {name for name, text in entries.items() if f"e{note}" in " ".join(text.split())}
                self.assertEqual(said, left_out, verb)
        listed = help_of("")
        verbs = re.findall(r"^  ([a-z]+) {2,}", listed, flags=re.MULTILINE)
        listed = listed.split("\nExperimental, ")[1].split("\n\n")[0]
        experimental = re.findall(r"^  ([a-z]+) {2,}", listed, flags=re.MULTILINE)
        self.assertEqual(set(verbs) - set(experimental), promised["verb"].keys() - {"lyrefit"})
        for verb in verbs:
            text = help_of(verb)
            self.assertEqual(f"(e{note})" in text.split("Usage:")[0], verb in experimental, verb)
            if verb not in experimental:
                said = {flag for flag, line in help_by_flag(text).items() if f"e{note}" in line}
                self.assertEqual(said, promised["verb"][verb].left_out, verb)

    def test_docstrings(self):
        for verb in ("fit", "fit_many", "simulate", "read_curve"):
            text = inspect.getdoc(getattr(lyrefit, verb))
            for part in ("Parameters\n-----", "Returns\n-----", "Raises\n-----"):
                self.assertIn(part, text, verb)
            self.assertLessEqual(max(map(len, text.splitlines())), 100, verb)

    def test_examples(self):
        for file in sorted((ROOT / "apps" / "python" / "examples").glob("*.py")):
            with self.subTest(file.name), tempfile.TemporaryDirectory() as folder:
                self.assertIn("# %%", file.read_text())
                here = os.getcwd()
                os.chdir(folder)
                os.symlink(ROOT / "data", "data")
                try:
                    with open(os.devnull, "w") as sink:
                        out, sys.stdout = sys.stdout, sink
                        try:
                            runpy.run_path(str(file), run_name="__main__")
                        finally:
                            sys.stdout = out
                finally:
                    os.chdir(here)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_types(self):
        """The checker agrees with the stubs, the examples and the tests' own use of them."""
        files = [str(PACKAGE), *map(str, (ROOT / "apps" / "python" / "examples").glob("*.py"))]
        with tempfile.TemporaryDirectory() as cache:
            run = subprocess.run(["mypy", "--cache-dir", cache, "--ignore-missing-imports", "--strict-optional", *files],
                                 capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout)


if __name__ == "__main__":
    unittest.main()
