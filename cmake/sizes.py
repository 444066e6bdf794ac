#!/usr/bin/env python3
"""Lines of every module of the library and of apps/plant, and its closure: its own and those of all modules that it links.

    sizes.py [--root FOLDER]            prints them beside their ceilings and fails where one is exceeded
    sizes.py [--root FOLDER] --lower    lowers the ceilings in cmake/sizes.txt to today's sizes

Counted are the lines of .cc, .h and .inc. A ceiling goes down with every change that makes its module smaller, and up only by
hand, with a reason in the commit.
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
CORE = "core"
APPS = {"plant": ["batch"]}  # folders of apps that are built as modules are, and what they link
KEYWORDS = {"FOLDER", "LINK", "WITH", "ARITHMETIC", "TEXT"}


def modules(root):
    """Folder and links of each module, in the order of lib/modules.cmake."""
    text = re.sub(r"#[^\n]*", "", (root / "lib" / "modules.cmake").read_text(encoding="utf-8"))
    table = {}
    for call in re.findall(r"lyrefit_module\(([^)]*)\)", text):
        name, *words = call.split()
        fields = {"": []}
        at = ""
        for word in words:
            if word in KEYWORDS:
                at = word
                fields[at] = []
            else:
                fields[at].append(word)
        table[name] = (fields.get("FOLDER", [name])[0], fields.get("LINK", []))
    return table


def lines_of(folder):
    return sum(len(file.read_bytes().splitlines()) for kind in ("cc", "h", "inc") for file in folder.rglob(f"*.{kind}"))


def measure(root):
    """Lines and closure of each module, of the apps that are like one, and of the core."""
    table = modules(root)
    folders = {name: root / "lib" / "lyrefit" / folder for name, (folder, _) in table.items()}
    for name, links in APPS.items():
        if (root / "apps" / name).is_dir():
            table[name] = ("", links)
            folders[name] = root / "apps" / name
    closed, found = {}, {}
    lines = {name: lines_of(folder) for name, folder in folders.items()}
    for name, (_, links) in table.items():
        closed[name] = {name}.union(*(closed[link] for link in links))
        found[name] = (lines[name], sum(lines[one] for one in closed[name]))
    core = re.search(r"set\(LYREFIT_CORE ([a-z ]+)\)", (root / "lib" / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    total = sum(lines[one] for one in core.split())
    found[CORE] = (total, total)
    return found


def read_ceilings(file):
    ceilings = {}
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        words = line.split()
        if len(words) != 3 or not (words[1].isdigit() and words[2].isdigit()):
            sys.exit(f"{file}:{number}: expected a module, its lines and its closure, found '{line}'")
        ceilings[words[0]] = (int(words[1]), int(words[2]))
    return ceilings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.add_argument("--lower", action="store_true")
    given = parser.parse_args()
    file = given.root / "cmake" / "sizes.txt"
    found, ceilings = measure(given.root), read_ceilings(file)
    exceeded = 0
    print(f"{'module':12} {'lines':>7} {'ceiling':>8} {'closure':>8} {'ceiling':>8}")
    for name, now in found.items():
        most = ceilings.get(name)
        if most is None:
            print(f"{name}: no ceiling in {file}")
            exceeded += 1
            continue
        over = now[0] > most[0] or now[1] > most[1]
        exceeded += over
        print(f"{name:12} {now[0]:7} {most[0]:8} {now[1]:8} {most[1]:8}{'  too large' if over else ''}")
    for name in ceilings.keys() - found.keys():
        print(f"{file} has a ceiling for {name}, which is no module")
        exceeded += 1
    if given.lower:
        head = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
        rows = [f"{name:12} {min(now[0], ceilings[name][0]):7} {min(now[1], ceilings[name][1]):8}"
                for name, now in found.items() if name in ceilings]
        file.write_text("\n".join(head + rows) + "\n", encoding="utf-8")
    return 1 if exceeded else 0


if __name__ == "__main__":
    sys.exit(main())
