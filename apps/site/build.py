#!/usr/bin/env python3
"""Makes the site: the project's pages, the gallery, notebooks and the references as one folder of HTML.

    build.py --command LYREFIT --reference FOLDER --parts FOLDER --page FILE --out FOLDER

LYREFIT is the command; `import lyrefit` must find the module. --reference is the folder in which the target `reference`
has left its pages and tags.xml. --page is the page that needs no server, if it is built (cmake/web.sh). --parts is a folder for what the site is made of, which is emptied, as --out is.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

import bs4

import gallery
import made_pages
import offline_page
import repository_pages
import speed

HERE = pathlib.Path(__file__).resolve().parent
RUNS_THERE = ('Commands and examples that read `data/` run in the folder of <a href="_static/lyrefit-examples.zip">the archive of '
              "all examples with their data</a>.")
# What the site has beside a page, by its name: said below the first paragraph.
OFFERED = {
    "start": RUNS_THERE,
    "python_module": RUNS_THERE,
    "benchmark": 'To download: <a href="_static/lyrefit-benchmark-1.tar.gz">lyrefit-benchmark-1.tar.gz</a>, the archive '
                 "without the measured curves (`real` and `lab`).",
}


def prepare(command, reference, parts):
    """Everything that Sphinx reads, below the folder of the parts."""
    source = parts / "source"
    cpp = made_pages.Reference(reference)
    site = repository_pages.Site(source, cpp.headers)
    named = {page: (repository_pages.ROOT / path).read_text(encoding="utf-8")
             for path, page in site.names.items() if page.startswith("verbs/")}
    made, added = made_pages.verb_pages(command, list(named), named)
    citation = (repository_pages.ROOT / ".github" / "CITATION.cff").read_text(encoding="utf-8")
    made |= {"glossary": made_pages.glossary(command), "cpp": cpp.page()}
    offered = OFFERED | {"cite": site.relinked("", "cite", made_pages.cite(command, citation))}
    shutil.copytree(HERE / "static", source / "_static")
    site.write_all(added | {"speed": speed.page(source / "_static")}, offered)
    subprocess.run([sys.executable, "-B", repository_pages.ROOT / "data" / "benchmark" / "pack.py",
                    source / "_static" / "lyrefit-benchmark-1.tar.gz"], check=True, stdout=subprocess.DEVNULL)
    for page, text in made.items():
        site.write(page, text)
    gallery.stage(parts / "examples")
    notebooks = {name: gallery.notebook(name) for name in gallery.NOTEBOOKS}
    (source / "notebooks").mkdir(exist_ok=True)
    for name, text in notebooks.items():
        (source / "notebooks" / f"{name}.ipynb").write_text(text, encoding="utf-8")
    gallery.archive(source / "_static" / "lyrefit-examples.zip", notebooks)


def write_texts(out):
    """The text of every page for its search, which shows the words around what was found."""
    texts = {}
    for page in sorted(out.rglob("*.html")):
        main = bs4.BeautifulSoup(page.read_bytes(), "html.parser").find(role="main")
        for mark in main(class_="headerlink"):
            mark.decompose()
        texts[page.relative_to(out).as_posix()] = " ".join(main.get_text().split())
    (out / "_static" / "page_texts.js").write_text(f"const pageTexts = {json.dumps(texts, ensure_ascii=False)};\n",
                                                   encoding="utf-8")


def copy_reference(pages, out):
    """Doxygen's pages, with the project's name above each as the way back."""
    shutil.copytree(pages, out)
    name = '<div id="projectname">lyrefit'
    for page in out.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        if name in text:
            up = os.path.relpath(out.parent, page.parent)
            link = f'<div id="projectname"><a href="{up}/index.html">lyrefit</a>'
            page.write_text(text.replace(name, link), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--command", type=pathlib.Path, required=True)
    for name in ("reference", "parts", "page", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    given = parser.parse_args()
    command = given.command.resolve()
    os.environ |= {"PATH": f"{command.parent}:{os.environ['PATH']}", "LYREFIT_COMMAND": str(command),
                   "LYREFIT_ROOT": str(repository_pages.ROOT),
                   "IPYTHONDIR": str(given.parts.resolve() / "ipython"), "JUPYTER_RUNTIME_DIR": str(given.parts.resolve() / "jupyter"),
                   "MATPLOTLIBRC": str(HERE / "static"), "SOURCE_DATE_EPOCH": "946684800",
                   "LYREFIT_SITE_PARTS": str(given.parts.resolve()), "PYTHONDONTWRITEBYTECODE": "1", "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    for folder in (given.parts, given.out):
        shutil.rmtree(folder, ignore_errors=True)
    prepare(command, given.reference, given.parts)
    run = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-c", HERE,
                          "-d", given.parts / "doctrees", given.parts / "source", given.out], check=False)
    if run.returncode != 0:
        sys.exit(f"Sphinx ended with {run.returncode}")
    (given.out / ".buildinfo").unlink(missing_ok=True)  # for Sphinx's next run, of which there is none; differs each time
    write_texts(given.out)
    offline_page.put(given.page, given.out)
    copy_reference(given.reference / "html", given.out / "cpp")


if __name__ == "__main__":
    main()
