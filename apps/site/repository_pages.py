"""The project's pages of Markdown as pages of the site: the name of each, and what its links become."""

import pathlib
import posixpath
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake" / "reference"))
from markdown_links import LINK, PICTURE, pieces  # noqa: E402

OWN = "apps/site/pages/"  # pages that only the site has
NAMES = {
    "README.md": "start",
    "apps/python/README.md": "python_module",
    "apps/python/examples/nomad.md": "nomad",
    "data/README.md": "benchmark_curves",
    "data/benchmark/README.md": "benchmark",
    "data/benchmark/contest/README.md": "contest",
    "data/diagnosis/README.md": "diagnosis",
    "data/field/README.md": "field",
    "data/formats/README.md": "formats",
    "data/json.md": "json",
    "data/speed/README.md": "speed",
    "lib/README.md": "library",
    ".github/CHANGELOG.md": "changelog",
    ".github/CONTRIBUTING.md": "contributing",
}
MOVED = (("apps/lyrefit/verbs/", "verbs/"), ("lib/lyrefit/", "modules/"), ("lib/decisions/", "decisions/"), (".github/", "project/"),
         ("apps/", "project/"), ("cmake/", "project/"))
# What a bare name is the title of, on these pages: a module, a verb and a function may have the same.
KINDS = (("modules/.+", "module of the library"), ("tests/.+/index", "tests"), ("start", "start"))
SECTION = re.compile(r"^<!-- section: (\S+)#(\S+) -->$", re.M)


def name_of(path):
    """The page of the site, without its ending, of a page of the project."""
    if path.startswith(OWN):
        return path[len(OWN):-len(".md")]
    if path in NAMES:
        return NAMES[path]
    for old, new in MOVED:
        if path.startswith(old):
            path = new + path[len(old):]
            break
    return re.sub(r"README$", "index", path[:-len(".md")]).lower()


def paths():
    """Pages of the project; a form without a title is none."""
    found = [ROOT / "README.md", *ROOT.glob(".github/*.md")]
    for folder in ("apps", "cmake", "data", "lib", "tests"):
        found += ROOT.glob(f"{folder}/**/*.md")
    return sorted({path.relative_to(ROOT).as_posix() for path in found if path.read_text(encoding="utf-8").startswith("# ")})


def titled(page, text):
    """The text of a page, whose title says what a bare name is of."""
    kind = next((kind for pages, kind in KINDS if re.fullmatch(pages, page)), None)
    return re.sub(r"^# [\w/]+$", rf"\g<0> ({kind})", text, count=1, flags=re.M) if kind else text


def slug(heading):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def section(text, anchor):
    """What stands under a heading, without it."""
    heads = [found for code, piece, start in placed(text) if not code
             for found in ((start + m.start(), start + m.end(), m) for m in re.finditer(r"^(#+) (.*)$", piece, re.M))]
    for number, (_, end, head) in enumerate(heads):
        if slug(head.group(2)) == anchor:
            after = [start for start, _, other in heads[number + 1:] if len(other.group(1)) <= len(head.group(1))]
            return text[end:after[0] if after else len(text)].strip()
    sys.exit(f"no heading with the anchor {anchor}")


def placed(text):
    start = 0
    for code, piece in pieces(text):
        yield code, piece, start
        start += len(piece)


class Site:
    """Pages that lead to each other, to the C++ reference, and to copies of files of the project."""

    def __init__(self, source, headers):
        self.source = source
        self.headers = headers  # "lyrefit/fit.h": its page in the reference
        self.names = {path: name_of(path) for path in paths()}

    def copied(self, whole):
        """A file of the project in the folder of the site's sources."""
        place = self.source / "files" / whole
        if not place.exists():
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / whole, place)
        return "/files/" + whole

    def link(self, path, page, text, target):
        if re.match(r"\w+:|[/#]|$", target):  # elsewhere, a page of the site alone, or here
            return f"[{text}]({target})"
        place, _, anchor = target.partition("#")
        whole = posixpath.normpath(posixpath.join(posixpath.dirname(path), place))
        if (ROOT / whole).is_dir():
            whole = posixpath.join(whole, "README.md")
        up = posixpath.relpath(".", posixpath.dirname(page) or ".")
        if whole in self.names:
            other = posixpath.relpath(self.names[whole], posixpath.dirname(page) or ".")
            return f"[{text}]({other}.md{'#' + anchor if anchor else ''})"
        if whole.removeprefix("lib/") in self.headers:
            return f'<a href="{up}/cpp/{self.headers[whole.removeprefix("lib/")]}">{text}</a>'
        if (ROOT / whole).is_file():
            return f"[{text}]({up}{self.copied(whole)})"
        if (ROOT / whole).parent.is_dir() and whole.endswith("/README.md"):  # a folder without a page
            return text
        sys.exit(f"{path}: {target} is not there")

    def picture(self, path, up, found):
        if found.group(2).startswith("/"):  # of the site alone
            return found.group(0)
        whole = posixpath.normpath(posixpath.join(posixpath.dirname(path), found.group(2)))
        return f"![{found.group(1)}]({up}{self.copied(whole)})"

    def relinked(self, path, page, text):
        """The text of one page of the project for a page of the site."""
        up = posixpath.relpath(".", posixpath.dirname(page) or ".")
        out = []
        for code, piece in pieces(text):
            if not code:
                piece = PICTURE.sub(lambda m: self.picture(path, up, m), piece)
                piece = LINK.sub(lambda m: self.link(path, page, m.group(1), m.group(2)), piece)
            out.append(piece)
        return "".join(out)

    def taken(self, path, page, found):
        """A section of another page in the place of the line that names it."""
        other = posixpath.normpath(posixpath.join(posixpath.dirname(path), found.group(1)))
        text = (ROOT / other).read_text(encoding="utf-8")
        return self.relinked(other, page, section(text, found.group(2)))

    def text_of(self, path):
        """A page of the site made of a page of the project."""
        page = self.names[path]
        text = titled(page, self.relinked(path, page, (ROOT / path).read_text(encoding="utf-8")))
        return SECTION.sub(lambda m: self.taken(path, page, m), text)

    def write(self, page, text, orphan=False):
        place = self.source / f"{page}.md"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(("---\norphan: true\n---\n\n" if orphan else "") + text, encoding="utf-8")

    def write_all(self, more, offered):
        """All pages of the project; `more` holds what is added to the end of one, `offered` what is said below its first
        paragraph, by its name."""
        for path, page in self.names.items():
            added = more.get(page, "")
            text = self.text_of(path)
            if page in offered:
                title, first, rest = text.split("\n\n", 2)
                text = "\n\n".join((title, first, offered[page], rest))
            self.write(page, text.rstrip() + "\n" + ("\n" + added if added else ""), orphan=not path.startswith(OWN))
