#!/usr/bin/env python3
"""Names in backticks and in commands on the pages: every file and program that is named is there.

    pages_test.py ROOT PROGRAMS    PROGRAMS: a file with the tests that CMake knows, those left out of this build as well

On the pages of the modules and of the decisions a word with an underscore must be a file's name without its ending, or occur
in the sources. On all pages, what is called a program must be one. First tries itself on a small tree.
"""

import pathlib
import re
import sys
import tempfile

FOLDERS = ("lib", "apps", "tests", "cmake", "data")
FOREIGN = {"ivtools.utils.astm_e1036"}  # functions of pvlib, which are not checked
ENDING = re.compile(r"\.(h|cc|md|sh|cmake|csv)$")
NAME = re.compile(r"`(?:build/tests/|\./)?([a-z0-9_/][a-z0-9_./]+?)/?`")
# A program with its folder; one in a command without, which is not on the path; one that is only named.
BUILT = re.compile(r"build/tests/([a-z0-9_/]+)")
BARE = re.compile(r"(?:^    (?:\w+=\S+ )*|`)((?:lyrefit_[a-z]+|[a-z]\w*_(?:test|study))) ", re.M)
NAMED = re.compile(r"`((?!check_)[a-z]\w*_(?:test|study))`")


def programs_of(root, tests):
    """Paths below build/tests of all programs: those of tests, and what the files of CMake there name."""
    found = set(tests)
    for file in (root / "tests").rglob("CMakeLists.txt"):
        folder = file.parent.relative_to(root / "tests").as_posix()
        for name in re.findall(r"add_executable\((\w+)", file.read_text(encoding="utf-8")):
            found.add(name if folder == "." else f"{folder}/{name}")
        found.update(f"{name}_test" for name in re.findall(r"lyrefit_test\((\w+)", file.read_text(encoding="utf-8")))
    return found


def stale(root, tests):
    """PAGE names NAME, which is not there."""
    files = [path.relative_to(root).as_posix() for folder in FOLDERS for path in sorted((root / folder).rglob("*"))]
    sources = [root / file for file in files if re.search(r"\.(h|cc|py|js)$|CMakeLists\.txt$", file)]
    words = set(re.findall(r"\w+", " ".join(path.read_text(encoding="utf-8") for path in sources)))
    paths = "\n".join(["", *(f"/{file}" for file in files), ""])
    programs = programs_of(root, tests)
    for page in sorted([*(root / ".github").rglob("*.md"), *root.glob("*.md"), *(root / f for f in files if f.endswith(".md"))]):
        text = page.read_text(encoding="utf-8")
        where = page.relative_to(root).as_posix()
        unknown = [name for name in NAMED.findall(text) if name not in programs and f"/{name}." not in paths]
        for name in [name for name in BUILT.findall(text) if name not in programs] + unknown:
            yield f"{where} names {name}, which is no program of build/tests"
        for name in BARE.findall(text):
            yield f"{where} runs {name}, which is not on the path: build/tests/{name}"
        if not re.match(r"lib/lyrefit/[^/]+/([^/]+/)?README\.md$|lib/decisions/[^/]+\.md$", where):
            continue
        for name in sorted(set(NAME.findall(text)) - FOREIGN):
            ended = ENDING.search(name)
            if not ("_" in name or ended) or name in programs:
                continue
            there = any(f"/{name}{end}" in paths for end in ("\n", ".", "/"))
            if not there and (ended or name.rsplit(".")[-1] not in words):
                yield f"{where} names {name}, which is not there"


def sees_stale_names():
    """What the check says of a page, or "" where it is right."""
    cases = (
        ("`fit_job`, `fit_job.cc`, `lib/lyrefit/estimate/fit/fit_job.cc`, `held_out`, `estimate_fit_test`, `.cc`", ""),
        ("    LYREFIT_CURVES=1 build/tests/estimate_fit_test --gtest_filter='*A*'\n    build/tests/studies/lyrefit_studies x", ""),
        ("`fit_jobs`", "README.md names fit_jobs, which is not there"),
        ("`fit_job.h`", "README.md names fit_job.h, which is not there"),
        ("`lib/lyrefit/model/fit_job.cc`", "README.md names lib/lyrefit/model/fit_job.cc, which is not there"),
        ("`build/tests/fit_test x`", "README.md names fit_test, which is no program of build/tests"),
        ("    build/tests/lyrefit_studies x", "README.md names lyrefit_studies, which is no program of build/tests"),
        ("`fit_test`", "README.md names fit_test, which is no"),
        ("    lyrefit_studies x", "README.md runs lyrefit_studies, which is not on the path: build/tests/lyrefit_studies"))
    wrong = 0
    for page, expected in cases:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            module = root / "lib/lyrefit/estimate/fit"
            (root / "tests/studies").mkdir(parents=True)
            (root / "tests/studies/CMakeLists.txt").write_text("add_executable(lyrefit_studies main.cc)\n", encoding="utf-8")
            module.mkdir(parents=True)
            (module / "fit_job.cc").write_text("int HoldOut();  // held_out is a word of the source\n", encoding="utf-8")
            (module / "README.md").write_text(f"# fit\n\n{page}\n", encoding="utf-8")
            said = list(stale(root, {"estimate_fit_test"}))
        if (said == []) != (expected == "") or not all(expected in line for line in said):
            print(f"{page}: expected '{expected}', got {said}")
            wrong += 1
    return wrong == 0


def main():
    root, programs = map(pathlib.Path, sys.argv[1:])
    found = list(stale(root, set(programs.read_text(encoding="utf-8").split())))
    print("\n".join(found))
    return 0 if sees_stale_names() and not found else 1


if __name__ == "__main__":
    sys.exit(main())
