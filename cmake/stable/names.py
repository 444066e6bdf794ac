"""Names of the Python package, read from its sources and stubs, and flags of the command, read from what it prints."""

import ast
import pathlib
import re
import subprocess

from comparison import Entry

# Of these the values depend on the processor.
VALUES_OF_THE_MACHINE = {"--kernel"}


def _type(node):
    """An annotation, with Literal["a", "b"] as its alternatives."""
    if node is None:
        return ""
    if isinstance(node, ast.BinOp):
        return f"{_type(node.left)} | {_type(node.right)}"
    if isinstance(node, ast.Subscript) and ast.unparse(node.value) == "Literal":
        values = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return " | ".join(ast.unparse(value) for value in values)
    return ast.unparse(node)


def _merge(entries, name, entry):
    """Overloads: what any of them takes is taken, and what any of them returns is returned."""
    if name in entries:
        old = entries[name]
        types = " | ".join(dict.fromkeys([*filter(None, (old.type, entry.type))]))
        entry = Entry(entry.kind, types, old.notes | entry.notes)
    entries[name] = entry


def _arguments(node, name, entries, method):
    arguments = node.args
    plain = [*arguments.posonlyargs, *arguments.args][1 if method else 0:]
    first_default = len(plain) - len(arguments.defaults)
    for place, argument in enumerate(plain):
        notes = {f"argument-{place + 1}"} | ({"optional"} if place >= first_default else set())
        _merge(entries, f"{name}({argument.arg})", Entry("input", _type(argument.annotation), frozenset(notes)))
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        notes = frozenset(["optional"] if default is not None else [])
        _merge(entries, f"{name}({argument.arg})", Entry("input", _type(argument.annotation), notes))


def _function(node, name, entries, method=False):
    _merge(entries, name, Entry("output", _type(node.returns)))
    _arguments(node, name, entries, method)


def python_names(text, prefix="", classes_alone=False, promised=None):
    """The entries of a stub or a module: public functions with their arguments, classes with their members.

    Where the names that are promised are given, overloads that return another class are left out.
    """
    entries = {}
    body = ast.parse(text).body
    classes = {node.name for node in body if isinstance(node, ast.ClassDef)}
    for node in body:
        if promised is not None and isinstance(node, ast.FunctionDef) and _type(node.returns) in classes - set(promised):
            continue
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and not classes_alone:
            _function(node, prefix + node.name, entries)
        if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
            continue
        name = prefix + node.name
        entries[name] = Entry("exact", "class " + ", ".join(map(ast.unparse, node.bases)))
        for member in node.body:
            if isinstance(member, ast.AnnAssign):
                entries[f"{name}.{member.target.id}"] = Entry("output", _type(member.annotation))
            elif isinstance(member, ast.FunctionDef):
                decorators = {ast.unparse(decorator) for decorator in member.decorator_list}
                if member.name == "__init__":
                    _arguments(member, name, entries, method=True)
                elif member.name.startswith("_") and not member.name.endswith("__"):
                    continue
                elif "property" in decorators:
                    entries[f"{name}.{member.name}"] = Entry("output", _type(member.returns))
                else:
                    _function(member, f"{name}.{member.name}", entries, method=True)
    return entries


def python_package(folder, promised=None):
    """The entries of the package in a folder: the compiled module by its stub, and the modules beside it."""
    folder = pathlib.Path(folder)
    entries = python_names((folder / "_lyrefit.pyi").read_text(encoding="utf-8"), promised=promised)
    entries.update(python_names((folder / "__init__.py").read_text(encoding="utf-8"), classes_alone=True))
    for module in ("pvlib", "searches"):
        entries.update(python_names((folder / f"{module}.py").read_text(encoding="utf-8"), f"{module}."))
    entries["__version__"] = Entry("output", "str")
    return entries


def flags_of_help(verb, text):
    """The entries of the help of a verb: its flags, whether they take a value, and what it is given besides."""
    entries = {verb: Entry("exact", "verb")}
    positionals = re.search(r"^Positionals:\n(.*?)^$", text, flags=re.MULTILINE | re.DOTALL)
    for line in positionals.group(1).splitlines() if positionals else []:
        if found := re.match(r"  (\S+) TEXT( \.\.\.)?( REQUIRED)?(?= |$)", line):
            notes = {"several"} if found.group(2) else set()
            notes |= set() if found.group(3) else {"optional"}
            entries[f"{verb}({found.group(1)})"] = Entry("input", "text", frozenset(notes))
    for line in re.findall(r"^  (-.*)$", text, flags=re.MULTILINE):
        head = re.split(r" {2,}", line, maxsplit=1)[0]
        spellings, _, value = head.partition(" ")
        notes = frozenset(["optional"] + (["several"] if value.endswith("...") else []))
        for flag in spellings.split(","):
            entries[f"{verb}({flag})"] = Entry("input", "value" if value else "alone", notes)
    return entries


def flag_values(completion):
    """The entries of the values that flags take, from the completion of bash."""
    entries = {}
    for verb, flag, words in re.findall(r"^ +'(\S+) (--\S+)'\) words='([^']*)'", completion, flags=re.MULTILINE):
        if flag not in VALUES_OF_THE_MACHINE:
            entries.update({f"{verb} {flag} {word}": Entry("exact", "value") for word in words.split()})
    return entries


def command_flags(command, root):
    """The entries of the command: verbs, flags, their values and the exit codes."""

    def said(*arguments):
        return subprocess.run([command, *arguments], check=True, capture_output=True, text=True).stdout

    entries = flag_values(said("completion", "bash"))
    head = said("--help")
    entries.update(flags_of_help("lyrefit", head))
    for verb in re.findall(r"^  ([a-z]+) {2,}\S", head, flags=re.MULTILINE):
        entries.update(flags_of_help(verb, said(verb, "--help")))
    codes = (pathlib.Path(root) / "apps/lyrefit/line/output.h").read_text(encoding="utf-8")
    for name, code in re.findall(r"constexpr int kExit(\w+) = (\d+);", codes):
        entries[f"exit code {code}"] = Entry("exact", name)
    return entries
