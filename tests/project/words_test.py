#!/usr/bin/env python3
"""Refuses private words: every name and every sentence of the project uses the terms of its field.

    words_test.py ROOT

Reads sources, scripts and pages below ROOT. Prints FILE:LINE: WORD -> TERM for each private word. First tries itself on
a file with one.
"""

import pathlib
import re
import sys
import tempfile

# Private words, as regular expressions on a word of a name or of prose, and the term to use.
TERMS = {
    r"birds?|flocks?": "candidate, population",
    r"basins?|valleys?": "local optimum",
    r"houses?|seams?": "architecture, interface",
    r"imprints?": "signature",
    r"rivals?": "fitted candidate, alternative",
    r"workbench(es)?": "weighted data",
    r"fleets?": "batch",
    r"sketch(es)?": "sparkline",
    r"contenders?": "algorithm",
    r"comebacks?|impatient": "drop diode, evaluation limit",
    r"pool(s|ed)?": "summary",
    r"optimis(e[drs]?|ers|ing|ations?)": "optimize, optimizer, optimization",  # one spelling, which a search finds
}
# Files where a word has another sense.
USUAL = {"data/json.md": ".*", "lib/lyrefit/base/append_log.cc": "flock", "cmake/web/dependencies.cmake": "pool", "lib/lyrefit/base/former_names.h": "bird|basins|contenders"}
MOST_LINES = 110  # of README.md, which is read before anything else
SUFFIXES = {".cc", ".h", ".inc", ".py", ".js", ".mjs", ".cmake", ".sh", ".md", ".html", ".css", ".yml", ".cff"}
FOLDERS = (".github", "apps", "cmake", "data", "lib", "tests")
WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
ANY = re.compile("|".join(TERMS), re.IGNORECASE)  # a line without it has no private word


def private_words(root):
    """FILE:LINE: WORD -> TERM of each private word below a folder; line 0 is the name of the file."""
    files = [root / "README.md", *(path for folder in FOLDERS for path in sorted((root / folder).rglob("*")))]
    for path in files:
        if path.suffix not in SUFFIXES or not path.is_file() or path.name == pathlib.Path(__file__).name:
            continue
        name = path.relative_to(root).as_posix()
        for number, line in enumerate([name, *path.read_text(encoding="utf-8").splitlines()]):
            for word in WORD.findall(line) if ANY.search(line) else []:
                for private, term in TERMS.items():
                    usual = name in USUAL and re.fullmatch(USUAL[name], word.lower())
                    if re.fullmatch(private, word.lower()) and not usual:
                        yield f"{name}:{number}: {word} -> {term}"


def sees_private_words():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "lib" / "search.h"
        file.parent.mkdir()
        file.write_text("// Candidates.\nint BestBird();\n", encoding="utf-8")
        return list(private_words(pathlib.Path(folder))) == ["lib/search.h:2: Bird -> candidate, population"]


if __name__ == "__main__":
    if not sees_private_words():
        sys.exit("a private word was not seen")
    found = list(private_words(pathlib.Path(sys.argv[1])))
    lines = (pathlib.Path(sys.argv[1]) / "README.md").read_text(encoding="utf-8").count("\n")
    if lines > MOST_LINES:
        found.append(f"README.md: {lines} lines, more than {MOST_LINES}")
    print(*found, sep="\n")
    sys.exit(1 if found else 0)
