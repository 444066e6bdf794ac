"""A public header with its plain comments as Doxygen's own.

Headers stay as people read them in an editor; what they say of what is told by where it stands:
  - a comment above a declaration is its own, and that of declarations right below, line on line, that have none,
    if these are functions, constants, or fields of the same type;
  - one behind a declaration, and on in the same column below, is its own;
  - what is indented by two further blanks is shown as it stands, unless it is a list;
  - a value of an enumeration is shown with its text in flags and JSON (EnumTable);
  - what a module's header declares stands in the module's topic.
Of a field of which its header says nothing is said, in this order: what the table of options says of it, the first
sentence of its type, the meaning that its name has everywhere (names.txt), the unit that its name ends in.
A comment beside no declaration is the file's; comments in functions stay what they are.
"""

import re

UNITS = {
    "K": "kelvin", "C": "degrees Celsius", "V": "volt", "A": "ampere", "W": "watt", "W_m2": "W/m2",
    "eV": "electron volt", "per_K": "1/K", "A_per_K": "A/K", "V_per_K": "V/K", "V_K": "V/K", "A_K": "A/K", "1_K": "1/K",
    "percent_K": "percent per kelvin", "s": "seconds", "cm2": "cm2", "ohm": "ohm", "S": "siemens", "percent": "percent",
}
MODULE = re.compile(r"lib/lyrefit/([a-z]+)/")
COMMENT = re.compile(r"^\s*//( |$)")
NO_WORDS = re.compile(r"^\s*//\s*(NOLINT|clang-format)")


def escape(words):
    """What Doxygen would take for a command, a tag or a link, outside of `code`."""
    parts = re.split(r"(`[^`]*`)", words)
    return "".join(p if p.startswith("`") else re.sub(r"[\\@<>#]", r"\\\g<0>", p) for p in parts)


def shown_as_it_stands(texts):
    """For each line of a comment whether it is a table, an equation or code rather than text."""
    shown, in_list = [], False
    for number, text in enumerate(texts):
        indented = text.startswith("  ")
        in_list = (in_list and indented) or re.match(r" *- ", text) is not None
        between = not text and shown and shown[-1] and any(t for t in texts[number:])
        between = between and next(t for t in texts[number:] if t).startswith("  ")
        shown.append(bool(not in_list and (indented or between)))
    return shown


def is_code(shown):
    """Whether what is shown as it stands is C++, rather than a table or an equation."""
    return re.search(r'lyrefit::|#include|[A-Za-z]\(".*\)\.', shown) is not None


def block(texts, heads=()):
    """The lines of a comment above a declaration, those of `texts` below the commands `heads`."""
    shown = shown_as_it_stands(texts)
    lines = list(heads)
    command = ""
    for text, as_is in zip(texts, shown):
        if as_is and not command:
            command = "code" if is_code("\n".join(t for t, s in zip(texts, shown) if s)) else "verbatim"
            lines.append("\\code{.cpp}" if command == "code" else "\\verbatim")
        elif command and not as_is:
            lines.append("\\end" + command)
            command = ""
        lines.append(text[2:] if as_is else escape(text))
    if command:
        lines.append("\\end" + command)
    return "\n".join("/// " + line for line in lines)


class Scopes:
    """Where a line of code stands: `kinds` from the outermost scope, and the declaration it belongs to."""

    def __init__(self):
        self.kinds = ["namespace"]
        self.statement = ""
        self.opened = []
        self.parentheses = 0

    def documents(self):
        return self.kinds[-1] != "code" and self.parentheses == 0

    def kind_of(self, statement):
        statement = re.sub(r"^template\s*<.*?>\s*(?=struct|class|enum|union)", "", statement.strip())
        if re.match(r"(inline )?namespace\b", statement):
            return "namespace"
        if re.match(r"enum\b", statement):
            return "enum"
        if re.match(r"(struct|class|union)\b( alignas\(\d+\))?[^()=]*$", statement):
            return "class"
        return "code"

    def read(self, code):
        """Takes a line of code in, without its comment."""
        code = re.sub(r'"(\\.|[^"\\])*"', '""', code)
        code = re.sub(r"(?<![0-9])'(\\.|[^'\\])'", "' '", code)
        for c in code:
            if c == "(":
                self.parentheses += 1
            elif c == ")":
                self.parentheses -= 1
            elif c == "{":
                self.opened.append(self.statement)
                self.kinds.append(self.kind_of(self.statement))
                self.statement = ""
                continue
            elif c == "}":
                kind, statement = self.kinds.pop(), self.opened.pop()
                function = re.search(r"\)\s*(const|noexcept|override|\s)*(:[^?]*|->.*)?$", statement)
                ended = kind == "namespace" or (kind == "code" and function)
                self.statement = "" if ended else statement + "{}"
                continue
            elif self.parentheses == 0 and (c == ";" or (c == "," and self.kinds[-1] == "enum")):
                self.statement = ""
                continue
            self.statement += c
        self.statement = (self.statement + " ").lstrip()


