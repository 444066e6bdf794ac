#!/usr/bin/env python3
"""The table of .github/CONTRIBUTING.md: what tests a change of a folder, and how long that takes.

    module_table.py ROOT PROGRAMS         fails where the table lacks a folder, or names a target or tests that are not there
    module_table.py ROOT --write LOG      writes it; LOG is build/Testing/Temporary/LastTest.log of a run of all tests
"""

import pathlib
import re
import sys

START, END = "<!-- folders -->\n", "<!-- end of folders -->"
# Modules whose tests are those of a module that reads with them.
TESTED_BY = {"stream": "batch", "settings": "cli"}
# Folder, target, tests.
APPS = (
    ("apps/lyrefit", "check_cli", "^cli/"),
    ("apps/plant", "check_plant", "^plant/"),
    ("apps/python", "lyrefit_python_stubs", "^python/"),
    ("apps/slurm", "lyrefit_app", "^slurm"),
    ("apps/web", "check_web", "^web/"),
    ("apps/site", "site", "^site/"))


def rows(root):
    """Folder, target and tests of every module and program."""
    for name, folder in re.findall(r"^lyrefit_module\((\w+)(?: FOLDER (\S+))?", (root / "lib/modules.cmake").read_text(), re.M):
        tests = TESTED_BY.get(name, folder or name)
        yield f"lib/lyrefit/{folder or name}", f"check_{tests.replace('/', '_')}", f"^{tests}/"
    yield from APPS


def seconds(log):
    """Seconds of each test of a run."""
    test = re.compile(r"^\d+/\d+ Test: (\S+).*\n(?:(?!\d+/\d+ Test).*\n)*?Test time = +([\d.]+) sec$", re.M)
    return {name: float(time) for name, time in test.findall(log.read_text(encoding="utf-8", errors="replace"))}


def table(root, times):
    """The lines of the table; without times, what stands before the seconds in each."""
    for folder, target, tests in rows(root):
        row = f"| `{folder}` | `{target}` | `{tests}` |"
        if times is not None:
            found = [time for name, time in times.items() if re.search(tests, name)]
            row += f" {len(found)} | {max(1, round(sum(found)))} |"
        yield row


def problems(root, programs):
    """What the table of the page lacks, and what it names that is not there."""
    page = (root / ".github/CONTRIBUTING.md").read_text(encoding="utf-8")
    shown = page[page.index(START):page.index(END)]
    for row in table(root, None):
        if not re.search(re.escape(row) + r" [1-9]\d* \| [1-9]\d* \|\n", shown):
            yield f"the table of CONTRIBUTING.md lacks {row}"
    folders = {folder for folder, _, _ in rows(root)}
    yield from (f"no row for apps/{path.name}" for path in (root / "apps").iterdir()
                if path.is_dir() and f"apps/{path.name}" not in folders)
    named = " ".join(path.read_text(encoding="utf-8")
                     for path in [*root.glob("apps/*/CMakeLists.txt"), root / "cmake/LyrefitSite.cmake", root / "tests/CMakeLists.txt"])
    for _, target, _ in rows(root):
        tested = target.startswith("check_") and any(f"{target[6:]}{end}" in programs for end in ("_test", "_rate_test"))
        tested = tested or f"lyrefit_test({target[6:]} " in named  # one that LYREFIT_ALL_TESTS brings
        if not tested and not re.search(rf"add_(custom_target|executable)\({target}\b", named):
            yield f"CMake has no target {target}"


def main():
    root = pathlib.Path(sys.argv[1])
    page = root / ".github/CONTRIBUTING.md"
    if sys.argv[2] == "--write":
        text = page.read_text(encoding="utf-8")
        head = "| you changed | builds and tests it: `ninja -C build` | tests: `ctest -R` | how many | seconds |\n|---|---|---|---|---|\n"
        lines = "".join(f"{row}\n" for row in table(root, seconds(pathlib.Path(sys.argv[3]))))
        page.write_text(text[:text.index(START)] + START + head + lines + text[text.index(END):], encoding="utf-8")
        return 0
    found = list(problems(root, set(pathlib.Path(sys.argv[2]).read_text(encoding="utf-8").split())))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
