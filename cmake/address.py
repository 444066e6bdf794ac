#!/usr/bin/env python3
"""Holds every place that says where lyrefit is published against cmake/address.cmake.

    cmake/address.py            # fails, naming the places that say something else
    cmake/address.py --write    # writes them
    cmake/address.py --root DIR # the same in another copy of the repository

A place is a part of a file between two marks. While nothing is published it says how to make the thing of a clone instead.
The command, the Debian packages and the site take the address from cmake/address.cmake themselves.
"""

import argparse
import pathlib
import re
import subprocess
import sys

# How long making each of a clone takes on two cores, where its Debian packages are there. Measured on an AMD EPYC: the wheel in
# 290 s, the packages in 601 s of processor time, the site in 54 s of it beside those of the command and the Python module.
MINUTES = {"page": 9, "wheel": 5, "packages": 5, "site": 7}


def addresses(root):
    """What cmake/address.cmake sets: address, source, site, releases, tracker; empty where there is none."""
    said = subprocess.run(["cmake", "-P", root / "cmake" / "address.cmake"], capture_output=True, text=True, check=True)
    return {name.lower(): value for name, value in re.findall(r"^([A-Z]+)=(.*)$", said.stderr, re.M)}


def readme(at):
    if not at["address"]:
        return ("lyrefit is not published yet: there is nothing to download. A clone makes the page by `cmake/web.sh --build`\n"
                f"({MINUTES['page']} minutes on two cores), the wheel by `cmake/wheel.sh` ({MINUTES['wheel']}), the packages by "
                f"`cmake/packages.sh` ({MINUTES['packages']}).\nThe [site](apps/site/README.md) by `cmake/site.sh` "
                f"({MINUTES['site']}) has gallery, notebooks and references, to be read without a network.")
    said = [f"[Project page]({at['address']})"]
    if at["releases"]:
        said.append(f"[page, wheel and packages]({at['releases']})")
    if at["site"]:
        said.append(f"[manual, gallery and references]({at['site']})")
    if at["tracker"]:
        said.append(f"[questions and mistakes]({at['tracker']})")
    clone = f"\n\n    git clone {at['source']}" if at["source"] else ""
    return ". ".join([", ".join(said), "In a clone `cmake/web.sh --build` makes the page, `cmake/wheel.sh` the wheel, "
                      "`cmake/packages.sh` the packages, `cmake/site.sh` the [site](apps/site/README.md)."]) + clone


def pyproject(at):
    if not at["address"]:
        return "# Nothing is published yet, so there is no [project.urls]."
    names = {"Homepage": "address", "Source": "source", "Documentation": "site", "Releases": "releases", "Issues": "tracker"}
    return "\n".join(["[project.urls]", *(f'{name} = "{at[what]}"' for name, what in names.items() if at[what])])


def citation(at):
    if not at["address"]:
        return "# Nothing is published yet, so there is no url."
    return "\n".join([f'url: "{at["address"]}"', *([f'repository-code: "{at["source"]}"'] if at["source"] else [])])


def issues(at):
    if not at["site"]:
        return "# No site is published: README.md says how to make it of a clone."
    return ("contact_links:\n  - name: Manual, formats and glossary\n"
            f"    url: {at['site']}\n    about: What a report says, and which files are read")


def releasing(at):
    if not at["releases"]:
        return "Nothing is published yet, so there is no page of releases: files are handed on, or made of a clone."
    return f"Releases are at {at['releases']}."


# Of each file: what it says there, and the marks around it.
PLACES = {
    "README.md": (readme, "<!-- address -->", "<!-- end of address -->"),
    ".github/RELEASING.md": (releasing, "<!-- address -->", "<!-- end of address -->"),
    "apps/python/pyproject.toml": (pyproject, "# address: cmake/address.py", "# end of address"),
    ".github/CITATION.cff": (citation, "# address: cmake/address.py", "# end of address"),
    ".github/ISSUE_TEMPLATE/config.yml": (issues, "# address: cmake/address.py", "# end of address"),
}


def as_it_should_be(text, place, at):
    say, begin, end = PLACES[place]
    parts = re.split(f"(?<={re.escape(begin)}\n).*?(?={re.escape(end)})", text, flags=re.S)
    if len(parts) != 2:
        sys.exit(f"{place}: expected one '{begin}' and one '{end}'")
    return f"{parts[0]}{say(at)}\n{parts[1]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1])
    given = parser.parse_args()
    at = addresses(given.root)
    wrong = []
    for place in PLACES:
        file = given.root / place
        text = file.read_text(encoding="utf-8")
        wanted = as_it_should_be(text, place, at)
        if text != wanted and given.write:
            file.write_text(wanted, encoding="utf-8")
        elif text != wanted:
            wrong.append(place)
    if wrong:
        sys.exit(f"these say another address than cmake/address.cmake: {', '.join(wrong)}; cmake/address.py --write")


if __name__ == "__main__":
    main()