def comment_at(line):
    """The column of the comment behind code, or the line's length."""
    blanked = re.sub(r'"(\\.|[^"\\])*"', lambda m: "_" * len(m.group()), line)
    at = blanked.find("//")
    return len(line) if at < 0 else at


class Known:
    """What all headers together say: of types, of options in their tables, of names."""

    def __init__(self, texts, names):
        self.types, self.options, self.names = {}, {}, names
        for text in texts:
            for words, name in re.findall(r"((?:^ *//.*\n)+)(?: *template.*\n)?"
                                          r" *(?:struct|class|enum class|enum) (\w+)", text, re.M):
                words = " ".join(re.sub(r"^\s*// ?", "", line) for line in words.strip().split("\n"))
                self.types[name] = re.split(r"(?<=[.;]) ", words)[0].rstrip(".:;")
            for name, words in re.findall(r"enum class (\w+) \{.*\};  // (.*)", text):
                self.types[name] = words.rstrip(".:;")
            for line, owner, field in re.findall(r'\{\s*"[\w-]+",\s*"[^"]*",\s*((?:"(?:[^"\\]|\\.)*"\s*)+),'
                                                 r"\s*(?:\w+<)?&(\w+)::(\w+)\s*[,>}]", text):
                self.options[owner, field] = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', line))

    def of_field(self, owner, code):
        """What there is to say of the field that a line of code declares in the type `owner`; "" for nothing."""
        field = re.search(r"(\w+)(\[\w*\])?( = .*|\{.*\})?;\s*$", code)
        if not field or "(" in code[:field.start()]:
            return ""
        name = field.group(1)
        unit = max((end for end in UNITS if name.endswith("_" + end)), key=len, default="")
        kind = re.match(r"\s*(?:const )?(?:std::\w+<)*([A-Z]\w*)", code)
        option = self.options.get((owner, name))
        if option and re.match(r"\s*bool .*= true;", code):
            option = "false: " + option  # the table speaks of the flag --no-NAME
        return (option or (kind and self.types.get(kind.group(1))) or
                (not kind and self.names.get(name)) or (unit and "in " + UNITS[unit]) or "")


