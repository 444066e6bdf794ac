"""Prose, links and pictures of a page of Markdown."""

import re

PICTURE = re.compile(r"!\[([^\]]*)\]\(([^)\s]*)\)")
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]*)\)")


def pieces(text):
    """Prose and code in turn: (whether it is code, the text), whose texts joined are the page."""
    code, fenced = [], False
    for line in text.splitlines(keepends=True):
        fence = line.lstrip().startswith("```")
        code.append((fenced or fence or line.startswith("    "), line))
        fenced ^= fence
    start = 0
    for end in range(1, len(code) + 1):
        if end == len(code) or code[end][0] != code[start][0]:
            yield code[start][0], "".join(line for _, line in code[start:end])
            start = end
