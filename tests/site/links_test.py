#!/usr/bin/env python3
"""Every link, picture, script and style of the site leads to a file of it, every anchor to an element of that page.

    links_test.py SITE

Links to other sites are not followed, but nothing may be loaded from one. The pages below cpp/ are Doxygen's: links into
them are tested, their own are not. Nor may a definition of the glossary hold a
list. First tries itself on pages with dead links.
"""

import html.parser
import pathlib
import re
import sys
import tempfile
import urllib.parse

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("object", "data")}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if (tag, name) in LOADED or (tag, name) == ("a", "href"):
                self.links.append((tag, value or ""))


def faults(site):
    """PAGE: LINK: what is wrong with it, for each."""
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        where = path.relative_to(site)
        if where.parts[0] == "cpp":
            continue
        for tag, link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if tag != "a" and parts.scheme != "data":
                    yield f"{where}: {link}: loaded from elsewhere"
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                yield f"{where}: {link}: no such file"
            elif parts.fragment and target in pages:
                if urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                    yield f"{where}: {link}: no such anchor"


def glossary_faults(site):
    """What is wrong with the definitions of the glossary: each is prose."""
    definitions = re.findall(r"<dd>.*?</dd>", (site / "glossary.html").read_text(encoding="utf-8"), re.S)
    if not definitions:
        yield "glossary.html: no definition"
    yield from (f"glossary.html: {text}: a list" for text in definitions if re.search("<[uo]l", text))


def sees_faults():
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve()
        (site / "a.html").write_text('<p id="here"><a href="b.html#there">1</a><a href="#here">2</a><a href="c.html">3</a>'
                                     '<a href="https://a.example/">4</a><img src="https://a.example/b.png">')
        (site / "b.html").write_text('<a href="a.html#here">1</a>')
        (site / "glossary.html").write_text("<dd><p>1</p></dd><dd><p>2</p><ul><li>3</li></ul></dd>")
        return [fault.split(": ")[-1] for fault in (*faults(site), *glossary_faults(site))] == [
            "no such anchor", "no such file", "loaded from elsewhere", "a list"]


if __name__ == "__main__":
    if not sees_faults():
        sys.exit("a dead link or a list was not seen")
    root = pathlib.Path(sys.argv[1]).resolve()
    found = [*faults(root), *glossary_faults(root)]
    print(*found, sep="\n")
    sys.exit(1 if found or not (root / "index.html").is_file() else 0)