class Header:
    """One header on its way through."""

    def __init__(self, path, text, known):
        self.known = known
        self.lines = text.split("\n")
        self.out = []
        self.scopes = Scopes()
        self.owners = [""]   # beside the scopes: the name of a type, "" for others
        module = MODULE.search(path)
        self.module = module.group(1) if module else ""
        self.spelled = dict(re.findall(r'\{\s*([\w:]*k\w+),\s*"([^"]*)"', text))
        self.said = []       # beside the scopes: the comments above the types that are open
        self.above = []      # the comment above, which holds for the declarations that follow
        self.kind = ""       # the type of the field it stands above, "" for what is no field
        self.begun = 0       # where in `out` the declaration begins
        self.own = False     # whether it has a comment above of its own

    def filtered(self):
        number = 0
        while number < len(self.lines):
            line = self.lines[number]
            if self.scopes.documents() and not self.scopes.statement and COMMENT.match(line):
                last = number
                while last + 1 < len(self.lines) and COMMENT.match(self.lines[last + 1]):
                    last += 1
                self.comment(self.lines[number:last + 1], self.lines[last + 1:last + 2])
                number = last
            else:
                number = self.code(number)
            number += 1
        if not any("\\file" in said for said in self.out):
            self.out.insert(0, "/// \\file")
        return "\n".join(self.out)

    def comment(self, lines, below):
        """A comment on lines of its own, and the line below it."""
        texts = [re.sub(r"^\s*// ?", "", line) for line in lines if not NO_WORDS.match(line)]
        if below and not re.match(r"\s*([}#]|namespace|$)", below[0]):
            self.above = texts
            self.own = True
        elif texts and all(kind == "namespace" for kind in self.scopes.kinds):
            self.out.append(block(texts, ["\\file"]))
        else:
            self.out.extend(lines)

    def code(self, number):
        """Takes the line `number`, and those that go on with the comment behind it; gives the last one's number."""
        line = self.lines[number]
        at = comment_at(line)
        code, words = line[:at], line[at + 2:].strip()
        if re.match(r"(NOLINT|clang-format)", words):
            words = ""
        if self.scopes.statement and not code.strip():  # words for the linter amid a declaration
            self.out.append("")
            return number
        if re.match(r"\s*(#|public:|private:|protected:|//|$)", line):
            if self.scopes.documents():
                self.above, self.own = [], False
            drop = "//" in line and not code.strip() or line.startswith("#define LYREFIT_")
            self.out.append("" if drop else line)
            return number
        while words and number + 1 < len(self.lines) and re.match(rf"^ {{{at}}}// ", self.lines[number + 1]):
            number += 1
            words += " " + self.lines[number].strip()[2:].strip()
        before = list(self.scopes.kinds)
        if self.scopes.documents() and not self.scopes.statement:
            self.begun = len(self.out)
        self.scopes.read(code)
        after = self.scopes.kinds
        self.out.append(self.values_in_one_line(code) if before[-1] != "code" else line)
        self.owners = self.owners[:len(after)]
        while len(self.owners) < len(after):
            head = re.sub(r"template\s*<.*?>\s*(?=struct|class)", "", self.scopes.opened[-1])
            name = re.search(r"(?:struct|class)(?: alignas\(\d+\))? (\w+)", head)
            self.owners.append(name.group(1) if name and after[-1] == "class" else "")
        if words and re.match(r"template <.*>\s*$", code):
            self.above, self.own = [words], True
            return number
        if len(after) > len(before) and after[-1] in ("class", "enum"):
            self.say(words, code, before)
            self.said.append(self.above)
            self.above = []
        elif len(after) != len(before) and "namespace" == (before + after[len(before):])[-1]:
            self.above, self.own = [], False
        elif re.match(r"\s*\}", code) and before[-1] in ("class", "enum") and len(after) < len(before):
            self.above, self.own = self.said.pop(), False
        elif self.scopes.documents() and (not self.scopes.statement.strip() or after[-1] == "enum"):
            self.say(words, code, after)
        return number

    def say(self, behind, code, scopes):
        """What is known of the declaration that begins at `begun` and ends, or opens a type, with this line."""
        value = re.match(r"\s*(k\w+)", code) if scopes[-1] == "enum" else None
        spelled = value and next((t for k, t in self.spelled.items() if k.endswith("::" + value.group(1))), "")
        if spelled:
            behind = f'"{spelled}"' + (": " + behind if behind else "")
        kind = re.match(r"\s*(.*?) \w+(?:\[\w+\])?(?: = .*|\{.*\})?;", code) if scopes[-1] == "class" else None
        kind = kind.group(1) if kind and "(" not in kind.group(1) else ""
        if self.own:
            self.kind = kind
        elif scopes[-1] == "class" and kind != self.kind:
            self.above = []
        texts = self.above if self.own or not behind else []
        if not texts and not behind and scopes[-1] == "class":
            behind = self.known.of_field(self.owners[-1], code)
        table = re.match(r"inline constexpr OptionRow<(\w+)> ", self.line_at_begin()) if not texts else None
        if table:
            behind = f"What flags, checks, --help and reports know of {table.group(1)}."
        if behind and not self.own:
            self.above = []
        texts = texts + ([behind] if behind else [])
        if texts:
            members = "class" in scopes or "enum" in scopes
            topic = [f"\\ingroup {self.module}"] if self.module and not members else []
            self.out.insert(self.begun, block(texts, topic))
        self.own = False

    def line_at_begin(self):
        return self.out[self.begun] if self.begun < len(self.out) else ""

    def values_in_one_line(self, code):
        """An enumeration that stands in one line, its values shown with their texts."""
        whole = re.match(r"(\s*enum class \w+[^{]*\{)([^}]*)(\};)\s*$", code)
        if not whole:
            return code
        values = [v.strip() for v in whole.group(2).split(",")]
        name = re.search(r"enum class (\w+)", code).group(1)
        said = [f"{v} /**< \"{self.spelled[name + '::' + v]}\" */" if name + "::" + v in self.spelled else v
                for v in values if v]
        return whole.group(1) + ", ".join(said) + whole.group(3)
