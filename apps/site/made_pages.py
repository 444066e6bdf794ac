"""Pages made of what the command, the reference and the citation file say: verbs, glossary, index of C++, how to cite."""

import re
import subprocess
import xml.etree.ElementTree

import yaml


def said(command, *arguments):
    return subprocess.run([command, *arguments], capture_output=True, text=True, check=True).stdout


def verbs(command):
    """Names of the verbs, each with its line."""
    listed = said(command, "--help").split("Subcommands:\n")[1].split("\nAbout lyrefit:\n")[0]
    promised, experimental = (re.findall(r"^  (\w+) +(.*)$", part, re.M) for part in listed.split("\nExperimental, "))
    return dict(promised) | {verb: f"{line} (experimental)" for verb, line in experimental}


def cell(text):
    return re.sub(r"([|*_<>\[\]])", r"\\\1", text)


def table_of(section):
    """Lines of a section of help, each with what is told on lines below it, as a table."""
    rows = []
    for line in section:
        item = re.fullmatch(r"  (\S.*?)(?:  +(.*))?", line)
        if item:
            rows.append([item.group(1), item.group(2) or ""])
        else:
            rows[-1][1] = f"{rows[-1][1]} {line.strip()}".strip()
    return [f"| `{name.replace('|', chr(92) + '|')}` | {cell(text)} |" for name, text in rows if not name.startswith("-h,")]


def whole_help(command, verb):
    """The help of a verb below its description and usage: a table a section, examples as code, and what is told beside them."""
    out = ["## Flags", ""]
    for block in re.split(r"\n{2,}", said(command, verb, "--help").strip("\n"))[1:]:
        head, *lines = block.split("\n")
        if head == "Examples:":
            out += ["## Examples", "", *("  " + line for line in lines), ""]
        elif head.endswith(":") and lines and all(line.startswith("  ") for line in lines):
            rows = table_of(lines)
            what = "argument" if head == "Positionals:" else "flag"
            out += [f"### {head[:-1]}", "", f"| {what} | what it does |", "|---|---|", *rows, ""] if rows else []
        else:
            out += [cell(" ".join([head, *lines])), ""]
    return "\n".join(out)


def verb_pages(command, names, texts):
    """By its name each page of a verb that has none, and what is added to those that there are.

    `names` are the pages of verbs, `texts` their texts, by name: a verb without a page is told by those which use it.
    """
    made, added = {}, {}
    for verb, line in verbs(command).items():
        page = f"verbs/{verb}"
        if page in names:
            added[page] = whole_help(command, verb)
            continue
        users = [name for name in names if re.search(rf"\blyrefit {verb}\b|^# .*\b{verb}\b.*:", texts[name], re.M)]
        told = ", ".join(f"[{name.split('/')[1]}]({name.split('/')[1]}.md)" for name in users)
        title = re.sub("^[A-Z](?=[a-z])", lambda first: first.group().lower(), line)
        made[page] = f"# {verb}: {title}\n\n" + (f"See {told}.\n\n" if told else "") + whole_help(command, verb)
    rows = "\n".join(f"| [{verb}]({verb}.md) | {line} |" for verb, line in verbs(command).items())
    tree = "\n".join(f"{verb} <{verb}>" for verb in verbs(command))
    made["verbs/index"] = (
        "# The verbs of the command\n\n`lyrefit VERB`, a page each. [family](family.md) is `fit` for many curves of one "
        f"device.\n\n| verb | what it does |\n|---|---|\n{rows}\n\n```{{toctree}}\n:hidden:\n\n{tree}\nfit --family <family>\n```\n\n"
        "## Which verb answers which question\n\n    " + said(command, "help").split("\n\n", 1)[1].strip().replace("\n", "\n    ") + "\n")
    return made, added


def glossary(command):
    text, out = said(command, "help", "terms").split("\n\n", 1)[1], ["# Glossary", ""]
    for block in text.strip("\n").split("\n\n"):
        head, *lines = block.split("\n")
        out += [f"## {head}", "", "```{glossary}"]
        for line in lines:
            term = re.fullmatch(r"  (\S.*?)  +(\S.*)", line)
            if term and not line.startswith("   "):
                out += ["", term.group(1), "  " + term.group(2)]
            else:
                out[-1] += " " + line.strip()  # one line a definition: a line that begins with "-" would be a list
        out += ["```", ""]
    return "\n".join(out)


def cite(command, citation):
    """How to cite the software: what its citation file says, and the entry that the command prints."""
    entry = said(command, "cite").split("\n\n", maxsplit=1)[0]
    return (f"{yaml.safe_load(citation)['message']}\n\nBibTeX (`lyrefit cite`):\n\n```bibtex\n{entry}\n```\n\n"
            "The same in the Citation File Format: [CITATION.cff](.github/CITATION.cff).")


class Reference:
    """What the C++ reference has, from the tag file that Doxygen writes beside it."""

    def __init__(self, folder):
        self.compounds = xml.etree.ElementTree.parse(folder / "tags.xml").getroot().findall("compound")
        self.headers = {}
        for file in self.of_kind("file"):
            place = file.findtext("path").partition("/input/lib/")[2] + file.findtext("name")
            self.headers[place] = file.findtext("filename")

    def of_kind(self, kind):
        return [compound for compound in self.compounds if compound.get("kind") == kind]

    def page(self):
        """Every module's functions and types by name, each with its link."""
        types = {compound.findtext("name"): compound.findtext("filename")
                 for kind in ("struct", "class") for compound in self.of_kind(kind)}
        out = ["# C++ reference", "",
               '<a href="cpp/index.html">The reference of all public headers</a>, with a search of its own, by module, type '
               "and header. How to link the library is in [its page](library.md).", ""]
        for group in self.of_kind("group"):
            functions = {member.findtext("name"): f"{member.findtext('anchorfile')}#{member.findtext('anchor')}"
                         for member in group.findall("member") if member.get("kind") == "function" and "operator" not in member.findtext("name")}
            records = {entry.text.removeprefix("lyrefit::"): types[entry.text]
                       for entry in group.findall("class") if entry.text in types and "<" not in entry.text}
            out += [f"## {group.findtext('title')}", "",
                    f'<a href="cpp/{group.findtext("filename")}">All of the module.</a>', ""]
            for what, links in (("Functions", functions), ("Types", records)):
                if links:
                    listed = ", ".join(f'<a href="cpp/{link}"><code>{name}</code></a>' for name, link in sorted(links.items()))
                    out += [f"**{what}**: {listed}", ""]
        return "\n".join(out)
