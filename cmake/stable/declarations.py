"""Every declaration of the public headers, as Doxygen reads them.

A function is an entry for each number of arguments that it can be called with, so that one with a new argument that
has a default still has the calls of before.
"""

import pathlib
import re
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree

from comparison import Entry


def _text(node):
    return re.sub(r"\s+", " ", "".join(node.itertext())).strip() if node is not None else ""


def _template(node):
    parameters = node.find("templateparamlist")
    if parameters is None:
        return ""
    shown = []
    for parameter in parameters.findall("param"):
        default = parameter.find("defval")
        shown.append(_text(parameter.find("type")) + (" =" if default is not None else ""))
    return f"template<{', '.join(shown)}> "


def _function(member, name):
    """The calls that a function takes, and what they return."""
    types, calls = [], []
    parameters = [p for p in member.findall("param") if _text(p.find("type")) != "void"]
    for parameter in parameters:
        if parameter.find("defval") is not None:
            calls.append(list(types))
        types.append(_text(parameter.find("type")) + _text(parameter.find("array")))
    calls.append(types)
    after = re.search(r"\)([^()]*)$", _text(member.find("argsstring")))
    kept = [word for word in ("const", "&", "&&") if after and word in after.group(1).split()]
    kept += [word for word in ("static", "explicit") if member.get(word) == "yes"]
    if member.get("virt") in ("virtual", "pure-virtual"):
        kept.append(member.get("virt"))
    result = " ".join([_template(member) + _text(member.find("type")), *kept]).strip()
    for call in calls:
        yield f"{name}({', '.join(call)})", Entry("exact", result)


def _members(compound, scope):
    for member in compound.iter("memberdef"):
        if member.get("prot") == "private" or member.get("kind") == "friend":
            continue
        kind, name = member.get("kind"), _text(member.find("name"))
        whole = f"{scope}::{name}" if scope else name
        if kind == "function":
            yield from _function(member, whole)
            if member.get("virt") == "pure-virtual":  # a new one breaks the classes of users
                yield f"{scope}(override {name})", Entry("input")
        elif kind == "enum":
            yield whole, Entry("exact", "enum")
            for value in member.findall("enumvalue"):
                yield f"{whole}::{_text(value.find('name'))}", Entry("exact", "value")
        elif kind == "define":
            yield whole, Entry("exact", "macro")
        else:
            yield whole, Entry("exact", f"{kind} {_text(member.find('type'))}{_text(member.find('argsstring'))}")


def from_xml(folder):
    """The entries of a folder of Doxygen's XML."""
    entries = {}
    for file in sorted(pathlib.Path(folder).glob("*.xml")):
        for compound in ElementTree.parse(file).iter("compounddef"):
            kind, name = compound.get("kind"), _text(compound.find("compoundname"))
            if kind in ("struct", "class", "union"):
                bases = [_text(base) for base in compound.findall("basecompoundref")]
                entries[name] = Entry("exact", _template(compound) + " : ".join([kind, *bases]))
                entries.update(_members(compound, name))
            elif kind == "namespace":
                entries.update(_members(compound, name))
            elif kind == "file":
                entries[_text(compound.find("location")) or compound.find("location").get("file")] = Entry(
                    "exact", "header")
                for section in compound.findall("sectiondef"):
                    if section.get("kind") == "define":
                        entries.update(_members(section, ""))
    return entries


def declarations(doxygen, doxyfile, root, headers):
    """The entries of headers below root/lib, read with the settings of the reference pages."""
    with tempfile.TemporaryDirectory() as folder:
        settings = pathlib.Path(doxyfile).read_text(encoding="utf-8") + f"""
INPUT = {" ".join(f'"{header}"' for header in headers)}
OUTPUT_DIRECTORY = "{folder}"
GENERATE_TAGFILE =
STRIP_FROM_PATH = "{root}/lib"
EXTRACT_ALL = YES
WARNINGS = NO
WARN_AS_ERROR = NO
GENERATE_HTML = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
"""
        subprocess.run([doxygen, "-"], input=settings, text=True, check=True, stdout=subprocess.DEVNULL)
        return from_xml(pathlib.Path(folder) / "xml")
